"""One step of a rolling platform: its twist turns as far as it may, and its wheels follow."""

from __future__ import annotations

from math import atan2, pi, sqrt, tau
from typing import TYPE_CHECKING

from agv_motion.kinematics.steering.direction import POINT, STILL
from agv_motion.kinematics.steering.follow import all_follow, nearest_velocity
from agv_motion.kinematics.steering.free_turret import brake_free_turret, turn_free_turrets
from agv_motion.kinematics.steering.move import GROWTH, HERE, TOO_FAR, TURNING, plan_move
from agv_motion.kinematics.steering.state import BACKWARDS, AtRest, Limiter

if TYPE_CHECKING:
    from agv_motion.kinematics.steering.chassis import Chassis
    from agv_motion.kinematics.steering.direction import Arms, Direction
    from agv_motion.kinematics.steering.limits import SteeringLimits
    from agv_motion.kinematics.steering.state import Phase, Rolling

NONE, STEERING = Limiter.NONE, Limiter.STEERING_ACCELERATION
WHEEL_SPEED, WHEEL_ACCELERATION = Limiter.WHEEL_SPEED, Limiter.WHEEL_ACCELERATION
"""Looked up once, see `move`."""


def roll(
    chassis: Chassis, rolling: Rolling, wanted: Direction | None, size: float, period: float
) -> Phase:
    """Take one step towards a twist; return the phase after it: at rest once the wheels stand.

    Args:
        chassis: The platform.
        rolling: Changed in place.
        wanted: Unit direction of the twist; None: to a smooth stop.
        size: Length of the twist [m/s].
        period: Length of the step [s].

    """
    move = HERE if wanted is None else plan_move(chassis, rolling, wanted, period)
    target, arrives, limiter, free = move
    if free and not turn_free_turrets(rolling, chassis.limits, free, period):
        target, arrives, limiter, _ = move = TURNING
    if rolling.free_turret is not None and move is not TURNING:
        brake_free_turret(rolling, chassis.limits, period)
        target = STILL
    rolling.stopping = stopping = move is TOO_FAR
    growth = 0.0
    if target is STILL and rolling.velocity is STILL:
        _keep_angles(rolling)
    else:
        whole = all_follow(chassis, rolling, target, period)
        if not whole:
            target, whole = nearest_velocity(chassis, rolling, target, period)
        rolling.velocity = target
        if not whole and not stopping:
            limiter = STEERING
        growth = _turn(chassis.arms, rolling, wanted if arrives and whole else None, period)
    speed = 0.0
    if wanted is not None and not stopping:
        (a, b, c), (wanted_a, wanted_b, wanted_c) = rolling.direction, wanted
        speed = size * (a * wanted_a + b * wanted_b + c * wanted_c)
    held = _drive(chassis.limits, rolling, speed if speed > 0.0 else 0.0, growth, period)
    rolling.setpoints.limiter = held if limiter is NONE else limiter
    return rolling if rolling.speed != 0.0 else _at_rest(rolling)


def _keep_angles(rolling: Rolling) -> None:
    rates = rolling.setpoints.rates
    for i in range(len(rates)):
        if i != rolling.free_turret:
            rates[i] = 0.0


def _turn(arms: Arms, rolling: Rolling, arrived: Direction | None, period: float) -> float:
    """Move the direction by its velocity for one step and derive every steering angle from it.

    Args:
        arms: Of the platform.
        rolling: Changed in place.
        arrived: The direction at the end of the step, where it is known exactly.
        period: Length of the step [s].

    Returns:
        The highest rate at which the speed of a wheel changes, per unit of the platform's [1/s].

    """
    va, vb, vc = rolling.velocity
    if arrived is not None:
        a, b, c = arrived
    else:
        a, b, c = rolling.direction
        a, b, c = a + period * va, b + period * vb, c + period * vc
        norm = sqrt(a * a + b * b + c * c)
        a, b, c = a / norm, b / norm, c / norm
    radial = va * a + vb * b + vc * c
    va, vb, vc = va - radial * a, vb - radial * b, vc - radial * c
    rolling.direction = (a, b, c)
    rolling.velocity = (va, vb, vc) if va * va + vb * vb + vc * vc > 1e-30 else STILL
    growth, lengths, setpoints = 0.0, rolling.lengths, rolling.setpoints
    angles, rates, signs = setpoints.angles, setpoints.rates, setpoints.signs
    for i, (x, y) in enumerate(arms):
        wx, wy = a - c * y, b + c * x
        lengths[i] = length = sqrt(wx * wx + wy * wy)
        if length < POINT:
            rates[i] = 0.0
            continue
        turn = atan2(wy, wx) - angles[i]
        if signs[i] == BACKWARDS:
            turn += pi
        turn = (turn + pi) % tau - pi
        angles[i] += turn
        rates[i] = turn / period
        change = (wx * (va - vc * y) + wy * (vb + vc * x)) / length
        if change < 0.0:
            change = -change
        if change > growth:
            growth = change
    return growth


def _drive(
    limits: SteeringLimits, rolling: Rolling, wanted: float, growth: float, period: float
) -> Limiter:
    """Bring the speed of the platform as near to ``wanted`` as its wheels can follow.

    Args:
        limits: Of the wheels.
        rolling: Changed in place.
        wanted: Zero or more [m/s].
        growth: Highest rate at which turning changes the speed of a wheel, over that of the
            platform [1/s].
        period: Length of the step [s].

    Returns:
        What keeps it from ``wanted``.

    """
    change = limits.wheel_acceleration * period
    low, high = 0.0, wanted
    lengths, speeds = rolling.lengths, rolling.setpoints.speeds
    for length, signed in zip(lengths, speeds):  # noqa: B905 - measured: strict costs
        if length < POINT:
            continue
        before = signed if signed > 0.0 else -signed
        if before - change > low * length:
            low = (before - change) / length
        if before + change < high * length:
            high = (before + change) / length
    held = WHEEL_ACCELERATION if high < wanted or low > high else NONE
    fastest = max(lengths)
    if high * fastest > limits.max_wheel_speed:
        high, held = limits.max_wheel_speed / fastest, WHEEL_SPEED
    if high * growth > GROWTH * limits.wheel_acceleration:
        high = GROWTH * limits.wheel_acceleration / growth
    rolling.speed = speed = low if high < low else high
    signs = rolling.setpoints.signs
    for i, length in enumerate(lengths):
        speeds[i] = signs[i] * speed * length
    return held


def _at_rest(rolling: Rolling) -> AtRest:
    """Return the platform after its last step."""
    setpoints = rolling.setpoints
    stands = rolling.velocity is STILL and not any(setpoints.rates)
    rolling.free_turret = None
    return AtRest(setpoints, rolling.stance if stands else None)
