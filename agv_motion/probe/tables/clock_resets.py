"""Rows that a logger wrote after its clock had begun anew: their time cannot be known."""

from __future__ import annotations

from datetime import datetime, timezone
from itertools import pairwise
from math import inf
from typing import TYPE_CHECKING

from agv_motion.probe.tables.time_readers import DAY

if TYPE_CHECKING:
    from collections.abc import Sequence

BEGINNINGS = tuple(datetime(year, 1, 1, tzinfo=timezone.utc).timestamp() for year in (1990, 2000))
"""[s] since 1970, by the clock of the logger, at which one begins that has lost its battery"""
YEAR = 365.0 * DAY
REASON = 'the clock had begun anew'


def after_reset(shown: Sequence[float]) -> list[bool]:
    """Tell of each row whether the clock had begun anew, and was not set yet.

    It fell by more than a year to one of the `BEGINNINGS`, and is set once it is beyond where it
    fell; or the first row is at one, and the clock was set forward by more than a year later.

    Args:
        shown: What the clock showed [s since 1970], in the order in which rows were written.

    """
    found, lost, before = [], _begins_unset(shown), inf
    right: float | None = None
    for seconds in shown:
        if lost:
            lost = seconds - before <= YEAR if right is None else seconds < right
        elif right is not None:
            lost = right - seconds > YEAR and _is_beginning(seconds)
        before = seconds
        if not lost:
            right = seconds
        found.append(lost)
    return found


def _begins_unset(shown: Sequence[float]) -> bool:
    begins = bool(shown) and _is_beginning(shown[0])
    return begins and any(b - a > YEAR for a, b in pairwise(shown))


def _is_beginning(seconds: float) -> bool:
    return any(0.0 <= seconds - begin < DAY for begin in BEGINNINGS)
