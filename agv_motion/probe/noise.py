"""Noise: a wire that hangs free shows any voltage, and each value has nothing to do with the last.

The sap of a tree changes over hours. How far a reading lies from the line through those beside it
is below 0.5 % of it in 99.9 % of the readings of a real spruce over 2.7 years (a quarter of an
hour apart), and four of five in a row are above 1.5 % in six of 68,000. A probe that varies as
noise does is off.
"""

from __future__ import annotations

from collections import deque

WINDOW = 7
"""Readings that are looked at; all but the first and the last have two beside them."""
MOST = 4
"""Readings off their line from which on all of them are noise."""

DOUBTFUL = 2 * WINDOW
"""Readings that may have been noise before it was known."""


class NoiseWatch:
    """The last readings, and whether they are noise."""

    def __init__(self, limit: float) -> None:
        """Start without a past; ``limit`` is the largest share off the line that is no noise."""
        self._limit = limit
        self._last: deque[tuple[float, float]] = deque(maxlen=DOUBTFUL)
        self._off: deque[bool] = deque(maxlen=WINDOW - 2)

    def add(self, time: float, value: float) -> bool:
        """Take in a reading, positive [K], at ``time`` [s]; return whether the last are noise."""
        if len(self._last) > 1:
            before, middle = self._last[-2][1], self._last[-1][1]
            self._off.append(abs(middle - 0.5 * (before + value)) > self._limit * middle)
        self._last.append((time, value))
        return sum(self._off) >= MOST

    def is_quiet(self) -> bool:
        """Tell whether all that are looked at lie on their lines."""
        return len(self._off) == WINDOW - 2 and not any(self._off)

    @property
    def since(self) -> float:
        """When the readings begin that are doubtful if the last ones are noise [s]."""
        return self._last[0][0]

    def clear(self) -> None:
        """Forget all readings."""
        self._last.clear()
        self._off.clear()
