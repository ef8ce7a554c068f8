"""The twist that explains measured wheels best, of one instant or in columns."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import SignalError

if TYPE_CHECKING:
    from agv_motion.planar import Twist

Column = NDArray[np.float64]


class TwistFit(NamedTuple):
    """The twist that explains the wheels best."""

    twist: Twist
    residual: float
    """[m/s] root mean square over the wheels of the velocity that the twist does not explain: how
    hard turrets pull against each other, how much roller wheels slip"""


class TwistColumns(NamedTuple):
    """The same row by row."""

    twist: Column
    """(3, n) vx [m/s], vy [m/s], wz [rad/s]"""
    residual: Column
    """(n,) [m/s]"""


def fitted(twist: Column, residual: Column) -> TwistColumns:
    """Return what fits the wheels row by row.

    Raises:
        SignalError: Wheels are so fast that the fit is not finite (its row is named).

    """
    require_columns('fitted twist', twist, 3)
    require_columns('residual', residual[np.newaxis], 1)
    return TwistColumns(twist, residual)


def require_columns(name: str, columns: Column, count: int) -> Column:
    """Return ``columns`` as an array of shape (count, n).

    Raises:
        SignalError: Another shape, or a value that is not finite (its row is named).

    """
    columns = np.asarray(columns, dtype=float)
    if columns.ndim != 2 or len(columns) != count:
        msg = f'{name} columns have shape {columns.shape}, expected ({count}, n)'
        raise SignalError(msg)
    finite = np.isfinite(columns).all(axis=0)
    if not finite.all():
        msg = f'{name} columns are not finite at row {int(np.argmin(finite))}: drop that row'
        raise SignalError(msg)
    return columns
