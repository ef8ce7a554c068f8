"""What a node has refused: told in its log, of repeats only some, and for a while its condition."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from agv_motion.errors import shortened
from agv_motion.ros.refusals import Refusals

if TYPE_CHECKING:
    from collections.abc import Callable

COMPLAINT_LIFETIME = 10.0
"""[s] How long a refused input keeps the diagnostics at WARN."""


class Complaints:
    """Tells and counts the inputs that one node did not use."""

    def __init__(self, logger: Any, clock: Callable[[], float]) -> None:
        """Start with none.

        Args:
            logger: Of rclpy, in which to tell.
            clock: Returns a time that never leaps [s].

        """
        self.last = ''
        """Why the last input that was not used was refused."""
        self.count = 0
        self._logger, self._clock, self._refusals = logger, clock, Refusals()
        self._told_at = -COMPLAINT_LIFETIME

    def refuse(self, reason: str) -> None:
        """Tell of an input that was not used, in the log and in the diagnostics."""
        self.count += 1
        self.last, self._told_at = shortened(reason), self._clock()
        self.warn(f'refused: {self.last}')

    def warn(self, text: str) -> None:
        """Log a warning; of repeats only some, with their number."""
        line = self._line(text)
        if line:
            self._logger.warning(line)

    def inform(self, text: str) -> None:
        """Log what was done; of repeats only some, with their number."""
        line = self._line(text)
        if line:
            self._logger.info(line)

    def is_recent(self) -> bool:
        """Return whether an input was refused only just now."""
        return self._clock() - self._told_at < COMPLAINT_LIFETIME

    def _line(self, text: str) -> str:
        return self._refusals.line(text, self._clock())
