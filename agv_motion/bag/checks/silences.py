"""Silences of a topic, judged by the times of its messages alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

FEWEST = 10
"""messages that have a usual interval"""
_SHARE, _SPREAD = 0.9, 1.5


class TopicSilence(NamedTuple):
    """Messages were expected and did not come."""

    after: int
    """[ns] the message before it"""
    length: int
    """[ns]"""
    usual: int
    """[ns] median of the intervals"""
    missing: int
    """messages, about"""


def regular(stamps: NDArray[np.int64]) -> bool:
    """Return whether nine in ten intervals are at most 1.5 times the median (and two thirds of it).

    Args:
        stamps: (n,) [ns], in any order.

    """
    if len(stamps) < FEWEST:
        return False
    steps = np.diff(np.sort(stamps)).astype(np.float64)
    usual = float(np.median(steps))
    near = (steps <= _SPREAD * usual) & (steps >= usual / _SPREAD)
    return usual > 0 and float(near.mean()) >= _SHARE


def silences(stamps: NDArray[np.int64], factor: float, longer: float = 0.0) -> list[TopicSilence]:
    """Return the intervals that are longer than ``factor`` times the median.

    Args:
        stamps: (n,) [ns], in any order.
        factor: At least 1.
        longer: [s] ... and longer than this.

    """
    ordered = np.sort(stamps)
    steps = np.diff(ordered)
    if not len(steps):
        return []
    usual = int(np.median(steps))
    long = np.flatnonzero((steps > factor * usual) & (steps > longer * 1e9))
    return [
        TopicSilence(
            int(ordered[i]), int(steps[i]), usual, round(steps[i] / usual) - 1 if usual else 0
        )
        for i in long
    ]
