"""Omnidirectional wheels over columns: a whole recording at once, the equations of `omniwheels`."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import SignalError

if TYPE_CHECKING:
    from agv_motion.kinematics.omniwheels import OmniWheels

Column = NDArray[np.float64]


class TwistColumns(NamedTuple):
    """The twist that fits the wheels best, row by row."""

    twist: Column
    """(3, n) vx [m/s], vy [m/s], wz [rad/s]"""
    residual: Column
    """(n,) [m/s] root mean square over the wheels of what the twist does not explain"""


def speed_columns(wheels: OmniWheels, twist: Column) -> Column:
    """Return (n_wheels, n) rim speeds [m/s] for a twist in columns.

    Args:
        wheels: The base.
        twist: (3, n) vx [m/s], vy [m/s], wz [rad/s].

    Raises:
        SignalError: Another shape, or a value that is not finite (its row is named).

    """
    return wheels.matrix @ _checked('twist', twist, 3)


def twist_columns(wheels: OmniWheels, speeds: Column) -> TwistColumns:
    """Return the twist that fits each row of measured rim speeds best.

    Args:
        wheels: The base.
        speeds: (n_wheels, n) rim speeds [m/s]; travels [m] give displacements.

    Raises:
        SignalError: Another shape, or a value that is not finite (its row is named).

    """
    speeds = _checked('speeds', speeds, len(wheels))
    matrix = wheels.matrix
    twist = np.linalg.pinv(matrix) @ speeds
    error = matrix @ twist - speeds
    return TwistColumns(twist, np.sqrt(np.mean(error * error, axis=0)))


def _checked(name: str, columns: Column, count: int) -> Column:
    columns = np.asarray(columns, dtype=float)
    if columns.ndim != 2 or len(columns) != count:
        msg = f'{name} columns have shape {columns.shape}, expected ({count}, n)'
        raise SignalError(msg)
    finite = np.isfinite(columns).all(axis=0)
    if not finite.all():
        msg = f'{name} columns are not finite at row {int(np.argmin(finite))}: drop that row'
        raise SignalError(msg)
    return columns
