"""A move: from the present direction of the twist straight to the wanted one, as fast as may be.

The equations are those of :mod:`agv_motion.kinematics.steering.planner`.
"""

from __future__ import annotations

from math import atan2, inf, pi, sqrt, tan
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.kinematics.steering.braking import BRAKING, braking_rate, usable_period
from agv_motion.kinematics.steering.direction import POINT, POINT_SQUARED, START_ERROR, STILL
from agv_motion.kinematics.steering.state import Limiter

if TYPE_CHECKING:
    from agv_motion.kinematics.steering.chassis import Chassis
    from agv_motion.kinematics.steering.direction import Direction
    from agv_motion.kinematics.steering.limits import SteeringLimits
    from agv_motion.kinematics.steering.state import Rolling, Setpoints


GROWTH = 0.4
"""Share of the wheel acceleration that turning may use; as much is left to slow down meanwhile."""

PLANNED = 0.125
"""Share of the acceleration up to which a move is planned, see `follow.can_brake`."""

RECEDING = 0.25
"""Share of it that a turret may need while its wheel speeds up."""

FARTHEST = 0.5
"""[rad] most that the direction turns in one step, and [-] that a wheel velocity shrinks by."""

NONE, RATE, ACCELERATION = Limiter.NONE, Limiter.STEERING_RATE, Limiter.STEERING_ACCELERATION
WHEEL_ACCELERATION = Limiter.WHEEL_ACCELERATION
"""Looked up once: in Python 3.11 a member of an Enum costs as much as ten multiplications."""


class Move(NamedTuple):
    """What the limits allow on the way to the wanted direction."""

    velocity: Direction
    """[1/s] of the direction, tangential to it"""
    arrives: bool
    """whether one step of it ends at the wanted direction"""
    limiter: Limiter
    """what keeps it from being faster"""
    free: tuple[tuple[int, float], ...] = ()
    """number of each turret at the centre of rotation, and the line along which it must stand
    before the platform moves on [rad]"""


HERE = Move(STILL, arrives=False, limiter=NONE)
"""The direction is the wanted one. These three are told by identity."""
TURNING = Move(STILL, arrives=False, limiter=RATE)
"""The direction waits for a turret at the centre of rotation."""
TOO_FAR = Move(STILL, arrives=False, limiter=Limiter.STOPPING)
"""A turret had better be reversed: the platform stops."""


class _Demand(NamedTuple):
    """What going along a great circle at 1 rad/s asks for: the highest of all turrets."""

    tangent: Direction
    """of the circle, where the platform is"""
    distance: float
    """[rad] to the wanted direction"""
    turning: float
    """[rad/s] steering rate"""
    nearing: float
    """[1/s] rate at which the velocity of a wheel vanishes, 1 at least"""
    receding: float
    """product of both where it grows instead"""
    growing: float
    """square of the rate at which the speed of a wheel changes"""
    bending: float
    """square of the rate at which that one rises as the velocity of a wheel turns"""
    landing: float
    """the same of turrets at which the centre of rotation comes to lie in the end, no less"""
    lands_turning: bool
    """whether one of those turns too fast to stop within a step"""
    free: tuple[tuple[int, float], ...]
    """see `Move`"""


