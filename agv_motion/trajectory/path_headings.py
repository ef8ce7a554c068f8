"""The headings of a path that consists of places only: those of its own direction.

Planners on grids leave the orientations of a path at the identity, all of them or all but that of
the goal. Taken for headings they would have the robot look along the x axis at every pose.
"""

from __future__ import annotations

from itertools import pairwise
from math import atan2, dist, pi
from typing import TYPE_CHECKING

from agv_motion.planar import Pose, wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

APART = 1e-6
"""[m] Places nearer to each other are one."""


def are_places(poses: Sequence[Pose]) -> bool:
    """Return whether ``poses`` bear no headings: two or more are identities, all but the goal's."""
    if len(poses) < 2:
        return False
    *inner, goal = poses
    bare = all(pose.theta == 0.0 for pose in inner)
    return bare and len(inner) + (goal.theta == 0.0) >= 2


def stood_on(here: Pose, goal: Pose, within: float) -> Pose:
    """Return ``goal``, at the place where the robot stands if that is no further than ``within``.

    The direction to a place on which it stands already is made of the error of its last arrival.
    """
    return here._replace(theta=goal.theta) if dist(here[:2], goal[:2]) <= within else goal


def with_headings(
    start: Pose, places: Sequence[Pose], within: float = 0.0, *, backward: bool
) -> list[Pose]:
    """Return ``places`` with the headings of the path through them.

    At a place inside the path that is the direction from the one before to the next; at the end
    the direction of arrival, unless the goal has a heading of its own. Places that coincide are
    one, and the first is left out where the robot stands on it already.

    Args:
        start: Where the robot is.
        places: Two or more, see :func:`are_places`.
        within: [m] If all are one place, no further off than this, the heading stays.
        backward: Whether the robot drives backwards, and so looks against the path.

    """
    points = [places[0][:2]]
    points += [b[:2] for a, b in pairwise(places) if dist(a[:2], b[:2]) > APART]
    here = start[:2]
    if len(points) > 1 and dist(here, points[0]) < 0.5 * dist(points[0], points[1]):
        del points[0]
    befores, afters = [here, *points[:-1]], [*points[1:], points[-1]]
    poses = []
    for before, point, after in zip(befores, points, afters, strict=True):
        there = point if dist(before, after) <= APART else after  # straight there and back
        line = atan2(there[1] - before[1], there[0] - before[0])
        poses.append(Pose(*point, wrap(line + pi * backward)))
    if len(points) == 1 and dist(here, points[0]) <= within:
        poses = [poses[0]._replace(theta=start.theta)]
    if places[-1].theta != 0.0:
        poses[-1] = places[-1]
    return poses
