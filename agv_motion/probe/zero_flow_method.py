"""Which reading of the last nights is zero flow: four methods, each from the past alone.

A night gives one value, its highest reading before dawn. What these values make of dT_max:

- pre-dawn: that of the last night; every night is taken for one without flow
- moving window: the highest of the last n nights; one of them will have been without flow
- double regression: the mean of the last n nights, and again of those not below it
- environment: that of the last night whose air was dark and moist and whose dT stood still

Sources: P. J. Lu et al., Acta Botanica Sinica 46, 2004 (double regression); R. L. Peters et al.,
New Phytologist 219, 2018, and the R package TREX (all four). There windows lie round a day, here
before it: a robot cannot look ahead.
"""

from __future__ import annotations

from enum import Enum
from math import fsum
from typing import TYPE_CHECKING, Protocol

from agv_motion.probe.environment import Environment, EnvironmentParameters, QuietAir

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


ROUNDED = 1e-10
"""Share by which a mean may be rounded: nights of a coarse logger often lie on it."""


class ZeroFlowMethod(Protocol):
    """Says which nights count, how long, and what they make of dT_max."""

    days: int
    """A night that is older is forgotten."""

    def observe(self, time: float, temperature_difference: float, environment: Environment) -> None:
        """Take in a good reading [K] at ``time`` [s], by day and by night."""

    def counts(self) -> bool:
        """Tell whether the last reading, if it is the highest of its night, tells zero flow."""

    def level(self, nights: Sequence[float]) -> float:
        """Return dT_max [K] of the highest readings of nights, one at least, the latest last."""


class _EveryNight:
    """What the methods have in common that ask nothing of a night."""

    def __init__(self, days: int) -> None:
        """Let a night count for ``days``."""
        self.days = days

    def observe(self, time: float, temperature_difference: float, environment: Environment) -> None:
        """Need no reading but the highest."""

    def counts(self) -> bool:
        """Take every night."""
        return True


class Predawn(_EveryNight):
    """The last night."""

    def level(self, nights: Sequence[float]) -> float:
        """Return its highest reading [K]."""
        return nights[-1]


class MovingWindow(_EveryNight):
    """The highest of the last nights."""

    def level(self, nights: Sequence[float]) -> float:
        """Return the highest reading of all nights [K]."""
        return max(nights)


class DoubleRegression(_EveryNight):
    """The mean of the last nights without those in which sap seems to have flowed."""

    def level(self, nights: Sequence[float]) -> float:
        """Return the mean of the nights that are not below the mean of all [K]."""
        mean = fsum(nights) / len(nights)
        high = [value for value in nights if value >= mean - ROUNDED * mean]
        return fsum(high) / len(high)


class EnvironmentDependent:
    """The last night in which no sap can have flowed."""

    def __init__(self, parameters: EnvironmentParameters) -> None:
        """Know of no reading."""
        self.days = parameters.days
        self._air = QuietAir(parameters)

    def observe(self, time: float, temperature_difference: float, environment: Environment) -> None:
        """Remember the last hours."""
        self._air.add(time, temperature_difference, environment)

    def counts(self) -> bool:
        """Tell whether they were dark, moist and still."""
        return self._air.is_quiet()

    def level(self, nights: Sequence[float]) -> float:
        """Return the highest reading of the last such night [K]."""
        return nights[-1]


class ZeroFlowMethodName(Enum):
    """The methods by name."""

    PREDAWN = 'predawn'
    MOVING_WINDOW = 'moving_window'
    DOUBLE_REGRESSION = 'double_regression'
    ENVIRONMENT = 'environment'


def method_of(name: str, days: int, environment: EnvironmentParameters) -> ZeroFlowMethod:
    """Return a method by its name.

    Args:
        name: Of a `ZeroFlowMethodName`.
        days: For which a night counts [d]; the environment has its own.
        environment: What it asks of a night.

    """
    chosen = ZeroFlowMethodName(name)
    if chosen is ZeroFlowMethodName.ENVIRONMENT:
        return EnvironmentDependent(environment)
    kinds: dict[ZeroFlowMethodName, Callable[[int], ZeroFlowMethod]] = {
        ZeroFlowMethodName.PREDAWN: Predawn,
        ZeroFlowMethodName.MOVING_WINDOW: MovingWindow,
        ZeroFlowMethodName.DOUBLE_REGRESSION: DoubleRegression,
    }
    return kinds[chosen](days)
