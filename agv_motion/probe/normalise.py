"""Normalisation of a probe into [0, 1], by what the probe itself has shown."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections import deque
from math import isfinite
from typing import Any, Protocol

from agv_motion.errors import ConfigurationError

TINY = 1e-12
"""A range that is none."""


class Normaliser(Protocol):
    """Turns a stream of values into shares of their usual range; causal."""

    def update(self, time: float, value: float) -> float | None:
        """Take in ``value`` at ``time`` [s]; return its share in [0, 1], None while learning."""

    def distrust(self, since: float) -> None:
        """Take back what came from ``since`` [s] on."""

    def state(self) -> dict[str, Any]:
        """Return what must survive a restart, ready for JSON."""

    def restore(self, state: dict[str, Any]) -> None:
        """Take up a :meth:`state`; raises ConfigurationError if it is not one."""


class RecentMeans:
    """Means over bins of fixed length, of the last days: memory does not grow with the rate.

    Seven days of quarter hours are 672 numbers, kept sorted.
    """

    def __init__(self, window: float, bin_length: float) -> None:
        """Start without history.

        Args:
            window: How far back to look [s].
            bin_length: Length of one bin [s].

        """
        self._window, self._bin_length = window, bin_length
        self._bins: deque[tuple[float, float]] = deque()
        self._sorted: list[float] = []
        self._open: tuple[int, float, int] | None = None
        """number of the bin, sum and count of its values"""

    def __len__(self) -> int:
        """Return the number of finished bins."""
        return len(self._sorted)

    def add(self, time: float, value: float) -> None:
        """Take in ``value`` at ``time`` [s]; its own bin counts once it is finished."""
        index = int(time // self._bin_length)
        begun, self._open = self._open, (index, value, 1)
        if begun is not None:
            number, total, count = begun
            if number == index:
                self._open = index, total + value, count + 1
            else:
                self._close(number * self._bin_length, total / count)
        while self._bins and abs(time - self._bins[0][0]) > self._window:
            _, old = self._bins.popleft()
            del self._sorted[bisect_left(self._sorted, old)]

    def distrust(self, since: float) -> None:
        """Forget the bins in which anything lies that came from ``since`` [s] on."""
        self._open = None
        while self._bins and self._bins[-1][0] + self._bin_length > since:
            _, mean = self._bins.pop()
            del self._sorted[bisect_left(self._sorted, mean)]

    def quantile(self, share: float) -> float:
        """Return the mean below which ``share`` of all finished ones lie."""
        return self._sorted[min(int(share * len(self._sorted)), len(self._sorted) - 1)]

    def finished(self) -> list[list[float]]:
        """Return when each finished bin began [s], and its mean."""
        return [[time, mean] for time, mean in self._bins]

    def restore(self, bins: list[tuple[float, float]]) -> None:
        """Take up the bins of an earlier run."""
        self._bins = deque(bins)
        self._sorted = sorted(mean for _, mean in bins)

    def _close(self, time: float, mean: float) -> None:
        self._bins.append((time, mean))
        insort(self._sorted, mean)


class RunningQuantiles:
    """Share of the way between two quantiles of the last days: forgets spikes and seasons."""

    def __init__(
        self,
        quantiles: tuple[float, float],
        window_days: float,
        smallest_range: float,
        learning_hours: float = 24.0,
        bin_length: float = 900.0,
    ) -> None:
        """Start without history.

        Args:
            quantiles: The two quantiles that become 0 and 1.
            window_days: How far back to look [d].
            smallest_range: A range below this counts as this, and a share of it for the less the
                smaller the range: noise moves nothing [unit of the value].
            learning_hours: How much history is needed before a share is given [h].
            bin_length: Length of one bin [s].

        """
        self._low, self._high = quantiles
        self._smallest_range = smallest_range
        self._learning_bins = learning_hours * 3600.0 / bin_length
        self._means = RecentMeans(window_days * 86400.0, bin_length)

    def update(self, time: float, value: float) -> float | None:
        """Return the share of ``value`` between the quantiles of the bins before it."""
        means = self._means
        means.add(time, value)
        if len(means) < self._learning_bins:
            return None
        low, high = means.quantile(self._low), means.quantile(self._high)
        known = min((high - low) / self._smallest_range, 1.0) if self._smallest_range else 1.0
        share = (value - low) / max(high - low, self._smallest_range, TINY)
        return min(max(share * known, 0.0), 1.0)

    def distrust(self, since: float) -> None:
        """Forget what came from ``since`` [s] on."""
        self._means.distrust(since)

    def state(self) -> dict[str, Any]:
        """Return the bins."""
        return {'bins': self._means.finished()}

    def restore(self, state: dict[str, Any]) -> None:
        """Take up the bins of an earlier run."""
        try:
            bins = [(_finite(time), _finite(mean)) for time, mean in state['bins']]
        except (KeyError, TypeError, ValueError, OverflowError) as error:
            msg = f'saved bins are unreadable ({error!r:.120}): delete the state file'
            raise ConfigurationError(msg) from error
        self._means.restore(bins)


class RunningRange:
    """As the original installation: between the smallest and the largest value ever seen.

    Gives 1 until the range exceeds ``opening_range``, and never forgets a spike.
    """

    def __init__(self, opening_range: float) -> None:
        """Start without history; ``opening_range`` is in the unit of the value."""
        self._opening_range = opening_range
        self._smallest: float | None = None
        self._largest: float | None = None

    def update(self, time: float, value: float) -> float | None:  # noqa: ARG002 - the protocol's
        """Return the share of ``value`` in the range so far."""
        self._smallest = value if self._smallest is None else min(self._smallest, value)
        self._largest = value if self._largest is None else max(self._largest, value)
        span = self._largest - self._smallest
        return 1.0 if span <= self._opening_range else (value - self._smallest) / span

    def distrust(self, since: float) -> None:
        """Forget nothing, as the original did."""

    def state(self) -> dict[str, Any]:
        """Return both ends of the range."""
        return {'range': [self._smallest, self._largest]}

    def restore(self, state: dict[str, Any]) -> None:
        """Take up the range of an earlier run."""
        try:
            smallest, largest = state['range']
            if (smallest, largest) != (None, None):
                smallest, largest = sorted((_finite(smallest), _finite(largest)))
        except (KeyError, TypeError, ValueError, OverflowError) as error:
            msg = f'saved range is unreadable ({error!r:.120}): delete the state file'
            raise ConfigurationError(msg) from error
        self._smallest, self._largest = smallest, largest


def _finite(value: Any) -> float:
    """Return ``value`` as a number; raises ValueError or TypeError if it is no finite one."""
    number = float(value)
    if not isfinite(number):
        msg = f'{number} is not finite'
        raise ValueError(msg)
    return number
