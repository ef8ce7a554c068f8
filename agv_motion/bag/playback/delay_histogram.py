"""How late messages were sent, kept in bounded memory however long it goes."""

from __future__ import annotations

from math import inf

RESOLUTION = 1e-5
"""[s] width of a bin"""
BINS = 10_000
"""up to 100 ms; beyond, only the worst is known exactly"""


class DelayHistogram:
    """Counts delays in bins of 10 us."""

    def __init__(self) -> None:
        """Start with no delay."""
        self.count = 0
        self.worst = 0.0
        """[s]"""
        self._bins = [0] * (BINS + 1)

    def add(self, delay: float) -> None:
        """Count a delay [s]; one below zero counts as none."""
        self.count += 1
        self.worst = max(self.worst, delay)
        self._bins[min(max(int(delay / RESOLUTION), 0), BINS)] += 1

    def quantile(self, share: float) -> float:
        """Return the delay [s] that ``share`` of all stay below; 0 without any."""
        wanted, seen = share * self.count, 0
        for i, count in enumerate(self._bins):
            seen += count
            if seen >= wanted:
                return min((i + 1) * RESOLUTION if i < BINS else inf, self.worst)
        return self.worst

    def share_within(self, delay: float) -> float:
        """Return the share of messages at most ``delay`` [s] late; 1 without any."""
        within = sum(self._bins[: int(delay / RESOLUTION)])
        return within / self.count if self.count else 1.0

    def __str__(self) -> str:
        """Return the figures in a line."""
        return (
            f'{self.count} messages, late by {self.quantile(0.5) * 1e3:.2f} ms (median), '
            f'{self.quantile(0.99) * 1e3:.2f} ms (99 %), {self.worst * 1e3:.2f} ms (worst); '
            f'{self.share_within(0.002):.1%} within 2 ms'
        )
