"""Turrets that turn while the platform rests: each for itself, as far as it must and no further."""

from __future__ import annotations

from math import copysign, cos, pi, sqrt, tau
from typing import TYPE_CHECKING

from agv_motion.kinematics.steering_state import STILL
from agv_motion.planar import wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.steering_limits import SteeringLimits
    from agv_motion.kinematics.steering_state import SteeringState

BRAKING = 0.5
"""Share of the acceleration with which a turret plans to brake: the rest is for uneven steps."""


def braking_rate(distance: float, acceleration: float, period: float) -> float:
    """Return the highest rate over the next step from which a stop after ``distance`` is possible.

    The rate of each later step is lower by ``acceleration * period``, so the way is
    ``v**2 / (2 a) + v period / 2``, to within ``a period**2 / 8``; within one step the distance
    itself is the limit.

    Args:
        distance: Way to the stop, zero or more [rad].
        acceleration: With which to brake [rad/s2].
        period: Length of a step [s].

    """
    half = 0.5 * period
    rate = acceleration * (sqrt(half * half + 2.0 * distance / acceleration) - half)
    return min(rate, distance / period)


def usable_period(state: SteeringState, period: float) -> float:
    """Return the time over which a rate may change from the last step to this one [s].

    Rates are means over a step, so they belong to its middle: half of both steps lie between. A
    short step after a long one counts as what it is, so the limit holds by either measure.
    """
    return min(period, 0.5 * (period + state.period)) if state.period > 0.0 else period


def turn_at_rest(state: SteeringState, limits: SteeringLimits, period: float) -> bool:
    """Turn every turret towards its goal for one step; without goals, bring all to a stop.

    Returns:
        Whether all turrets stand exactly at their goals, and slowly enough to go on from there.

    """
    change = limits.steering_acceleration * usable_period(state, period)
    braking = BRAKING * limits.steering_acceleration
    top, goals, angles, rates = limits.steering_rate, state.goals, state.angles, state.rates
    arrived = goals is not None
    for i, (angle, before) in enumerate(zip(angles, rates)):  # noqa: B905 - hot path
        wanted = 0.0
        if goals is not None:
            way = goals[i] - angle
            fastest = min(top, braking_rate(abs(way), braking, period))
            wanted = fastest if way > 0.0 else -fastest
        rate = min(max(wanted, before - change), before + change)
        there = goals is not None and abs(angle + rate * period - goals[i]) < 1e-12
        angles[i] = goals[i] if there and goals is not None else angle + rate * period
        rates[i] = rate
        arrived = arrived and there and abs(rate) <= BRAKING * change
    return arrived


def turn_free_turret(
    state: SteeringState, limits: SteeringLimits, i: int, line: float, period: float
) -> bool:
    """Turn turret ``i``, at the centre of rotation, for one step; the others wait.

    Its wheel stands still there, so the turret may turn alone, and either way along the line.

    Args:
        state: Of the platform, whose direction must rest.
        limits: Of the turrets.
        i: Which turret.
        line: Direction in which its wheel will move [rad].
        period: Length of the step [s].

    Returns:
        Whether the turret stands along the line, so that all may go on.

    """
    if state.velocity is not STILL:
        return False
    off = wrap(2.0 * (line - state.angles[i])) / 2.0
    if abs(state.angles[i] + off) > limits.turn_limit * tau:
        off -= copysign(pi, off)
    state.signs[i] = 1.0 if cos(line - state.angles[i] - off) > 0.0 else -1.0
    acceleration, before = limits.steering_acceleration, state.rates[i]
    change = acceleration * usable_period(state, period)
    if abs(off) < 1e-9 and abs(before) <= BRAKING * change:
        state.free_turret = -1
        return True
    rate = min(limits.steering_rate, braking_rate(abs(off), BRAKING * acceleration, period))
    _set_rate(state, i, min(max(copysign(rate, off), before - change), before + change), period)
    state.free_turret = i
    return False


def brake_free_turret(state: SteeringState, limits: SteeringLimits, period: float) -> None:
    """Bring a turret that turns at the centre of rotation to a stop: it is not needed any more."""
    i = state.free_turret
    change = limits.steering_acceleration * usable_period(state, period)
    _set_rate(state, i, min(max(0.0, state.rates[i] - change), state.rates[i] + change), period)
    if state.rates[i] == 0.0:
        state.free_turret = -1


def _set_rate(state: SteeringState, i: int, rate: float, period: float) -> None:
    state.rates[i] = rate
    state.angles[i] += rate * period


def choose_goals(
    state: SteeringState, bearings: Sequence[float | None], limits: SteeringLimits
) -> tuple[list[float], list[float]]:
    """Return for each turret the angle to turn to, and -1 where its wheel shall roll backwards.

    Of all angles within the turn limit along the same line, the nearest; one that keeps the wheel
    rolling forwards is preferred up to the reversal angle. A turret beyond its limit comes back.

    Args:
        state: Where the turrets stand.
        bearings: (n,) directions in which the wheels shall move [rad]; None: any will do.
        limits: The turn limit and the reversal angle.

    """
    most, goals, signs = limits.turn_limit * tau, [], []
    for angle, bearing, sign in zip(state.angles, bearings, state.signs, strict=True):
        near = min(max(angle, -most), most)
        if bearing is None:
            goals.append(near)
            signs.append(sign)
            continue
        forwards = near + wrap(bearing - near)
        _, _, goal, sign_there = min(
            (s < 0.0 or turn > limits.reversal_angle, turn, goal, s)
            for s, first in ((1.0, forwards), (-1.0, forwards + pi))
            for goal in (first - 2.0 * tau, first - tau, first, first + tau, first + 2.0 * tau)
            for turn in [abs(goal - angle)]
            if abs(goal) <= most
        )
        goals.append(goal)
        signs.append(sign_there)
    return goals, signs
