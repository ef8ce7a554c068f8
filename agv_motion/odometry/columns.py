"""Dead reckoning over columns: poses and noise of a whole recording at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import SignalError
from agv_motion.planar import Pose

if TYPE_CHECKING:
    from agv_motion.odometry.covariance import Covariance

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


def matrix(covariance: Covariance) -> Column:
    """Return (3, 3) the six numbers of a covariance as a symmetric matrix."""
    xx, xy, xt, yy, yt, tt = covariance
    return np.array([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])


def adjoint_columns(poses: Column) -> Column:
    """Return what a small motion of the base halfway through each step is to the world.

    Args:
        poses: (3, n + 1) before the first and after each step, as `pose_columns` gives them.

    Returns:
        (n, 3, 3) from a displacement in the frame of the base to one about the origin.

    """
    x, y, heading = 0.5 * (poses[:, 1:] + poses[:, :-1])
    c, s = np.cos(heading), np.sin(heading)
    zero, one = np.zeros_like(x), np.ones_like(x)
    return np.array([[c, -s, y], [s, c, -x], [zero, zero, one]]).transpose(2, 0, 1)


def noise_columns(adjoint: Column, unit: Column, variance: Column) -> Column:
    """Return how the covariance of the error about the origin grows along a way.

    Args:
        adjoint: (n, 3, 3) of :func:`adjoint_columns`.
        unit: (3, 3) covariance of a displacement in the frame of the base, for unit variance.
        variance: (n,) factor on it in each step.

    Returns:
        (n + 1, 3, 3) covariances, the first one zero.

    """
    added = variance[:, None, None] * (adjoint @ unit @ adjoint.transpose(0, 2, 1))
    return np.concatenate([np.zeros((1, 3, 3)), np.cumsum(added, axis=0)])
