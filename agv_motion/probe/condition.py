"""How each probe is, and since when: for programs, beside the words of its quality."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.probe.probe import ProbeReading

NO_READING, LEARNING = 'no reading', 'learning'
"""Conditions beside those of `Quality`: of a probe that has said nothing yet, and of one that can
be believed, but whose zero flow and range are not known yet."""


def condition(reading: ProbeReading | None) -> str:
    """Return how a probe is, in a word: a `Quality`, `NO_READING` or `LEARNING`."""
    if reading is None:
        return NO_READING
    if reading.quality.usable and reading.sap_flow is None:
        return LEARNING
    return reading.quality.value


class ProbeConditions:
    """Remembers since when each probe has been as it is."""

    def __init__(self, assign: Sequence[str], count: int) -> None:
        """Know of no reading.

        Args:
            assign: Names of the probes that are s1, s2 and s3.
            count: Number of probes.

        """
        self._signals = dict(zip(assign, ('s1', 's2', 's3'), strict=False))
        self._known: list[tuple[str, float]] = [(NO_READING, 0.0)] * count

    def update(self, now: float, readings: Sequence[ProbeReading | None]) -> None:
        """Take up how the probes are at ``now`` [s]."""
        for i, reading in enumerate(readings):
            word = condition(reading)
            if word != self._known[i][0]:
                self._known[i] = word, now

    def values(self, readings: Sequence[ProbeReading | None]) -> dict[str, str]:
        """Return what is known of each probe, by name: condition, since when, signal and values."""
        values = {}
        for i, (reading, (word, since)) in enumerate(zip(readings, self._known, strict=True)):
            name = f'probe_{i + 1}'
            values[f'{name} condition'] = word
            values[f'{name} since [s]'] = f'{since:.1f}'
            values[f'{name} signal'] = self._signals.get(name, '')
            if reading is not None:
                values[f'{name} known by'] = reading.estimate.step.value
                values[f'{name} dT [K]'] = f'{reading.temperature_difference:.3f}'
                if reading.flux_density is not None:
                    values[f'{name} flux density [m/s]'] = f'{reading.flux_density:.4e}'
                if reading.sap_flow is not None:
                    values[f'{name} sap flow'] = f'{reading.sap_flow:.3f}'
        return values
