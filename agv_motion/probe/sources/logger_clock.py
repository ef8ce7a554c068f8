"""The clock of a logger beside the one here: whether the time of a line goes on from those before.

One line with the time of another month would make a probe forget its nights and its range: it rests
for days until it has learnt them anew. So it is left out, unless the next one goes on from it: then
the logger was set, and is believed.
"""

from __future__ import annotations

from agv_motion.probe.sources.logger_line import EPOCHS

OFF_CLOCK = 86400.0
"""[s] A logger whose clock differs from the node's by more has the wrong day, or month."""


class LoggerClock:
    """By how much the lines of one logger are ahead of the clock here."""

    def __init__(self) -> None:
        """Have seen no line."""
        self._ahead: float | None = None
        self._doubted: float | None = None

    def has_leapt(self, time: float, now: float) -> bool:
        """Take the time of a line; return whether it must be left out.

        Args:
            time: That the line tells [s since 1970].
            now: Of the clock here [s since 1970]; one that has not begun tells nothing.

        """
        if now < EPOCHS[0]:
            return False
        ahead, known = time - now, (self._ahead, self._doubted)
        goes_on = any(each is not None and abs(ahead - each) < OFF_CLOCK for each in known)
        if goes_on or self._ahead is None:
            self._ahead, self._doubted = ahead, None
            return False
        self._doubted = ahead
        return True
