"""Probes that fail over a season: does the tree ever move by noise, or rest before it must?"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from enum import Enum
from math import exp, log, nan
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.probe.loss import LossParameters, LossStep
from agv_motion.probe.parameters import ProbeParameters
from agv_motion.probe.probe import Probe, ProbeReading
from agv_motion.probe.signals import Signals, signals_of
from agv_motion.probe.sources.simulated import SimulatedSource, SimulatedSourceParameters

if TYPE_CHECKING:
    from collections.abc import Iterator

DAY, HOUR = 86400.0, 3600.0
BEGIN = 1_430_438_400.0
"""[s] since 1970: 1 May 2015"""
LEARNING = 4.0 * DAY
"""[s] before the first failure"""
PROBES = 0, 1, 2
BACK = 11
"""Readings until what comes back has a level, and stands still on it."""
FORGOTTEN = 15
"""Readings before it that are not trusted either, once noise is known."""
NOTICED = 20
"""Readings after which noise on the right level is known to be noise."""
LADDER = LossParameters(hold=900.0, trend=3600.0, climatology=10800.0)


class ProbeFault(Enum):
    """What happens to a probe."""

    CUT = 'its wire is cut: no value'
    COLD = 'its heater is off: noise about nothing'
    HALF_DEAD = 'noise up to the threshold of 5 K'
    FREE = 'a wire that hangs free: noise on any level'
    WILD = 'values beyond belief'


class Failure(NamedTuple):
    """One probe that fails for a while."""

    probe: int
    fault: ProbeFault
    begin: float
    """[s] since 1970"""
    end: float
    level: float
    """[K] of the noise"""

    def reads(self, rng: random.Random) -> float:
        """Return what the probe shows now [K]."""
        return {
            ProbeFault.CUT: nan,
            ProbeFault.COLD: abs(rng.gauss(0.0, 1.0)),
            ProbeFault.HALF_DEAD: rng.uniform(-4.9, 4.9),
            ProbeFault.FREE: rng.gauss(self.level, 0.08 * self.level),
            ProbeFault.WILD: rng.uniform(70.0, 900.0),
        }[self.fault]


@dataclass(frozen=True)
class LossTrialParameters:
    """How long, how often."""

    days: float = 120.0
    failures: int = 100
    step: float = 300.0
    """[s] between readings"""
    seed: int = 1
    loss: LossParameters = field(default_factory=lambda: LADDER)


class LossTally(NamedTuple):
    """What came of it."""

    failures: int
    by_noise: int
    """readings of a failed probe that were believed after it could be known"""
    early: int
    """steps at rest before the ladder ends, or after all probes are back"""
    late: int
    """steps in motion after it ends"""
    rested: float
    """[h] in all"""
    allowed: float
    """[h] of rest by the ladder at most, and until what comes back stands still"""
    error: float
    """largest difference of a signal to that of the same tree without failures, while it is held or
    goes on by its trend"""


def failures_of(given: LossTrialParameters) -> list[Failure]:
    """Return failures one after another, of ten minutes to a day, with time to come back."""
    rng = random.Random(given.seed)  # noqa: S311 - weather, no secret
    share = (given.days * DAY - LEARNING) / given.failures
    found = []
    for i in range(given.failures):
        longest = min(share - 3.0 * HOUR, DAY)
        length = exp(rng.uniform(log(600.0), log(longest)))
        begin = BEGIN + LEARNING + i * share + rng.uniform(0.0, share - 2.0 * HOUR - length)
        fault = list(ProbeFault)[i % len(ProbeFault)]
        found.append(
            Failure(rng.choice(PROBES), fault, begin, begin + length, rng.uniform(6.0, 20.0))
        )
    return found


class Tree:
    """Three probes, and what the tree may move by."""

    def __init__(self, loss: LossParameters) -> None:
        """Know nothing."""
        self._enough = loss.enough
        self._probes = [Probe(ProbeParameters(loss=loss)) for _ in PROBES]
        self.readings: list[ProbeReading | None] = [None for _ in PROBES]

    def update(self, time: float, values: tuple[float, ...]) -> Signals:
        """Take in readings [K] of ``time`` [s]."""
        for i, probe in enumerate(self._probes):
            self.readings[i] = probe.update(time, values[i])
        return signals_of(PROBES, self.readings, self._enough)


def trial(given: LossTrialParameters) -> LossTally:
    """Return what a tree makes of its failures, beside the same tree without any."""
    found = failures_of(given)
    counts = [0, 0, 0, 0, 0]
    error = 0.0
    ladder = given.loss.hold + given.loss.trend + given.loss.climatology
    warm = ProbeParameters().settling + given.step
    back, noticed = max(BACK * given.step, warm), NOTICED * given.step
    for time, failure, told, true, reading in _steps(given, found):
        since = time - failure.begin
        failed, resting = failure.begin <= time < failure.end, not told.values
        may_rest = since > ladder - FORGOTTEN * given.step and time < failure.end + back
        known = since >= noticed or failure.fault is not ProbeFault.FREE
        step = reading.estimate.step
        counts[0] += failed and known and step is LossStep.MEASURED
        counts[1] += resting and not may_rest
        counts[2] += failed and known and not resting and since > ladder + noticed
        counts[3] += resting
        counts[4] += may_rest
        if step in {LossStep.HELD, LossStep.TREND} and true.values and told.values:
            error = max(error, *(abs(a - b) for a, b in zip(told.values, true.values, strict=True)))
    by_noise, early, late, rested, allowed = counts
    hours = given.step / HOUR
    return LossTally(len(found), by_noise, early, late, rested * hours, allowed * hours, error)


def _steps(
    given: LossTrialParameters, found: list[Failure]
) -> Iterator[tuple[float, Failure, Signals, Signals, ProbeReading]]:
    """Yield, once all is learnt: time, the last failure, signals with and without it, its probe."""
    source = SimulatedSource(SimulatedSourceParameters(seed=given.seed, period=given.step), 0.0)
    rng = random.Random(given.seed + 1)  # noqa: S311 - noise, no secret
    tree, twin = Tree(given.loss), Tree(given.loss)
    i = -1
    for k in range(int(given.days * DAY / given.step)):
        time = BEGIN + k * given.step
        while i + 1 < len(found) and found[i + 1].begin <= time:
            i += 1
        values = source.sample(time, 1.0).values
        true, shown = twin.update(time, values), list(values)
        if i >= 0 and time < found[i].end:
            shown[found[i].probe] = found[i].reads(rng)
        told = tree.update(time, tuple(shown))
        reading = tree.readings[found[i].probe]
        if i >= 0 and reading is not None:
            yield time, found[i], told, true, reading
