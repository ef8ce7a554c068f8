"""From the present direction of the twist straight to the wanted one, as fast as may be.

The equations are those of :mod:`agv_motion.kinematics.steering`.
"""

from __future__ import annotations

from math import atan2, pi, sqrt, tan, tau
from typing import TYPE_CHECKING

from agv_motion.kinematics.steering_rest import (
    BRAKING,
    braking_rate,
    turn_free_turret,
    usable_period,
)
from agv_motion.kinematics.steering_state import POINT, STILL, Limiter

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.steering_limits import SteeringLimits
    from agv_motion.kinematics.steering_state import Direction, SteeringState

    Arms = Sequence[tuple[float, float]]

START_ERROR = 0.17
"""[rad] A twist so near to the wanted one is corrected while rolling, so that noise of the wanted
twist cannot hold the platform at rest."""

POINT_SQUARED = POINT * POINT

GROWTH = 0.4
"""Share of the wheel acceleration that turning may use; as much is left to slow down meanwhile."""

PLANNED = 0.125
"""Share of the acceleration up to which a course is planned, see :func:`can_brake`."""

CERTAIN = 0.25
"""Share of it up to which braking is certain to hold all limits."""

FARTHEST = 0.5
"""[rad] most that the direction turns in one step, and [-] that a wheel velocity shrinks by."""

WIDEST = 1.2
"""[rad] most that a turret turns in one step, however long the step."""

EXACT = 1.0 - 1e-6
"""Rounding of angles over a short step stays within this."""


Course = tuple['Direction', bool, Limiter]
"""What the limits allow on the way to the wanted direction: the velocity of the direction [1/s],
tangential to it; whether one step of it ends at the wanted direction; what keeps it from being
faster."""

HERE: Course = (STILL, False, Limiter.NONE)
TURNING: Course = (STILL, False, Limiter.STEERING_RATE)
TOO_FAR: Course = (STILL, False, Limiter.STOPPING)


def course(  # noqa: C901, PLR0912, PLR0915 - one loop: calls double its time
    arms: Arms, state: SteeringState, limits: SteeringLimits, wanted: Direction, period: float
) -> Course:
    """Return how to go on towards ``wanted``.

    Args:
        arms: (n,) turret centres from their centroid, over their mean distance.
        state: Of the platform; only a turret at the centre of rotation is turned here.
        limits: Of the turrets and wheels.
        wanted: Unit direction.
        period: Length of the step [s].

    """
    a, b, c = state.direction
    wanted_a, wanted_b, wanted_c = wanted
    forward = a * wanted_a + b * wanted_b + c * wanted_c
    ta, tb, tc = wanted_a - forward * a, wanted_b - forward * b, wanted_c - forward * c
    sine = sqrt(ta * ta + tb * tb + tc * tc)
    if sine < 1e-12:
        return HERE if forward > 0.0 else TOO_FAR
    ta, tb, tc = ta / sine, tb / sine, tc / sine
    distance = atan2(sine, forward)
    edge = limits.turn_limit * tau - pi
    turning, nearing, receding, growing = 1e-9, 0.0, 0.0, 0.0
    free: list[tuple[int, float]] = []
    lands_turning, landing = False, 0.0
    for i, (x, y) in enumerate(arms):
        wx, wy = a - c * y, b + c * x
        tx, ty = ta - tc * y, tb + tc * x
        square = wx * wx + wy * wy
        if square < POINT_SQUARED:
            free.append((i, atan2(ty, tx)))
            growing = max(growing, tx * tx + ty * ty)
            continue
        along, across = (wx * tx + wy * ty) / square, (wx * ty - wy * tx) / square
        growth = along * along * square
        if growth > growing:
            growing = growth
        there = forward + sine * along
        if there < POINT or not -edge < state.angles[i] < edge:
            aside = sine * across
            if there * there + aside * aside < POINT_SQUARED:
                lands_turning = lands_turning or not slow(state, limits, i, period)
                landing = max(landing, -along)
            elif _too_far(state, limits, i, atan2(aside, there), distance):
                return TOO_FAR
        if across < 0.0:
            across = -across
        if across > turning:
            turning = across
        if along < 0.0:
            if -along > nearing:
                nearing = -along
        elif along * across > receding:
            receding = along * across
    if free and not _turned(state, limits, free, period):
        return TURNING
    limit, limiter = _fastest(state, limits, (turning, nearing, receding, growing))
    braking = braking_rate(distance, BRAKING * limits.steering_acceleration / turning, period)
    if braking < limit:
        limit, limiter = braking, Limiter.STEERING_ACCELERATION
    step = limit * period
    if step > FARTHEST or step * nearing > FARTHEST > step * landing:
        step = FARTHEST / nearing if nearing > 1.0 else FARTHEST
    if step >= distance and not lands_turning:
        limit = tan(distance) / period
        return (ta * limit, tb * limit, tc * limit), True, Limiter.NONE
    limit = (step if step < distance else 0.5 * distance) / period
    return (ta * limit, tb * limit, tc * limit), False, limiter


