"""When to try again what did not succeed: after pauses that grow."""

from __future__ import annotations

import time as wall

LONGEST_PAUSE = 30.0
"""[s] Between two attempts; the first comes after one second."""


class Attempts:
    """Attempts to reach what is gone; begun anew once it is there."""

    def __init__(self) -> None:
        """Be due at once."""
        self._pause, self._at = 1.0, 0.0

    def due(self) -> bool:
        """Tell whether the pause is over."""
        return wall.monotonic() >= self._at

    def fail(self) -> float:
        """Return after how long to try again [s]."""
        pause, self._pause = self._pause, min(2.0 * self._pause, LONGEST_PAUSE)
        self._at = wall.monotonic() + pause
        return pause
