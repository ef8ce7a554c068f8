"""The one rule by which every odometry takes its readings: which of them follows, and what is lost.

Wheels, turrets, a gyroscope and the odometry of another all come as readings with stamps, and what
befalls stamps befalls them all: they come twice, late, swapped, after a gap; a clock leaps, an
encoder begins again. The rule:

- Time never runs back, and no time counts twice: a stamp that is not newer is ignored.
- A reading that cannot follow the last, because its stamp leapt or because nothing moves that fast,
  is ignored too, until the next ones go on from it: then the leap is real.
- What two positions tell of the way between them is kept, whatever the clock did meanwhile.
- What happened unseen makes the pose less certain by what may have been lost.
"""

from __future__ import annotations

from enum import Enum
from math import inf
from typing import TYPE_CHECKING, Generic, NamedTuple, TypeVar

from agv_motion.planar import require_finite

if TYPE_CHECKING:
    from collections.abc import Callable

LEAP = 10.0
"""[s] No message is that late, and no silence that long goes unnoticed: such a clock has leapt."""
LONGEST_LOSS = 3600.0
"""[s] More than this is not taken to have been lost in one leap: then a clock was set."""

R = TypeVar('R')


class Succession(Enum):
    """What a reading was good for."""

    MOVED = 'moved'
    GAP = 'after a gap: the path between is a guess'
    LEAP = 'the clock leapt: how long it took is not known'
    FIRST = 'first reading'
    RESET = 'encoders or clock jumped: the motion between is lost'
    DUPLICATE = 'stamp seen before: ignored'
    LATE = 'older than the last: ignored, the encoders count on'
    DOUBTED = 'cannot follow the last: ignored unless the next goes on from it'

    used: bool
    """Whether the reading counted"""


for _step in Succession:
    _step.used = _step not in {Succession.DUPLICATE, Succession.LATE, Succession.DOUBTED}


class Reading(NamedTuple, Generic[R]):
    """What was measured, and when."""

    stamp: float
    """[s]"""
    value: R


class Continuity(Generic[R]):
    """Tells of each reading whether it follows the last one that counted."""

    def __init__(self, max_gap: float, possible: Callable[[R, R, float], bool]) -> None:
        """Wait for the first reading.

        Args:
            max_gap: Time between two readings above which the way between is a guess [s].
            possible: Whether one value can lead to another within some time [s].

        """
        self._max_gap = max_gap
        self._possible = possible
        self.stamp = -inf
        """[s] of the last reading that counted; minus infinity before the first"""
        self._value: R | None = None
        self.begun: Reading[R] | None = None
        """After a leap: the reading from which on all is known again"""
        self.unseen = 0.0
        """[s] that may have passed, before the last reading that counted, with nothing seen"""
        self._doubted: tuple[Reading[R], Reading[R]] | None = None

    @property
    def last(self) -> Reading[R] | None:
        """The last reading that counted."""
        return None if self._value is None else Reading(self.stamp, self._value)

    @property
    def doubts(self) -> bool:
        """Whether readings were ignored since the last one that counted."""
        return self._doubted is not None

    def judge(self, stamp: float, value: R) -> Succession:
        """Take a reading, and return what it is good for.

        Raises:
            SignalError: The stamp is not finite; nothing has changed.

        """
        last = self.last
        if last is None:
            require_finite('stamp', (stamp,))
            return self._accept(Succession.FIRST, stamp, value, 0.0)
        duration = stamp - last.stamp
        if 0.0 < duration <= LEAP and self._possible(last.value, value, duration):
            if duration > self._max_gap:
                return self._accept(Succession.GAP, stamp, value, duration)
            late = last.stamp - self._doubted[0].stamp if self._doubted else 0.0
            return self._accept(Succession.MOVED, stamp, value, late if 0.0 < late < LEAP else 0.0)
        require_finite('stamp', (stamp,))
        if duration == 0.0:
            return Succession.DUPLICATE
        return self._doubt(last, stamp, value)

    def follow(self, stamp: float, value: R) -> None:
        """Take a reading of which it is known that it follows: the hot path."""
        self.stamp, self._value, self._doubted = stamp, value, None

    def replace(self, value: R) -> None:
        """Go on as if the last reading that counted had been ``value``."""
        if self._value is not None:
            self._value = value

    def _accept(self, step: Succession, stamp: float, value: R, unseen: float) -> Succession:
        self.follow(stamp, value)
        self.unseen = unseen
        return step

    def _doubt(self, last: Reading[R], stamp: float, value: R) -> Succession:
        """Ignore what cannot follow, unless it goes on from what was ignored before."""
        late = -LEAP < stamp - last.stamp < 0.0
        now = Reading(stamp, value)
        if self._doubted is not None:
            begun, newest = self._doubted
            passed = stamp - newest.stamp
            if passed == 0.0:
                return Succession.LATE if late else Succession.DUPLICATE
            if 0.0 < passed <= LEAP and self._possible(newest.value, value, passed):
                self._doubted = begun, now
                # messages may come late by some steps in a row, hardly by as long as a gap
                if not late or stamp - begun.stamp > self._max_gap:
                    return self._leap(last, begun, now)
                return Succession.LATE
        self._doubted = now, now
        return Succession.LATE if late else Succession.DOUBTED

    def _leap(self, last: Reading[R], begun: Reading[R], now: Reading[R]) -> Succession:
        """Believe in a leap from ``last`` to ``begun``, on which ``now`` follows."""
        passed = begun.stamp - last.stamp
        jumped = 0.0 < passed <= LEAP or not self._possible(last.value, begun.value, LEAP)
        unseen = min(passed, LONGEST_LOSS) if passed > 0.0 else min(-passed, LEAP)
        self.begun = begun
        return self._accept(Succession.RESET if jumped else Succession.LEAP, *now, unseen)
