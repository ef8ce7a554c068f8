"""A robot on a map: at its true size where that is known, as an arrow head where it is not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.planar import Pose
from agv_motion.report import style

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike

    from agv_motion.model.footprint import Footprint

BODY, WHEEL, UNSIZED = 'body', 'wheel', 'robot without a size'
"""What is drawn of a robot, by its ``gid``."""

SMALLEST = 0.006
"""of the extent of a map: a robot that reaches less far is not to be seen on it."""

OVERLAP = 0.3
"""of its reach: so near to another time at which it is drawn a robot is not drawn once more."""

HEAD = 13.0
"""[pt] of an arrow head that stands for a robot"""

NEAR = 0.035
"""of the extent of a map: so far an arrow head reaches, about; what is nearer is one place."""


def draw_robot(
    axes: Axes, pose: ArrayLike, shape: Footprint | None, color: Any = style.ROBOT, *,
    strong: bool = False,
) -> None:  # fmt: skip
    """Draw a robot at its true size, with its wheels and a stroke to where it looks.

    Args:
        axes: A map.
        pose: x [m], y [m], heading [rad].
        shape: What it covers of the floor, in its own frame; None: its size is not known, or too
            small to be seen. Then an arrow head stands there, of the same size on any map, so that
            nobody takes it for the robot.
        color: Of the robot.
        strong: At a start or an end.

    """
    from matplotlib.colors import to_rgba
    from matplotlib.patches import Polygon

    x, y, heading = np.asarray(pose, dtype=float).tolist()
    width = 1.8 if strong else 1.0
    if shape is None:
        axes.plot(
            x, y, marker=_arrow_head(heading), ms=HEAD, color=color, mec=style.paper(), mew=0.7,
            alpha=1.0 if strong else 0.6, zorder=4, gid=UNSIZED,
        )  # fmt: skip
        return
    body, turrets, wheels = shape.at(Pose(x, y, heading))
    axes.add_patch(
        Polygon(body, fc=to_rgba(color, 0.22 if strong else 0.08), ec=color, lw=width, gid=BODY)
    )
    for turret in turrets:
        axes.add_patch(Polygon(turret, fc=to_rgba(color, 0.25), ec='none', lw=0.0))
    for wheel in wheels:
        axes.add_patch(Polygon(wheel, fc=style.ink(), ec=style.ink(), lw=0.8, zorder=3, gid=WHEEL))
    front = max(x for x, _ in shape.body)
    axes.plot(
        [x, x + front * np.cos(heading)], [y, y + front * np.sin(heading)], color=color, lw=width
    )


def draw_way(
    axes: Axes, poses: ArrayLike, shapes: Sequence[Footprint] | None, color: Any = style.ROBOT
) -> None:
    """Draw a robot at the start, between and at the end of its way; those between stand back.

    Args:
        axes: A map.
        poses: (n, 3) x [m], y [m], heading [rad].
        shapes: One for each pose; None: arrow heads at both ends.
        color: Of the robot.

    """
    rows = np.asarray(poses, dtype=float)
    last = len(rows) - 1
    there: list[Any] = []
    for i in [last, 0, *range(1, last)] if last > 0 else range(last + 1):
        place, ends = rows[i, :2], i in {0, last}
        taken = any(np.hypot(*(place - other)) < (_reach(shapes) if shapes else 0.0) * OVERLAP
                    for other in there)  # fmt: skip
        if np.isfinite(rows[i]).all() and not taken and (shapes is not None or ends):
            draw_robot(axes, rows[i], shapes[i] if shapes else None, color, strong=ends)
            there.append(place)


def name_ends(
    axes: Axes, ends: ArrayLike, shapes: Sequence[Footprint] | None, extent: float,
    taken: list[Any],
) -> None:  # fmt: skip
    """Name start and end of a way, (2, 2) [m], beside the robot; both at once if it came back."""
    start, end = np.asarray(ends, dtype=float)
    together = not np.hypot(*(end - start)) >= NEAR * extent
    named = [(end, 'start and end')] if together else [(start, 'start'), (end, 'end')]
    for place, name in named:
        style.name_near(axes, place, beside(shapes, extent), name, style.ink(), taken)


def caption(shapes: Sequence[Footprint] | None) -> str:
    """Return what is to be said of how robots are drawn."""
    return 'robot to scale' if shapes else 'arrow heads not to scale'


def visible(shapes: Sequence[Footprint] | None, extent: float) -> Sequence[Footprint] | None:
    """Return the shapes of a robot where it can be seen on a map of an extent [m], else None."""
    return None if not shapes or _reach(shapes) < SMALLEST * extent else shapes


def room(shapes: Sequence[Footprint] | None, extent: float) -> float:
    """Return how much a map of an extent [m] leaves around the places of a robot [m]."""
    return max(0.12 * extent, 1.3 * _reach(shapes) if shapes else 0.0)


def beside(shapes: Sequence[Footprint] | None, extent: float) -> float:
    """Return how far from a robot on a map of an extent [m] its name stands [m]."""
    return 0.03 * extent + (_reach(shapes) if shapes else NEAR * extent)


def _reach(shapes: Sequence[Footprint]) -> float:
    return max(shape.reach for shape in shapes)


def _arrow_head(heading: float) -> Any:
    """Return a marker that points to a heading [rad]."""
    from matplotlib.markers import MarkerStyle
    from matplotlib.path import Path
    from matplotlib.transforms import Affine2D

    head = Path([(1.0, 0.0), (-0.8, 0.6), (-0.45, 0.0), (-0.8, -0.6), (1.0, 0.0)])
    return MarkerStyle(head.transformed(Affine2D().rotate(heading)))
