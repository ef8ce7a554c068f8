"""Merge runs of messages that may overlap in time, opening each as late as possible."""

from __future__ import annotations

from bisect import bisect_left
from heapq import heappop, heappush, heapreplace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from numpy.typing import NDArray

    from agv_motion.bag.connection import Message

LONGEST = 4096
"""Messages handed out in one go, so that little is held at a time."""
LATEST = 2**64 - 1
"""[ns] Stamps are unsigned numbers of 64 bits: none is later."""


class Run(NamedTuple):
    """Messages of one chunk in the order of time."""

    stamps: list[int]
    """[ns]"""
    messages: Callable[[int, int], Iterator[Message]]
    """what yields those from one number up to another"""


def inside(stamps: NDArray[np.uint64], start: int, stop: int) -> NDArray[np.bool_]:
    """Return which stamps lie from ``start`` to before ``stop`` [ns]."""
    if stop <= start:
        return np.zeros(len(stamps), bool)
    last = np.uint64(min(stop - 1, LATEST))
    return np.asarray((stamps >= np.uint64(min(start, LATEST))) & (stamps <= last))


def in_time_order(runs: Iterable[tuple[int, int, Callable[[], Run | None]]]) -> Iterator[Message]:
    """Yield the messages of all runs by their stamps; of equal ones, as they lie in the file.

    Args:
        runs: Earliest stamp [ns], place in the file and what opens the run, in the order of stamps.

    """
    waiting = iter(runs)
    following = next(waiting, None)
    heap: list[tuple[int, int, int]] = []
    opened: dict[int, Run] = {}
    while following is not None or heap:
        while following is not None and (not heap or following[0] <= heap[0][0]):
            _, place, open_run = following
            run = open_run()
            if run is not None and run.stamps:
                opened[place] = run
                heappush(heap, (run.stamps[0], place, 0))
            following = next(waiting, None)
        if not heap:
            continue
        _, which, first = heap[0]
        run = opened[which]
        others = [entry[0] for entry in heap[1:3]]
        limit = min(others + ([following[0]] if following else []), default=2**64)
        last = max(first + 1, bisect_left(run.stamps, limit, first))
        last = min(last, first + LONGEST)
        yield from run.messages(first, last)
        if last < len(run.stamps):
            heapreplace(heap, (run.stamps[last], which, last))
        else:
            heappop(heap)
            del opened[which]
