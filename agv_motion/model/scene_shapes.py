"""What is drawn of a robot in the map: lines, arrows, words, its shadow; each has a namespace.

All places are metres in the map; what is not finite is not drawn.
"""

from __future__ import annotations

from enum import Enum
from itertools import pairwise
from math import atan2, cos, hypot, isfinite, pi, radians, sin, sqrt, tan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from agv_motion.model.shapes import Color
    from agv_motion.model.transform import Vector
    from agv_motion.planar import Pose, Twist

    Point = tuple[float, float]

FAR = 100.0
"""[m] A centre of rotation beyond is drawn as a line to infinity, of this length."""
STILL = 1e-4
"""[m/s, rad/s] below which nothing moves"""
SIGMAS = 2.0
"""Ellipses are drawn at two standard deviations."""
CORNERS = 32
"""of a circle"""
LOWEST_SUN = radians(3.0)
"""[rad] A lower sun casts no shadow that ends on a square."""
SPEED = 20.0
"""[s] Length of an arrow over the speed that it tells"""


class ShapeKind(Enum):
    """How the points of a shape are joined."""

    LINE = 'line'
    """One after the other"""
    PAIRS = 'pairs'
    """Each two"""
    ARROW = 'arrow'
    """From the first to the second"""
    TEXT = 'text'
    """Words at the first"""
    TRIANGLES = 'triangles'
    """Each three, filled"""


class SceneShape(NamedTuple):
    """One thing to be drawn."""

    namespace: str
    kind: ShapeKind
    points: tuple[Vector, ...]
    color: Color
    width: float = 0.04
    """[m] of lines; height of words"""
    text: str = ''

    @property
    def is_drawable(self) -> bool:
        """Whether all of it is finite, and there are enough points."""
        enough = 1 if self.kind is ShapeKind.TEXT else 2
        sound = all(isfinite(x + y + z) for x, y, z in self.points)
        return sound and len(self.points) >= enough


def ring(namespace: str, points: Iterable[Point], color: Color, width: float = 0.04) -> SceneShape:
    """Return a closed line on the floor."""
    corners = [(x, y, 0.0) for x, y in points]
    return SceneShape(namespace, ShapeKind.LINE, (*corners, *corners[:1]), color, width)


def way(namespace: str, points: Iterable[Point], color: Color, width: float = 0.04) -> SceneShape:
    """Return an open line on the floor."""
    return SceneShape(
        namespace, ShapeKind.LINE, tuple((x, y, 0.01) for x, y in points), color, width
    )


def outline(pose: Pose, radius: float, color: Color) -> list[SceneShape]:
    """Return the rim of a platform, and a line that tells where it looks."""
    turns = [2.0 * pi * i / CORNERS for i in range(CORNERS)]
    rim = ring('outline', (on_floor(pose, radius * cos(a), radius * sin(a)) for a in turns), color)
    front = way('outline', [on_floor(pose, 0.6 * radius, 0.0), on_floor(pose, radius, 0.0)], color)
    return [rim, front]


def wheels(
    pose: Pose, places: Sequence[tuple[float, float, float]], speeds: Sequence[float],
    radius: float, color: Color,
) -> list[SceneShape]:  # fmt: skip
    """Return each wheel as a bar along its way, and its speed as an arrow.

    Args:
        pose: Of the robot.
        places: (n,) x, y [m] and direction [rad] of each wheel in the robot.
        speeds: (n,) [m/s].
        radius: Of the wheels [m].
        color: Of all.

    """
    found = []
    for (x, y, angle), speed in zip(places, speeds, strict=False):
        c, s = cos(angle), sin(angle)
        ends = [on_floor(pose, x + d * c, y + d * s) for d in (-radius, radius)]
        found.append(way('turrets', ends, color, 0.4 * radius))
        if abs(speed) > STILL:
            reach = SPEED * speed
            tip = on_floor(pose, x + reach * c, y + reach * s)
            arrow = way('turrets', [on_floor(pose, x, y), tip], color, 0.05)
            found.append(arrow._replace(kind=ShapeKind.ARROW))
    return found


