"""Dead reckoning over columns: the poses of a whole recording at once, exactly."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import SignalError
from agv_motion.planar import Pose

Column = NDArray[np.float64]

ORIGIN = Pose(0.0, 0.0, 0.0)


def pose_columns(displacement: Column, start: Pose = ORIGIN) -> Column:
    """Return the pose before the first and after each displacement of constant twist.

    Each step goes along the chord of its arc, see `dead_reckoning`.

    Args:
        displacement: (3, n) twist times duration in the frame of the base [m, m, rad].
        start: Pose before the first step.

    Returns:
        (3, n + 1) x [m], y [m] and heading [rad]; the heading counts turns, it is not wrapped.

    Raises:
        SignalError: Another shape, or a value that is not finite (its row is named).

    """
    displacement = np.asarray(displacement, dtype=float)
    if displacement.ndim != 2 or len(displacement) != 3:
        msg = f'displacement columns have shape {displacement.shape}, expected (3, n)'
        raise SignalError(msg)
    finite = np.isfinite(displacement).all(axis=0)
    if not finite.all():
        msg = f'displacement columns are not finite at row {int(np.argmin(finite))}: drop that row'
        raise SignalError(msg)
    dx, dy, turn = displacement
    poses = np.empty((3, displacement.shape[1] + 1))
    poses[:, 0] = start
    np.cumsum(turn, out=poses[2, 1:])
    poses[2, 1:] += start.theta
    heading = poses[2, :-1] + 0.5 * turn
    chord = np.sinc(turn / (2.0 * np.pi))  # numpy's sinc is sin(pi x) / (pi x)
    c, s = chord * np.cos(heading), chord * np.sin(heading)
    poses[0, 1:] = start.x + np.cumsum(c * dx - s * dy)
    poses[1, 1:] = start.y + np.cumsum(s * dx + c * dy)
    return poses
