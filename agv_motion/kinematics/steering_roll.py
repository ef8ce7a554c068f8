"""One step of a rolling platform: its twist turns as far as it may, and its wheels follow."""

from __future__ import annotations

from math import atan2, pi, sqrt, tau
from typing import TYPE_CHECKING

from agv_motion.kinematics.steering_course import (
    GROWTH,
    HERE,
    TURNING,
    all_follow,
    can_brake,
    course,
    longest_share,
)
from agv_motion.kinematics.steering_rest import brake_free_turret
from agv_motion.kinematics.steering_state import POINT, STILL, Limiter

if TYPE_CHECKING:
    from agv_motion.kinematics.steering_course import Arms
    from agv_motion.kinematics.steering_limits import SteeringLimits
    from agv_motion.kinematics.steering_state import Direction, SteeringState

    Velocity = tuple[Direction, float]


def roll(
    arms: Arms,
    state: SteeringState,
    limits: SteeringLimits,
    wanted: Velocity | None,
    period: float,
) -> None:
    """Change ``state`` by one step towards ``wanted``; None: to a smooth stop.

    Args:
        arms: (n,) turret centres from their centroid, over their mean distance.
        state: Of the platform, rolling or aligned.
        limits: Of the turrets and wheels.
        wanted: Unit direction of the wanted twist, and its length [m/s].
        period: Length of the step [s].

    """
    state.goals = None
    direction, size = wanted or (state.direction, 0.0)
    way = HERE if wanted is None else course(arms, state, limits, direction, period)
    target, arrives, limiter = way
    if state.free_turret >= 0 and way is not TURNING:
        brake_free_turret(state, limits, period)
        target = STILL
    growth = 0.0
    if target is STILL and state.velocity is STILL:
        _keep_angles(state)
    else:
        share = _change_velocity(arms, state, limits, target, period)
        if share < 1.0 and limiter is not Limiter.STOPPING:
            limiter = Limiter.STEERING_ACCELERATION
        growth = _turn(arms, state, direction if arrives and share == 1.0 else None, period)
    state.limiter = limiter
    speed = 0.0
    if limiter is not Limiter.STOPPING:
        (a, b, c), (wanted_a, wanted_b, wanted_c) = state.direction, direction
        speed = size * (a * wanted_a + b * wanted_b + c * wanted_c)
    _drive(state, limits, speed if speed > 0.0 else 0.0, growth, period)


def _keep_angles(state: SteeringState) -> None:
    rates = state.rates
    for i in range(len(rates)):
        if i != state.free_turret:
            rates[i] = 0.0


def _change_velocity(
    arms: Arms, state: SteeringState, limits: SteeringLimits, target: Direction, period: float
) -> float:
    """Bring the velocity of the direction as near to ``target`` as the turrets can follow.

    Returns:
        The share of the change in [0, 1]; 0 where the turrets cannot turn aside so soon and the
        platform brakes straight on instead.

    """
    if all_follow(arms, state, limits, target, period):
        state.velocity = target
        return 1.0
    share = longest_share(arms, state, limits, target, period)
    if share is not None:
        mixed = _between(state.velocity, target, share)
        if can_brake(arms, state, limits, mixed):
            state.velocity = mixed
            return share
    share = longest_share(arms, state, limits, STILL, period)
    state.velocity = _between(state.velocity, STILL, 1.0 if share is None else share)
    return 0.0


def _between(first: Direction, second: Direction, share: float) -> Direction:
    return (
        first[0] + share * (second[0] - first[0]),
        first[1] + share * (second[1] - first[1]),
        first[2] + share * (second[2] - first[2]),
    )


def _turn(arms: Arms, state: SteeringState, arrived: Direction | None, period: float) -> float:
    """Move the direction by its velocity for one step and derive every steering angle from it.

    Args:
        arms: Of the platform.
        state: Of the platform.
        arrived: The direction at the end of the step, where it is known exactly.
        period: Length of the step [s].

    Returns:
        The highest rate at which the speed of a wheel changes, per unit of the platform's [1/s].

    """
    va, vb, vc = state.velocity
    a, b, c = state.direction
    if arrived is not None:
        a, b, c = arrived
    else:
        a, b, c = a + period * va, b + period * vb, c + period * vc
        norm = sqrt(a * a + b * b + c * c)
        a, b, c = a / norm, b / norm, c / norm
    radial = va * a + vb * b + vc * c
    va, vb, vc = va - radial * a, vb - radial * b, vc - radial * c
    state.direction = (a, b, c)
    state.velocity = (va, vb, vc) if va * va + vb * vb + vc * vc > 1e-30 else STILL
    growth = 0.0
    angles, rates, lengths, signs = state.angles, state.rates, state.lengths, state.signs
    for i, (x, y) in enumerate(arms):
        wx, wy = a - c * y, b + c * x
        lengths[i] = length = sqrt(wx * wx + wy * wy)
        if length < POINT:
            rates[i] = 0.0
            continue
        turn = atan2(wy, wx) - angles[i]
        if signs[i] < 0.0:
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


def _drive(  # noqa: C901 - one loop over the wheels
    state: SteeringState, limits: SteeringLimits, wanted: float, growth: float, period: float
) -> None:
    """Bring the speed of the platform as near to ``wanted`` as its wheels can follow.

    Args:
        state: Of the platform; its limiter gives way to one of the wheels.
        limits: Of the wheels.
        wanted: Zero or more [m/s].
        growth: Highest rate at which turning changes the speed of a wheel, over that of the
            platform [1/s].
        period: Length of the step [s].

    """
    change = limits.wheel_acceleration * period
    low, high, fastest = 0.0, wanted, 0.0
    lengths, speeds, signs = state.lengths, state.speeds, state.signs
    for length, rolling in zip(lengths, speeds):  # noqa: B905 - measured: strict costs
        if length < POINT:
            continue
        if length > fastest:
            fastest = length
        before = rolling if rolling > 0.0 else -rolling
        if before - change > low * length:
            low = (before - change) / length
        if before + change < high * length:
            high = (before + change) / length
    held = Limiter.WHEEL_ACCELERATION if high < wanted or low > high else Limiter.NONE
    if high * fastest > limits.max_wheel_speed:
        high, held = limits.max_wheel_speed / fastest, Limiter.WHEEL_SPEED
    if high * growth > GROWTH * limits.wheel_acceleration:
        high = GROWTH * limits.wheel_acceleration / growth
    state.speed = speed = low if high < low else high
    if state.limiter is Limiter.NONE:
        state.limiter = held
    if speed == 0.0:
        state.aligned = state.velocity is STILL and not any(state.rates)
        state.free_turret = -1
    for i, length in enumerate(lengths):
        speeds[i] = signs[i] * speed * length
