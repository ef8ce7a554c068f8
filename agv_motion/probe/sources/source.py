"""The one interface of all sources, so that every node runs against either."""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING, NamedTuple, Protocol

from agv_motion.probe.environment import UNKNOWN, Environment

if TYPE_CHECKING:
    from collections.abc import Iterable


class ProbeSample(NamedTuple):
    """One line of a logger: all probes at one time."""

    time: float
    """[s] since 1970, UTC, when the probes were read"""
    values: tuple[float, ...]
    """[K] temperature difference of each probe, NaN where there is none"""
    environment: Environment = UNKNOWN
    """the air round the tree, where the logger tells it"""


class ProbeSource(Protocol):
    """Delivers samples as they fall due."""

    @property
    def period(self) -> float:
        """Usual time between samples on the node's clock [s]."""

    def history(self, now: float) -> Iterable[ProbeSample]:
        """Return what was measured before ``now`` [s], in order, to learn from."""

    def read(self, now: float) -> list[ProbeSample]:
        """Return the samples that fell due since the last call; never waits.

        Args:
            now: Time of the node's clock [s].

        """

    def complaint(self) -> str:
        """Return what went wrong since the last call, in words; empty if nothing did."""

    def close(self) -> None:
        """Let go of files and lines."""


KELVIN_PER_MILLIVOLT = 25.0
"""[K/mV] of a type T thermocouple at 40 uV/K."""

MOST = 1e5
"""[K] No two needles differ by more: what is read beyond is no temperature."""

UNITS = ('K', 'mV', 'V', 'uV')


def kelvin_per(unit: str, kelvin_per_millivolt: float = KELVIN_PER_MILLIVOLT) -> float:
    """Return the factor from ``unit`` (one of `UNITS`) to kelvin."""
    return {
        'K': 1.0,
        'mV': kelvin_per_millivolt,
        'V': 1e3 * kelvin_per_millivolt,
        'uV': 1e-3 * kelvin_per_millivolt,
    }[unit]


def kelvin(value: float, factor: float) -> float:
    """Return a value of a logger times ``factor`` in kelvin; NaN where it is no temperature."""
    difference = value * factor
    return difference if abs(difference) <= MOST else nan
