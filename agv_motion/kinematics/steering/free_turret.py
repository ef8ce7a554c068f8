"""A turret at the centre of rotation: its wheel stands, so it may turn alone; the others wait."""

from __future__ import annotations

from math import copysign, cos, pi
from typing import TYPE_CHECKING

from agv_motion.kinematics.steering.braking import BRAKING, braking_rate, changed, usable_period
from agv_motion.kinematics.steering.direction import STILL
from agv_motion.kinematics.steering.state import BACKWARDS, FORWARDS
from agv_motion.planar import wrap

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.kinematics.steering.limits import SteeringLimits
    from agv_motion.kinematics.steering.state import Rolling, Setpoints

ALONG = 1e-9
"""[rad] A turret so near to its line stands along it."""


def turn_free_turrets(
    rolling: Rolling,
    limits: SteeringLimits,
    free: Iterable[tuple[int, float]],
    period: float,
) -> bool:
    """Turn the turrets at the centre of rotation for one step, either way along their lines.

    Args:
        rolling: Of the platform, whose direction must rest.
        limits: Of the turrets.
        free: Number of each such turret, and the direction in which its wheel will move [rad].
        period: Length of the step [s].

    Returns:
        Whether all stand along their lines, so that the platform may go on.

    """
    done = True
    for i, line in free:
        done = _turn(rolling, limits, i, line, period) and done
    return done


def _turn(rolling: Rolling, limits: SteeringLimits, i: int, line: float, period: float) -> bool:
    if rolling.velocity is not STILL:
        return False
    setpoints = rolling.setpoints
    off = wrap(2.0 * (line - setpoints.angles[i])) / 2.0
    if abs(setpoints.angles[i] + off) > limits.cables_end:
        off -= copysign(pi, off)
    forwards = cos(line - setpoints.angles[i] - off) > 0.0
    setpoints.signs[i] = FORWARDS if forwards else BACKWARDS
    acceleration, before = limits.steering_acceleration, setpoints.rates[i]
    change = acceleration * usable_period(setpoints, period)
    if abs(off) < ALONG and abs(before) <= BRAKING * change:
        rolling.free_turret = None
        return True
    rate = min(limits.steering_rate, braking_rate(abs(off), BRAKING * acceleration, period))
    _set_rate(setpoints, i, changed(before, copysign(rate, off), change), period)
    rolling.free_turret = i
    return False


def brake_free_turret(rolling: Rolling, limits: SteeringLimits, period: float) -> None:
    """Bring a turret that turns at the centre of rotation to a stop: it is not needed any more."""
    i, setpoints = rolling.free_turret, rolling.setpoints
    assert i is not None
    change = limits.steering_acceleration * usable_period(setpoints, period)
    _set_rate(setpoints, i, changed(setpoints.rates[i], 0.0, change), period)
    if setpoints.rates[i] == 0.0:
        rolling.free_turret = None


def _set_rate(setpoints: Setpoints, i: int, rate: float, period: float) -> None:
    setpoints.rates[i] = rate
    setpoints.angles[i] += rate * period