def _turned(
    state: SteeringState, limits: SteeringLimits, free: list[tuple[int, float]], period: float
) -> bool:
    """Turn the turrets at the centre of rotation for one step; return whether all may go on."""
    done = True
    for i, line in free:
        done = turn_free_turret(state, limits, i, line, period) and done
    return done


def slow(state: SteeringState, limits: SteeringLimits, i: int, period: float) -> bool:
    """Return whether turret ``i`` could stop within one step."""
    change = limits.steering_acceleration * usable_period(state, period)
    return abs(state.rates[i]) <= BRAKING * change


def _too_far(
    state: SteeringState, limits: SteeringLimits, i: int, turn: float, distance: float
) -> bool:
    """Return whether turret ``i`` had better be reversed, or must not turn so far."""
    if abs(state.angles[i] + turn) > limits.turn_limit * tau:
        return True
    stopping = state.limiter is Limiter.STOPPING
    most = limits.reversal_angle + (0.0 if stopping else limits.reversal_hysteresis)
    return distance > START_ERROR and abs(turn) > most


def _fastest(
    state: SteeringState, limits: SteeringLimits, moves: tuple[float, float, float, float]
) -> tuple[float, Limiter]:
    """Return the highest velocity of the direction [1/s], and what keeps it from being higher.

    Args:
        state: Of the platform.
        limits: Of the turrets and wheels.
        moves: The highest of all turrets, for unit velocity: the steering rate; the rate at which
            the velocity of a wheel vanishes; the product of both where it grows instead; the
            square of the rate at which the speed of a wheel changes.

    """
    turning, nearing, receding, growing = moves
    rate, acceleration = limits.steering_rate, limits.steering_acceleration
    limit, limiter = rate / turning, Limiter.STEERING_RATE
    risk = turning * (nearing if nearing > 1.0 else 1.0)
    if limit * limit * risk > PLANNED * acceleration:
        limit, limiter = sqrt(PLANNED * acceleration / risk), Limiter.STEERING_ACCELERATION
    if limit * limit * receding > 0.25 * acceleration:
        limit, limiter = sqrt(0.25 * acceleration / receding), Limiter.STEERING_ACCELERATION
    spare, speed = GROWTH * limits.wheel_acceleration, state.speed
    if limit * limit * growing * speed * speed > spare * spare:
        limit, limiter = spare / (speed * sqrt(growing)), Limiter.WHEEL_ACCELERATION
    return limit, limiter


def all_follow(
    arms: Arms, state: SteeringState, limits: SteeringLimits, target: Direction, period: float
) -> bool:
    """Return whether all turrets can follow, should the velocity become ``target`` at once.

    It is where :func:`longest_share` is 1, which is what is needed most of the time, at half the
    price.
    """
    a, b, c = state.direction
    va, vb, vc = target
    change = EXACT * limits.steering_acceleration * usable_period(state, period)
    top = EXACT * limits.steering_rate
    for (x, y), rate in zip(arms, state.rates):  # noqa: B905 - hot path
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


def longest_share(  # noqa: C901, PLR0912 - likewise
    arms: Arms, state: SteeringState, limits: SteeringLimits, target: Direction, period: float
) -> float | None:
    """Return how much of the change from the present velocity to ``target`` all turrets can follow.

    Each turret may turn by an angle between two bounds: of its rate, and of the change of its
    rate. That wheel i, at ``z = w + period A (V + share (target - V))``, lies within them is linear
    in the share.

    Returns:
        The share in [0, 1], or None where there is none.

    """
    a, b, c = state.direction
    va, vb, vc = state.velocity
    da, db, dc = target[0] - va, target[1] - vb, target[2] - vc
    change = EXACT * limits.steering_acceleration * usable_period(state, period)
    top = EXACT * limits.steering_rate
    low, high, rates = 0.0, 1.0, state.rates
    for i, (x, y) in enumerate(arms):
        wx, wy = a - c * y, b + c * x
        square = wx * wx + wy * wy
        if square < POINT_SQUARED:
            continue
        rate = rates[i]
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


def can_brake(
    arms: Arms, state: SteeringState, limits: SteeringLimits, velocity: Direction
) -> bool:
    """Return whether braking from ``velocity`` is certain to keep every turret within its limits.

    It is where ``4 X max |y_i|`` is at most the acceleration.
    """
    a, b, c = state.direction
    va, vb, vc = velocity
    turning, nearing = 0.0, sqrt(va * va + vb * vb + vc * vc)
    for x, y in arms:
        wx, wy = a - c * y, b + c * x
        mx, my = va - vc * y, vb + vc * x
        square = wx * wx + wy * wy
        if square > POINT_SQUARED:
            nearing = max(nearing, -(wx * mx + wy * my) / square)
            turning = max(turning, abs(wx * my - wy * mx) / square)
    return turning * nearing <= CERTAIN * limits.steering_acceleration
