"""Time as a tree lives through it: it never runs back, and no leap or hiccup counts for more."""

from __future__ import annotations


class LivedTime:
    """Sums up the steps of its clocks, each as far as it makes sense.

    Of several clocks the one that goes fastest counts: a simulated clock that stands, or creeps,
    must not keep a tree from finding out that another has fallen silent, nor from speaking itself.
    """

    def __init__(self, most: float) -> None:
        """Begin at zero.

        Args:
            most: A longer step between two looks at a clock counts as so much [s]: what came
                while nobody listened waits to be heard.

        """
        self._most = most
        self._last: tuple[float, ...] = ()
        self.seconds = 0.0

    def update(self, *clocks: float) -> float:
        """Return how long the tree has lived [s] when each of its clocks shows so much [s]."""
        steps = [now - last for now, last in zip(clocks, self._last or clocks, strict=True)]
        self.seconds += min(max(0.0, *steps), self._most)
        self._last = clocks
        return self.seconds
