"""The signals of a tree, s1 speed, s2 rotation, s3 places, from its probes and what they lost."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.probe.loss import NOTHING, LossStep, SapFlowEstimate

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.probe.probe import ProbeReading

NEUTRAL = 0.0, 0.5, 0.5
"""Of s1, s2 and s3: stand, do not turn, as well here as anywhere."""
HALF = 0.5
"""Weight of what is merely usual, against what is neutral."""


class Signals(NamedTuple):
    """What the tree may move by."""

    values: tuple[float, ...]
    """(s1, s2, s3) in [0, 1]; empty where the tree must rest"""
    doubt: str
    """why it must rest; empty where it need not"""
    losses: str
    """which probes are lost, and what stands in for each; empty where all are measured"""


def signals_of(
    chosen: Sequence[int], readings: Sequence[ProbeReading | None], enough: int
) -> Signals:
    """Return what the tree may move by.

    Args:
        chosen: Which probes are s1, s2 and s3, from 0.
        readings: Of each probe, the last.
        enough: Signals that must be known: with 2 the mean of two stands in for the third.

    """
    estimates = [_estimate(readings[i]) for i in chosen]
    values = [_weighted(each, rest) for each, rest in zip(estimates, NEUTRAL, strict=True)]
    losses = {
        i: f'probe_{i + 1} {_condition(readings[i])}: {each.step.value}'
        for i, each in zip(chosen, estimates, strict=True)
        if each.step is not LossStep.MEASURED
    }
    lost = [axis for axis, value in enumerate(values) if value is None]
    if len(lost) == 1 and enough < len(values):
        axis = lost[0]
        others = [each.value for each in estimates if each.step is LossStep.MEASURED]
        known = [value for value in others if value is not None]
        if len(known) >= enough:
            values[axis] = sum(known) / len(known)
            i = chosen[axis]
            losses[i] = f'probe_{i + 1} {_condition(readings[i])}: the mean of the others'
            lost = []
    if lost:
        return Signals((), doubt_of(chosen[lost[0]], readings[chosen[lost[0]]]), '')
    return Signals(tuple(v for v in values if v is not None), '', '; '.join(losses.values()))


def _estimate(reading: ProbeReading | None) -> SapFlowEstimate:
    return NOTHING if reading is None else reading.estimate


def _weighted(estimate: SapFlowEstimate, neutral: float) -> float | None:
    if estimate.step is LossStep.CLIMATOLOGY and estimate.value is not None:
        return neutral + HALF * (estimate.value - neutral)
    return estimate.value


def _condition(reading: ProbeReading | None) -> str:
    if reading is None:
        return 'has given no reading yet'
    return f'is {reading.quality.value}' if not reading.quality.usable else 'is learning'


def doubt_of(index: int, reading: ProbeReading | None) -> str:
    """Return why nothing can be known of a probe, which is counted from 0."""
    learning = reading is not None and reading.quality.usable
    more = ' its zero flow and range' if learning else ''
    return f'probe_{index + 1} {_condition(reading)}{more}'
