"""Rates that fall in time: how fast a turret may turn so that it stops where it should."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from agv_motion.kinematics.steering.state import Setpoints

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
    whole = distance / period
    return whole if whole < rate else rate


def usable_period(setpoints: Setpoints, period: float) -> float:
    """Return the time over which a rate may change from the last step to this one [s].

    Rates are means over a step, so they belong to its middle: half of both steps lie between. A
    short step after a long one counts as what it is, so the limit holds by either measure.
    """
    last = setpoints.period
    return 0.5 * (period + last) if 0.0 < last < period else period


def changed(rate: float, wanted: float, change: float) -> float:
    """Return ``rate``, brought by no more than ``change`` towards ``wanted`` [rad/s]."""
    return min(max(wanted, rate - change), rate + change)
