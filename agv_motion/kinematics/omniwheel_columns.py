"""Omnidirectional wheels over columns: a whole recording at once, the equations of `omniwheels`."""

from __future__ import annotations

from sys import float_info
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.kinematics.speed_limit import require_wheel_speed
from agv_motion.kinematics.twist_fit import fitted, require_columns

if TYPE_CHECKING:
    from agv_motion.kinematics.omniwheels import OmniWheels
    from agv_motion.kinematics.twist_fit import Column, TwistColumns


def command_columns(
    wheels: OmniWheels, twist: Column, max_wheel_speed: float = float_info.max
) -> Column:
    """Return (n_wheels, n) rim speeds [m/s] for a twist in columns.

    A row with a wheel above its limit is scaled as a whole.

    Args:
        wheels: The base.
        twist: (3, n) vx [m/s], vy [m/s], wz [rad/s].
        max_wheel_speed: Limit of every wheel [m/s].

    Raises:
        SignalError: Another shape, or a value that is not finite (its row is named).
        ConfigurationError: ``max_wheel_speed`` is not above 0.

    """
    require_wheel_speed(max_wheel_speed)
    limit = min(max_wheel_speed, float_info.max)  # an infinite one over itself is no number
    with np.errstate(over='ignore', invalid='ignore'):  # what becomes infinite is refused
        speeds = wheels.matrix @ require_columns('twist', twist, 3)
    fastest = np.abs(speeds).max(axis=0, initial=limit)
    if not np.isfinite(fastest.max(initial=limit)):
        require_columns('rim speeds', speeds, len(wheels))
    speeds *= limit / fastest
    return speeds


def twist_columns(wheels: OmniWheels, speeds: Column) -> TwistColumns:
    """Return the twist that fits each row of measured rim speeds best.

    Args:
        wheels: The base.
        speeds: (n_wheels, n) rim speeds [m/s]; travels [m] give displacements.

    Raises:
        SignalError: Another shape, or a value that is not finite (its row is named).

    """
    speeds = require_columns('speeds', speeds, len(wheels))
    matrix = wheels.matrix
    with np.errstate(over='ignore', invalid='ignore'):  # what becomes infinite is refused
        twist = np.linalg.pinv(matrix) @ speeds
        error = matrix @ twist - speeds
        residual = np.sqrt(np.mean(error * error, axis=0))
    return fitted(twist, residual)
