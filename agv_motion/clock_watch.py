"""Whether a clock that can be set, paused or simulated may be believed, beside one that cannot."""

from __future__ import annotations

from collections import deque
from math import inf
from statistics import median
from typing import NamedTuple

AHEAD = 1.0
"""[s] in real time. A clock that gains more, beyond three times its speed, has leapt."""

BACK = 0.1
"""[s] A clock that goes back by more has leapt; less, a time server may well set it."""

CALM = 0.5
"""[s] for which a clock must have run well before it is believed again."""

STANDS_AFTER = 2.0
"""[s] without progress after which a clock stands still, where no input has a limit."""

LOOKS = 9
"""Number of looks whose median tells how fast the clock runs: one leap does not change it."""

FASTEST = 100.0
"""[-] Speed that a simulation may have which was seen to begin, until ``LOOKS`` tell its pace: on a
busy machine it stutters, and has not leapt."""

SOON = 1e-3
"""[s] Less than the time between two looks."""

GEAR = 10.0
"""[-] A clock whose speed seems to rise by more than that at one look is taken to have leapt."""

WAITING = (
    'no time has come on /clock yet',
    'the clock has told its first time and does not run yet',
    'the clock begins to run',
)
"""Faults that are none yet: a simulation takes its time to begin"""

WENT_BACK = 'the clock went back to zero'


class ClockPace:
    """How fast a clock runs, by its last looks."""

    def __init__(self) -> None:
        """Know of no look."""
        self.seen_to_begin = False
        """Whether the clock was there before its time was: a simulation that begins stutters"""
        self.speed = 1.0
        """[-] Seconds of the clock per second, and no less than 1"""
        self._speeds = deque[float](maxlen=LOOKS)

    def __bool__(self) -> bool:
        """Return whether it is known at all."""
        return bool(self._speeds)

    def begin(self) -> None:
        """Know that the clock has no time yet."""
        self._speeds.clear()
        self.seen_to_begin = True

    def add(self, gained: float, passed: float) -> None:
        """Take up that the clock ``gained`` so much in the time ``passed`` [s]."""
        speed = gained / passed
        self._speeds.append(min(speed, GEAR * self.speed) if self._speeds else speed)
        self.speed = max(1.0, median(self._speeds))

    def highest(self) -> float:
        """Return the speed that the clock may well have."""
        unsure = self.seen_to_begin and len(self._speeds) < LOOKS
        return max(self.speed, FASTEST) if unsure else self.speed


class ClockMove(NamedTuple):
    """When a clock was last seen to have gone on."""

    time: float
    """what it told [s]"""
    steady: float
    """what a clock told then that never leaps [s]"""


class ClockWatch:
    """Looks at a clock several times a second, and tells what is wrong with it.

    A simulated clock may run at any speed: what counts as a leap is in proportion to it.
    """

    def __init__(self, stands_after: float = STANDS_AFTER) -> None:
        """Start with a clock that nobody has looked at.

        Args:
            stands_after: Time without progress after which the clock stands still [s].

        """
        self.stands_after = stands_after
        self.fault = 'the clock has not been looked at yet'
        """What is wrong with the clock, in words; empty if it can be believed"""
        self._pace = ClockPace()
        self._begun = False
        self._moved: ClockMove | None = None
        self._calm_from = self._told_until = -inf

    @property
    def speed(self) -> float:
        """Seconds of the clock per second, and no less than 1 [-]."""
        return self._pace.speed

    def look(self, time: float, steady: float) -> None:
        """Judge the clock.

        Args:
            time: What it tells [s]; 0 while it has not begun.
            steady: What a clock tells at this moment that never leaps [s].

        """
        if time <= 0.0:
            self._moved = None
            self._pace.begin()
            self.fault, self._calm_from = WENT_BACK if self._begun else WAITING[0], inf
        elif self._moved is None:
            self._begun, self._moved = True, ClockMove(time, steady)
            if self._calm_from == inf:  # how fast it runs, the next look will tell
                self._calm_from = steady + SOON
        else:
            self._compare(self._moved, time, steady)
        if steady >= self._calm_from:
            self.fault = ''

    def distrust(self, fault: str, steady: float) -> None:
        """Do not believe the clock before it has run well for a while from ``steady`` [s] on."""
        self.fault = fault
        self._told_until = self._calm_from = steady + CALM

    def _compare(self, moved: ClockMove, time: float, steady: float) -> None:
        """Judge a clock by what it tells now and when it ``moved`` last."""
        gained, passed = time - moved.time, steady - moved.steady
        if gained == 0.0:
            if passed >= self.stands_after:
                self._calm_from = steady + CALM
                if steady >= self._told_until:  # what was said of it goes first
                    stands = f'the clock stands still at {time:.3f} s'
                    self.fault = stands if self._pace else WAITING[1]
            return
        if self.fault == WAITING[1]:  # it begins now: how long it took tells nothing of its speed
            self._moved, self._calm_from = ClockMove(time, steady), steady + SOON
            self.fault = WAITING[2]
            return
        if gained < -BACK:
            self.distrust(f'the clock leapt back by {-gained:.3g} s', steady)
        elif self._pace and gained > self._pace.highest() * (AHEAD + 3.0 * passed):
            self.distrust(f'the clock leapt ahead by {gained:.3g} s', steady)
        if passed > 0.0:
            self._pace.add(gained, passed)
        self._moved = ClockMove(time, steady)
