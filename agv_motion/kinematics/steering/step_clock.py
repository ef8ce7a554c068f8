"""When a step of the planner is due, and how long it is."""

from __future__ import annotations


class StepClock:
    """Measures the time between steps, on a clock that may jump."""

    def __init__(self, period: float) -> None:
        """Wait for the first step.

        Args:
            period: Of the steps, about [s].

        """
        self._period = period
        self._last: float | None = None

    def elapsed(self, now: float, soonest: float) -> float | None:
        """Return the length of the step that is due now [s]; None where none is.

        Args:
            now: The time [s].
            soonest: Time since the last step below which none is due [s].

        """
        elapsed = self._period if self._last is None else now - self._last
        if 0.0 <= elapsed <= soonest:
            return None
        self._last = now
        # else the clock jumped, or there was nothing to do
        return elapsed if 0.0 < elapsed < 2.0 * self._period else self._period
