"""Whether a clock that can be set, paused or simulated may be believed, beside one that cannot."""

from __future__ import annotations

from collections import deque
from math import inf
from statistics import median

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
        self.speed = 1.0
        """[-] Seconds of the clock per second, and no less than 1"""
        self._begun = self._seen_to_begin = False
        self._time: float | None = None
        self._moved_at = 0.0
        self._calm_from = self._told_until = -inf
        self._speeds = deque[float](maxlen=LOOKS)

    def look(self, time: float, steady: float) -> None:
        """Judge the clock.

        Args:
            time: What it tells [s]; 0 while it has not begun.
            steady: What a clock tells at this moment that never leaps [s].

        """
        if time <= 0.0:
            self._time = None
            self._speeds.clear()
            self._seen_to_begin = True
            self.fault, self._calm_from = WENT_BACK if self._begun else WAITING[0], inf
        elif self._time is None:
            self._begun, self._time, self._moved_at = True, time, steady
            if self._calm_from == inf:  # how fast it runs, the next look will tell
                self._calm_from = steady + SOON
        else:
            self._compare(time - self._time, time, steady)
        if steady >= self._calm_from:
            self.fault = ''

    def distrust(self, fault: str, steady: float) -> None:
        """Do not believe the clock before it has run well for a while from ``steady`` [s] on."""
        self.fault = fault
        self._told_until = self._calm_from = steady + CALM

    def _compare(self, gained: float, time: float, steady: float) -> None:
        """Judge a clock that has ``gained`` so much [s] since it moved last."""
        passed = steady - self._moved_at
        if gained == 0.0:
            if passed >= self.stands_after:
                self._calm_from = steady + CALM
                if steady >= self._told_until:  # what was said of it goes first
                    stands = f'the clock stands still at {time:.3f} s'
                    self.fault = stands if self._speeds else WAITING[1]
            return
        if self.fault == WAITING[1]:  # it begins now: how long it took tells nothing of its speed
            self._time, self._moved_at, self._calm_from = time, steady, steady + SOON
            self.fault = WAITING[2]
            return
        if gained < -BACK:
            self.distrust(f'the clock leapt back by {-gained:.3g} s', steady)
        elif self._speeds and gained > self._pace() * (AHEAD + 3.0 * passed):
            self.distrust(f'the clock leapt ahead by {gained:.3g} s', steady)
        if passed > 0.0:
            speed = gained / passed
            self._speeds.append(min(speed, GEAR * self.speed) if self._speeds else speed)
            self.speed = max(1.0, median(self._speeds))
        self._time, self._moved_at = time, steady

    def _pace(self) -> float:
        """Return the speed that the clock may well have."""
        unsure = self._seen_to_begin and len(self._speeds) < LOOKS
        return max(self.speed, FASTEST) if unsure else self.speed
