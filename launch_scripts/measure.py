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


def per_call(
    act: Callable[[], Any], calls: int = 2000, rounds: int = 15,
    clock: Callable[[], float] = time.perf_counter,
) -> float:  # fmt: skip
    """Return the median time of one call [s]."""
    times = []
    for _ in range(rounds):
        begin = clock()
        for _ in range(calls):
            act()
        times.append((clock() - begin) / calls)
    return statistics.median(times)
