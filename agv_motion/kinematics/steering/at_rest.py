"""The platform stands: each turret turns for itself, as far as it must and no further."""

from __future__ import annotations

from math import pi, tau
from typing import TYPE_CHECKING

from agv_motion.kinematics.steering.braking import BRAKING, braking_rate, changed, usable_period
from agv_motion.kinematics.steering.direction import (
    are_near,
    bearings,
    wheel_lengths,
)
from agv_motion.kinematics.steering.state import BACKWARDS, FORWARDS, Goals, Limiter, Stance
from agv_motion.planar import wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.steering.chassis import Chassis
    from agv_motion.kinematics.steering.direction import Direction
    from agv_motion.kinematics.steering.limits import SteeringLimits
    from agv_motion.kinematics.steering.state import AtRest, Setpoints

FREE_CHANGES = 3
"""Number of times that goals of the turrets change freely; afterwards only to nearer ones, so that
they are reached whatever is asked for."""

NONE, ALIGNING, UNWINDING = Limiter.NONE, Limiter.ALIGNING, Limiter.UNWINDING
"""Looked up once, see `move`."""

ARRIVED = 1e-12
"""[rad] A turret so near to its goal is there."""

ROUNDING = 1e-9
"""[rad] A goal so little beyond the turn limit lies at it."""


def hold(rest: AtRest, limits: SteeringLimits, period: float) -> None:
    """Nothing is wanted: for one step, bring turrets that still turn to a stop."""
    rest.goals, rest.setpoints.limiter = None, NONE
    if any(rest.setpoints.rates):
        rest.stance = None
        _stop(rest.setpoints, limits, period)


def align(chassis: Chassis, rest: AtRest, wanted: Direction, period: float) -> None:
    """For one step, turn all turrets to where ``wanted`` needs them; once there, take the stance.

    Args:
        chassis: The platform.
        rest: Changed in place.
        wanted: Unit direction.
        period: Length of the step [s].

    """
    goals = rest.goals
    if goals is None or goals.direction is None or not are_near(goals.direction, wanted):
        goals = _set_goals(chassis, rest, wanted)
    rest.stance, rest.setpoints.limiter = None, ALIGNING
    if _turn(rest.setpoints, goals, chassis.limits, period) and goals.direction is not None:
        rest.setpoints.signs = goals.signs
        rest.stance = Stance(goals.direction, wheel_lengths(chassis.arms, goals.direction))
        rest.goals, rest.changes = None, 0


def unwind(rest: AtRest, limits: SteeringLimits, period: float) -> bool:
    """For one step, turn each turret along its line towards the angle nearest to zero.

    Returns:
        Whether all are there.

    """
    setpoints, goals = rest.setpoints, rest.goals
    if goals is None or goals.direction is not None:
        straight = [angle - pi * round(angle / pi) for angle in setpoints.angles]
        goals = rest.goals = Goals(straight, setpoints.signs, None)
    rest.stance = None
    there = _turn(setpoints, goals, limits, period)
    if there:
        rest.goals = None
    setpoints.limiter = NONE if there else UNWINDING
    return there


def may_roll(chassis: Chassis, rest: AtRest, wanted: Direction) -> bool:
    """Return whether the turrets stand so that the rest of the way can be steered while rolling."""
    stance = rest.stance
    if stance is None or not are_near(stance.direction, wanted):
        return False
    return not _is_too_far(chassis, rest.setpoints, wanted)


def _is_too_far(chassis: Chassis, setpoints: Setpoints, wanted: Direction) -> bool:
    """Return whether a turret would leave its cables on the way to ``wanted``."""
    most, ways = chassis.limits.cables_end, bearings(chassis.arms, wanted)
    for angle, sign, way in zip(setpoints.angles, setpoints.signs, ways, strict=True):
        if abs(angle) > most - pi and way is not None:
            turn = wrap(way - angle) if sign == FORWARDS else wrap(way + pi - angle)
            if abs(angle + turn) > most:
                return True
    return False


def _set_goals(chassis: Chassis, rest: AtRest, wanted: Direction) -> Goals:
    """Aim at ``wanted``, unless that was changed too often; return the goals in force."""
    goals, before = choose_goals(chassis, rest.setpoints, wanted), rest.goals
    if before is not None:
        angles, bound = rest.setpoints.angles, before.direction is not None
        farther = _farthest(goals, angles) > _farthest(before, angles)
        if bound and rest.changes >= FREE_CHANGES and farther:
            return before
        rest.changes += 1
    rest.goals = goals
    return goals


def _farthest(goals: Goals, angles: Sequence[float]) -> float:
    """Return how far a turret has to turn at most [rad]."""
    return max(abs(goal - angle) for goal, angle in zip(goals.angles, angles, strict=True))


def choose_goals(chassis: Chassis, setpoints: Setpoints, wanted: Direction) -> Goals:
    """Return for each turret the angle to turn to, and whether its wheel shall roll backwards.

    Of all angles within the turn limit along the same line, the nearest; one that keeps the wheel
    rolling forwards is preferred up to the reversal angle. A turret beyond its limit comes back.

    Args:
        chassis: The platform, its turn limit and its reversal angle.
        setpoints: Where the turrets stand.
        wanted: Unit direction; a wheel that it does not move may stand at any angle.

    """
    most, reversal = chassis.limits.cables_end, chassis.limits.reversal_angle
    angles, signs, ways = [], [], bearings(chassis.arms, wanted)
    for angle, way, sign in zip(setpoints.angles, ways, setpoints.signs, strict=True):
        near = min(max(angle, -most), most)
        if way is None:
            angles.append(near)
            signs.append(sign)
            continue
        forwards = near + wrap(way - near)
        backwards = forwards + pi
        _, _, goal, sign_there = min(
            (s == BACKWARDS or turn > reversal, turn, goal, s)
            for s, goal in (
                (FORWARDS, forwards),
                (BACKWARDS, backwards),
                (BACKWARDS, backwards - tau),
            )
            for turn in [abs(goal - angle)]
            if abs(goal) <= most + ROUNDING
        )
        angles.append(min(max(goal, -most), most))
        signs.append(sign_there)
    return Goals(angles, signs, wanted)


def _stop(setpoints: Setpoints, limits: SteeringLimits, period: float) -> None:
    """Brake every turret for one step."""
    change = limits.steering_acceleration * usable_period(setpoints, period)
    setpoints.rates = rates = [changed(rate, 0.0, change) for rate in setpoints.rates]
    pairs = zip(setpoints.angles, rates, strict=True)
    setpoints.angles = [angle + rate * period for angle, rate in pairs]


def _turn(setpoints: Setpoints, goals: Goals, limits: SteeringLimits, period: float) -> bool:
    """Turn every turret for one step.

    Returns:
        Whether all stand exactly at their goals, and slowly enough to go on from there.

    """
    change = limits.steering_acceleration * usable_period(setpoints, period)
    braking, top = BRAKING * limits.steering_acceleration, limits.steering_rate
    angles, rates, arrived = [], [], True
    each = zip(setpoints.angles, setpoints.rates, goals.angles)  # noqa: B905 - hot
    for angle, before, goal in each:
        way = goal - angle
        fastest = min(top, braking_rate(abs(way), braking, period))
        rate = min(max(fastest if way > 0.0 else -fastest, before - change), before + change)
        there = abs(angle + rate * period - goal) < ARRIVED
        angles.append(goal if there else angle + rate * period)
        rates.append(rate)
        arrived = arrived and there and abs(rate) <= BRAKING * change
    setpoints.angles, setpoints.rates = angles, rates
    return arrived
