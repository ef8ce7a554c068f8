"""How often somebody may do something: buckets that fill by the clock."""

from __future__ import annotations

import time
from collections import OrderedDict
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

MOST_KEYS = 10_000
"""that are remembered; the one that was longest quiet is forgotten first"""


class RateLimit:
    """So many at once, and then so many a second, for each key by itself."""

    def __init__(
        self, burst: float, rate: float, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Begin with full buckets.

        Args:
            burst: How many at once.
            rate: How many a second in the long run [1/s].
            clock: Returns seconds that never go back.

        """
        self._burst, self._rate, self._clock = burst, rate, clock
        self._levels: OrderedDict[str, tuple[float, float]] = OrderedDict()
        """what is left of each key, and when that was so"""

    def allows(self, key: str, cost: float = 1.0) -> bool:
        """Return whether ``key`` may once more, and count it: as ``cost``, where that is larger."""
        now = self._clock()
        level, since = self._levels.pop(key, (self._burst, now))
        level = min(level + (now - since) * self._rate, self._burst)
        allowed = level >= cost
        self._levels[key] = level - cost if allowed else level, now
        if len(self._levels) > MOST_KEYS:
            self._levels.popitem(last=False)
        return allowed
