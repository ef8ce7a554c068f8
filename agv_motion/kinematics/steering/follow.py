"""How far the velocity of the direction may change in one step, so that all turrets can follow.

The equations are those of :mod:`agv_motion.kinematics.steering.planner`.
"""

from __future__ import annotations

from math import atan2, sqrt, tan
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.kinematics.steering.braking import usable_period
from agv_motion.kinematics.steering.direction import POINT_SQUARED, STILL

if TYPE_CHECKING:
    from agv_motion.kinematics.steering.chassis import Chassis
    from agv_motion.kinematics.steering.direction import Direction
    from agv_motion.kinematics.steering.state import Rolling


CERTAIN = 0.25
"""Share of the acceleration up to which braking is certain to hold all limits."""

WIDEST = 1.2
"""[rad] most that a turret turns in one step, however long the step."""

EXACT = 1.0 - 1e-6
"""Rounding of angles over a short step stays within this."""


class Change(NamedTuple):
    """How far the turrets can follow."""

    velocity: Direction
    """[1/s] of the direction, after the change"""
    whole: bool
    """whether it is the one aimed at"""


def nearest_velocity(
    chassis: Chassis, rolling: Rolling, target: Direction, period: float
) -> Change:
    """Return the velocity nearest to ``target`` to which all turrets can follow in one step.

    Where they cannot turn aside so soon the platform brakes straight on instead.
    """
    share = longest_share(chassis, rolling, target, period)
    if share is not None:
        mixed = _between(rolling.velocity, target, share)
        if can_brake(chassis, rolling, mixed):
            return Change(mixed, share == 1.0)
    share = longest_share(chassis, rolling, STILL, period)
    braked = _between(rolling.velocity, STILL, 1.0 if share is None else share)
    return Change(braked, whole=False)


def _between(first: Direction, second: Direction, share: float) -> Direction:
    return (
        first[0] + share * (second[0] - first[0]),
        first[1] + share * (second[1] - first[1]),
        first[2] + share * (second[2] - first[2]),
    )


def all_follow(chassis: Chassis, rolling: Rolling, target: Direction, period: float) -> bool:
    """Return whether all turrets can follow, should the velocity become ``target`` at once.

    It is where :func:`longest_share` is 1, which is what is needed most of the time, at half the
    price.
    """
    a, b, c = rolling.direction
    va, vb, vc = target
    limits, setpoints = chassis.limits, rolling.setpoints
    change = EXACT * limits.steering_acceleration * usable_period(setpoints, period)
    top = EXACT * limits.steering_rate
    for (x, y), rate in zip(chassis.arms, setpoints.rates):  # noqa: B905 - hot path
        wx, wy = a - c * y, b + c * x
        square = wx * wx + wy * wy
        if square < POINT_SQUARED:
            continue
        mx, my = va - vc * y, vb + vc * x
        along, across = square + period * (wx * mx + wy * my), period * (wx * my - wy * mx)
        turn = atan2(across, along) / period
        if not (-top <= turn <= top and rate - change <= turn <= rate + change):
            return False
    return True


def longest_share(  # noqa: C901, PLR0912 - one loop: calls double its time
    chassis: Chassis, rolling: Rolling, target: Direction, period: float
) -> float | None:
    """Return how much of the change from the present velocity to ``target`` all turrets can follow.

    Each turret may turn by an angle between two bounds: of its rate, and of the change of its
    rate. That wheel i, at ``z = w + period A (V + share (target - V))``, lies within them is linear
    in the share.

    Returns:
        The share in [0, 1], or None where there is none.

    """
    a, b, c = rolling.direction
    va, vb, vc = rolling.velocity
    da, db, dc = target[0] - va, target[1] - vb, target[2] - vc
    limits, rates = chassis.limits, rolling.setpoints.rates
    change = EXACT * limits.steering_acceleration * usable_period(rolling.setpoints, period)
    top = EXACT * limits.steering_rate
    low, high = 0.0, 1.0
    for (x, y), rate in zip(chassis.arms, rates):  # noqa: B905 - hot path
        wx, wy = a - c * y, b + c * x
        square = wx * wx + wy * wy
        if square < POINT_SQUARED:
            continue
        most, least = rate + change, rate - change
        if most > top:
            most = top if least <= top else least
        if least < -top:
            least = -top if most >= -top else most
        most, least = most * period, least * period
        most = tan(most if most < WIDEST else WIDEST)
        least = tan(least if least > -WIDEST else -WIDEST)
        k = period / square
        mx, my = va - vc * y, vb + vc * x
        along, across = 1.0 + k * (wx * mx + wy * my), k * (wx * my - wy * mx)
        mx, my = da - dc * y, db + dc * x
        more_along, more_across = k * (wx * mx + wy * my), k * (wx * my - wy * mx)
        slope, room = more_across - most * more_along, most * along - across
        if slope > 0.0:
            if room < high * slope:
                high = room / slope
        elif slope < 0.0:
            if room < low * slope:
                low = room / slope
        elif room < 0.0:
            return None
        slope, room = least * more_along - more_across, across - least * along
        if slope > 0.0:
            if room < high * slope:
                high = room / slope
        elif slope < 0.0:
            if room < low * slope:
                low = room / slope
        elif room < 0.0:
            return None
    return high if low <= high else None


def can_brake(chassis: Chassis, rolling: Rolling, velocity: Direction) -> bool:
    """Return whether braking from ``velocity`` is certain to keep every turret within its limits.

    It is where ``4 X max |y_i|`` is at most the acceleration.
    """
    a, b, c = rolling.direction
    va, vb, vc = velocity
    turning, nearing = 0.0, sqrt(va * va + vb * vb + vc * vc)
    for x, y in chassis.arms:
        wx, wy = a - c * y, b + c * x
        mx, my = va - vc * y, vb + vc * x
        square = wx * wx + wy * wy
        if square > POINT_SQUARED:
            nearing = max(nearing, -(wx * mx + wy * my) / square)
            turning = max(turning, abs(wx * my - wy * mx) / square)
    return turning * nearing <= CERTAIN * chassis.limits.steering_acceleration