def rotation_centre(
    pose: Pose, twist: Twist, places: Sequence[tuple[float, float, float]], color: Color
) -> list[SceneShape]:
    """Return where all wheel axes meet; a line towards it where that is far; nothing at rest."""
    speed = hypot(twist.vx, twist.vy)
    if speed < STILL and abs(twist.wz) < STILL:
        return []
    if abs(twist.wz) * FAR <= speed:
        left = 1.0 if twist.wz >= 0.0 else -1.0
        x, y = -left * twist.vy / speed * FAR, left * twist.vx / speed * FAR
        return [way('icr', [(pose.x, pose.y), on_floor(pose, x, y)], color, 0.02)]
    x, y = -twist.vy / twist.wz, twist.vx / twist.wz
    centre = on_floor(pose, x, y)
    cross = [(0.15, 0.0), (-0.15, 0.0), (0.0, 0.15), (0.0, -0.15)]
    points = [(centre[0] + dx, centre[1] + dy) for dx, dy in cross]
    for px, py, _ in places:
        points += [on_floor(pose, px, py), centre]
    return [way('icr', points, color, 0.02)._replace(kind=ShapeKind.PAIRS)]


def uncertainty(pose: Pose, xx: float, xy: float, yy: float, color: Color) -> list[SceneShape]:
    """Return the ellipse within which the robot stands, of two standard deviations."""
    mean, spread = 0.5 * (xx + yy), hypot(0.5 * (xx - yy), xy)
    if not (isfinite(mean + spread) and mean > 0.0):
        return []
    long, short = (SIGMAS * sqrt(max(mean + part, 0.0)) for part in (spread, -spread))
    tilt = 0.5 * atan2(2.0 * xy, xx - yy)
    c, s = cos(tilt), sin(tilt)
    turns = [2.0 * pi * i / CORNERS for i in range(CORNERS)]
    arms = [(long * cos(a), short * sin(a)) for a in turns]
    return [ring('uncertainty', ((pose.x + c * u - s * v, pose.y + s * u + c * v)
                                 for u, v in arms), color, 0.02)]  # fmt: skip


def sun_arrow(
    pose: Pose, elevation: float, azimuth: float, words: str, color: Color
) -> list[SceneShape]:
    """Return an arrow that comes down from the sun, and the light at the robot in words.

    Args:
        pose: Of the robot.
        elevation: Of the sun above the horizon [rad]; at night there is no arrow.
        azimuth: Of the sun, counter-clockwise from the x axis of the map [rad].
        words: About the light.
        color: Of both.

    """
    found = []
    if elevation > 0.0:
        away = 3.0 * cos(elevation), 3.0 * sin(elevation)
        start = (
            pose.x + away[0] * cos(azimuth), pose.y + away[0] * sin(azimuth), 3.0 + away[1],
        )  # fmt: skip
        found.append(SceneShape('sun', ShapeKind.ARROW, (start, (pose.x, pose.y, 3.0)), color, 0.1))
    if words:
        found.append(SceneShape('sun', ShapeKind.TEXT, ((pose.x, pose.y, 4.6),), color, 0.3, words))
    return found


def shadow(
    pose: Pose, corners: Sequence[Vector], elevation: float, azimuth: float, color: Color
) -> list[SceneShape]:
    """Return the shadow of a robot on the floor, filled: the hull of those of its corners.

    Args:
        pose: Of the robot.
        corners: What stands on it, in its own frame [m].
        elevation: Of the sun above the horizon [rad]; none below `LOWEST_SUN`.
        azimuth: Of the sun, counter-clockwise from the x axis of the map [rad].
        color: Of the shadow.

    """
    if elevation < LOWEST_SUN or not corners:
        return []
    long = 1.0 / tan(elevation)
    away = -long * cos(azimuth), -long * sin(azimuth)
    xs, ys, zs = np.asarray(corners).T  # a tree has hundreds of corners
    c, s = cos(pose.theta), sin(pose.theta)
    cast = pose.x + c * xs - s * ys + zs * away[0], pose.y + s * xs + c * ys + zs * away[1]
    hull = shapely.multipoints(np.column_stack(cast)).convex_hull
    if not isinstance(hull, shapely.Polygon):
        return []
    outer = shapely.geometry.polygon.orient(hull).exterior  # counter-clockwise: seen from above
    ring = [(float(x), float(y), 0.005) for x, y in outer.coords]
    fan = [point for second, third in pairwise(ring[1:-1]) for point in (ring[0], second, third)]
    return [SceneShape('shadow', ShapeKind.TRIANGLES, tuple(fan), color, 1.0)]


def on_floor(pose: Pose, x: float, y: float) -> Point:
    """Return a place in the robot as a place in the map."""
    c, s = cos(pose.theta), sin(pose.theta)
    return pose.x + c * x - s * y, pose.y + s * x + c * y
