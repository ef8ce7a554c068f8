"""What the benchmarks share: one row of the table, and the median time of a call."""

from __future__ import annotations

import statistics
import time
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable


class Row(NamedTuple):
    """One comparison; times in seconds."""

    what: str
    ours: float
    peer: str = ''
    theirs: float = 0.0
    target: str = ''
    plain: bool = False
    """whether ``ours`` is a number and no time"""


def per_call(act: Callable[[], Any], calls: int = 2000, rounds: int = 15) -> float:
    """Return the median time of one call [s]."""
    times = []
    for _ in range(rounds):
        begin = time.perf_counter()
        for _ in range(calls):
            act()
        times.append((time.perf_counter() - begin) / calls)
    return statistics.median(times)