def plan_move(  # noqa: C901 - one loop: calls double its time
    chassis: Chassis, rolling: Rolling, wanted: Direction, period: float
) -> Move:
    """Return how to go on towards ``wanted``, a unit direction, in a step of ``period`` [s]."""
    a, b, c = rolling.direction
    wanted_a, wanted_b, wanted_c = wanted
    cosine = a * wanted_a + b * wanted_b + c * wanted_c
    ta, tb, tc = wanted_a - cosine * a, wanted_b - cosine * b, wanted_c - cosine * c
    sine = sqrt(ta * ta + tb * tb + tc * tc)
    if sine < 1e-12:
        return HERE if cosine > 0.0 else TOO_FAR
    ta, tb, tc = tangent = ta / sine, tb / sine, tc / sine
    distance = atan2(sine, cosine)
    limits, angles = chassis.limits, rolling.setpoints.angles
    edge = limits.cables_end - pi
    turning, nearing, receding, growing, bending = 1e-9, 1.0, 0.0, 0.0, 0.0
    free: tuple[tuple[int, float], ...] = ()
    lands_turning, landing = False, -inf
    for i, (x, y) in enumerate(chassis.arms):
        wx, wy = a - c * y, b + c * x
        tx, ty = ta - tc * y, tb + tc * x
        square = wx * wx + wy * wy
        if square < POINT_SQUARED:
            free = (*free, (i, atan2(ty, tx)))
            growing = max(growing, tx * tx + ty * ty)
            continue
        along, across = (wx * tx + wy * ty) / square, (wx * ty - wy * tx) / square
        growth = along * along * square
        if growth > growing:
            growing = growth
        there = cosine + sine * along
        if there < POINT or abs(angles[i]) >= edge:
            aside = sine * across
            if there * there + aside * aside < POINT_SQUARED:
                lands_turning = lands_turning or not is_slow(rolling.setpoints, limits, i, period)
                landing = max(landing, -along)
            elif _is_too_far(limits, rolling, i, atan2(aside, there), distance):
                return TOO_FAR
        bend = across * across
        bend *= bend * square
        if bend > bending:
            bending = bend
        if across < 0.0:
            across = -across
        if across > turning:
            turning = across
        if -along > nearing:
            nearing = -along
        elif along * across > receding:
            receding = along * across
    demand = _Demand(
        tangent, distance, turning, nearing, receding, growing, bending, landing, lands_turning,
        free,
    )  # fmt: skip
    return _bounded(limits, rolling.speed, demand, period)


def is_slow(setpoints: Setpoints, limits: SteeringLimits, i: int, period: float) -> bool:
    """Return whether turret ``i`` could stop within one step."""
    change = limits.steering_acceleration * usable_period(setpoints, period)
    return abs(setpoints.rates[i]) <= BRAKING * change


def _is_too_far(
    limits: SteeringLimits, rolling: Rolling, i: int, turn: float, distance: float
) -> bool:
    """Return whether turret ``i`` had better be reversed, or must not turn so far."""
    if abs(rolling.setpoints.angles[i] + turn) > limits.cables_end:
        return True
    most = limits.reversal_angle + (0.0 if rolling.stopping else limits.reversal_hysteresis)
    return distance > START_ERROR and abs(turn) > most


def _bounded(limits: SteeringLimits, speed: float, demand: _Demand, period: float) -> Move:
    """Return the fastest move that all limits allow at ``speed`` [m/s]."""
    (
        tangent, distance, turning, nearing, receding, growing, bending, landing, lands_turning,
        free,
    ) = demand  # fmt: skip
    rate, acceleration = limits.steering_rate, limits.steering_acceleration
    limit, limiter = rate / turning, RATE
    risk = turning * nearing
    if limit * limit * risk > PLANNED * acceleration:
        limit, limiter = sqrt(PLANNED * acceleration / risk), ACCELERATION
    if limit * limit * receding > RECEDING * acceleration:
        limit, limiter = sqrt(RECEDING * acceleration / receding), ACCELERATION
    spare = GROWTH * limits.wheel_acceleration
    if limit * limit * growing * speed * speed > spare * spare:
        limit, limiter = spare / (speed * sqrt(growing)), WHEEL_ACCELERATION
    gain = 0.5 * sqrt(bending) * speed * period
    if limit * limit * gain > spare:  # where the speeds do not change yet: from straight ahead
        limit, limiter = sqrt(spare / gain), WHEEL_ACCELERATION
    braking = braking_rate(distance, BRAKING * acceleration / turning, period)
    if braking < limit:
        limit, limiter = braking, ACCELERATION
    step = limit * period
    if step > FARTHEST or step * nearing > FARTHEST > step * landing:
        step = FARTHEST / nearing
    arrives = step >= distance and not lands_turning
    if arrives:
        limit, limiter = tan(distance) / period, NONE
    else:
        limit = (step if step < distance else 0.5 * distance) / period
    ta, tb, tc = tangent
    return Move((ta * limit, tb * limit, tc * limit), arrives, limiter, free)
