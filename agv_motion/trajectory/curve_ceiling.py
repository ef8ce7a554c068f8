"""The highest speed along a curve, at the nodes of its grid, by the limits that hold in bends."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from agv_motion.trajectory.limits import joint_ceiling, lowest_ceiling

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.trajectory.bezier import Column
    from agv_motion.trajectory.limits import BendLimit
    from agv_motion.trajectory.motion import ArcLengthCurve

SHORTEST = 1e-12
"""Share of the way below which a cell is none: two curves meet there."""


def curve_ceiling(
    course: ArcLengthCurve, limits: Sequence[BendLimit], cruising_speed: float
) -> Column:
    """Return the highest speed at the nodes such that the limits hold between them too.

    The plan runs straight between nodes in the squared speed. Where the true ceiling hangs below
    that line in the middle of a cell, its ends are lowered by as much, but no more than a tenth;
    where this is not enough, the higher end comes down until the line meets the middle.
    """
    everywhere = np.concatenate((course.curvature, course.middle_curvature))
    squares = lowest_ceiling(limits, everywhere, cruising_speed) ** 2
    square, middle = squares[: len(course.way)], squares[len(course.way) :]
    length = course.way[1:] - course.way[:-1]
    joint = length <= SHORTEST * course.length  # of two curves, where the curvature may step
    share = (course.middle_way - course.way[:-1]) / np.where(joint, 1.0, length)
    first, last = square[:-1], square[1:]
    if joint.any():
        most = joint_ceiling(limits, course.curvature[1:][joint] - course.curvature[:-1][joint])
        first[joint] = np.minimum(first[joint], most * most)
        last[joint] = np.minimum(last[joint], most * most)
    excess = np.where(joint, 0.0, np.maximum(first + share * (last - first) - middle, 0.0))
    either = np.zeros(len(square))
    either[:-1] = excess
    np.maximum(either[1:], excess, out=either[1:])
    square -= np.minimum(either, 0.1 * square)
    share[joint], middle[joint] = 0.5, np.inf
    first_most = np.maximum(middle, (middle - share * last) / (1.0 - share))
    last_most = np.maximum(middle, (middle - (1.0 - share) * first) / share)
    np.minimum(first, first_most, out=first)
    np.minimum(last, last_most, out=last)
    ceiling: Column = np.sqrt(square)
    return ceiling
