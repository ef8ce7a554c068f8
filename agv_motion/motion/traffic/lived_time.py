"""Time as a tree lives through it: it never runs back, and no leap or hiccup counts for more."""

from __future__ import annotations


class LivedTime:
    """Sums up the steps of a clock, each as far as it makes sense."""

    def __init__(self, most: float) -> None:
        """Begin at zero.

        Args:
            most: A longer step between two looks at the clock counts as so much [s]: what came
                while nobody listened waits to be heard.

        """
        self._most = most
        self._last: float | None = None
        self.seconds = 0.0

    def update(self, clock: float) -> float:
        """Return how long the tree has lived [s] when ``clock`` shows so much [s]."""
        if self._last is not None:
            self.seconds += min(max(clock - self._last, 0.0), self._most)
        self._last = clock
        return self.seconds
