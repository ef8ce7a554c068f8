"""What makes an input of a node fresh: a stamp that is newer than the last, near to now, and soon.

A repeat is no news, nor is what is too old or stamped ahead; only news feeds the watchdog. Silence
is judged on the steady clock, so that no clock that stands or is set can switch the guard off; the
age of a stamp is judged on the node's own clock. Each change is told once, and an input that comes
and goes only now and then: a fault that lasts a night fills no log. How things stand is the matter
of the diagnostics.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.errors import SignalError
from agv_motion.watchdog import Silence, Watchdog

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from agv_motion.ros.port import Port


CALM = 5.0
"""[s] for which an input must be back before another silence is told at once."""

SECOND = 1_000_000_000

FRESH = Silence.FRESH
"""Looked up once: every input is judged ten times a second."""


class Freshness(NamedTuple):
    """How fresh an input has to be."""

    report_after: float
    """silence from which it is late [s], in real time"""
    stop_after: float
    """silence from which it is lost [s], in real time"""
    max_age: float
    """how far a stamp may lie from the node's clock, either way [s]"""


class InputWatch(Watchdog):
    """Judges each message of an input by its stamp, and the input by the age of its last news."""

    def __init__(
        self,
        port: Port,
        name: str,
        limits: Freshness,
        remedy: str = '',
        loss: str = 'taken for lost',
    ) -> None:
        """Start with an input that has never come.

        Args:
            port: Of the node whose input it is.
            name: Of the input.
            limits: How fresh it has to be.
            remedy: What a person can do when it is lost.
            loss: What becomes of it, or of what it moves, when it is lost.

        Raises:
            ConfigurationError: The limits of silence are not positive and in order.

        """
        super().__init__(limits.report_after, limits.stop_after)
        self.spoken = False
        """Whether it has ever come"""
        self._port, self._name, self._max_age = port, name, limits.max_age
        self._remedy = f'; {remedy}' if remedy else ''
        self._loss = loss
        self.newest = 0
        """Stamp of the last news [ns]"""
        self._overtaken = 0
        self._repeats = 0
        self._told = Silence.FRESH
        self._silent_for = 0.0
        self._back_at = -inf
        port.watch_over(self)

    def is_news(self, stamp: Any) -> bool:
        """Return whether a message with this stamp is news; once it was of use, `note` it.

        A repeat and what was overtaken are none. Stamps that went back but rise again are those of
        a publisher that began anew, once the input was lost. A stamp of zero is set to now.

        Args:
            stamp: builtin_interfaces/Time of the message's header.

        Raises:
            SignalError: It lies too far from now.

        """
        taken = stamp.sec * SECOND + stamp.nanosec
        news = self.is_new(taken)
        if news and taken == 0:
            stamp.sec, stamp.nanosec = divmod(self.newest, SECOND)
        return news

    def is_new(self, taken: int) -> bool:
        """Return the same of a stamp in nanoseconds; one of zero is taken for now."""
        port, clock = self._port, self._port.clock
        if clock.fault:
            return False
        now = port.nanoseconds()
        if taken == 0:
            taken = now
        else:
            if abs(now - taken) > self._max_age * clock.speed * SECOND:
                require_near(port, taken, self._max_age, now)
            if taken <= self.newest and not self._begins_anew(taken):
                self._repeats += 1
                return False
        self.newest = taken
        return True

    def are_news(self, taken: NDArray[np.int64], now: NDArray[np.int64]) -> bool:
        """Return whether many messages will all be news when they come.

        Args:
            taken: (n,) their stamps [ns].
            now: (n,) what the node's clock will tell when they come [ns].

        """
        rise = np.diff(taken, prepend=self.newest) > 0
        near = np.abs(now - taken) <= self._max_age * self._port.clock.speed * SECOND
        return bool(np.all(rise & near & (taken > 0)))

    def note(self) -> None:
        """Feed the watchdog: news has come, and was of use."""
        self.feed(self._port.steady_seconds())
        self.spoken, self._repeats, self._overtaken = True, 0, 0

    def silence(self) -> Silence:
        """Return how silent the input is now; lost while the clock cannot be believed."""
        port = self._port
        return Silence.LOST if port.clock.fault else self.judge(port.steady_seconds())

    def tell(self) -> Silence:
        """Return how silent the input is now; log it where that has changed."""
        silence = self.silence()
        if silence is FRESH and self._told is FRESH:
            return silence
        age = self.age(self._port.steady_seconds())
        if age is None or self._port.clock.fault:
            return silence
        if silence is not self._told and not self._is_restless():
            self._log(silence, age)
            self._told = silence
        self._silent_for = age
        return silence

    def why(self) -> str:
        """Return why the input is lost, in words."""
        age = self.age(self._port.steady_seconds())
        if self._port.clock.fault:
            return self._port.clock.fault
        return f'no {self._name} yet' if age is None else self._without(age)

    def _begins_anew(self, taken: int) -> bool:
        """Return whether a stamp that is not newer is the second, rising, of a lost input."""
        rises = 0 < self._overtaken < taken
        self._overtaken = taken
        if not rises or self.silence() is not Silence.LOST:
            return False
        back = (self.newest - taken) * 1e-9
        text = f'{self._name}: its stamps went back by {back:.3g} s: taken for a new beginning'
        self._port.warning(text)
        return True

    def _is_restless(self) -> bool:
        """Return whether the input has come back only just now."""
        calm = self._port.steady_seconds() - self._back_at >= CALM
        return self._told is Silence.FRESH and not calm

    def _without(self, age: float) -> str:
        repeats = f' ({self._repeats} repeats or overtaken)' if self._repeats else ''
        return f'no {"new " if repeats else ""}{self._name} for {age:.1f} s{repeats}'

    def _log(self, silence: Silence, age: float) -> None:
        port = self._port
        if silence is Silence.FRESH:
            text = f'{self._name} is back after {self._silent_for:.1f} s: used again'
            port.info(text)
            self._back_at = self._port.steady_seconds()
        elif silence is Silence.LATE:
            left = max(self.stop_after - age, 0.0)
            text = f'{self._without(age)}: {self._loss} in {left:.1f} s unless one comes'
            port.warning(text)
        else:
            text = f'{self._without(age)}: stopping{self._remedy}'
            port.error(text)


def require_near(port: Port, taken: int, max_age: float, now: int) -> None:
    """Raise unless a stamp lies within ``max_age`` of now; in proportion where time runs fast.

    Args:
        port: Whose clock counts.
        taken: The stamp [ns].
        max_age: Limit either way [s], in real time.
        now: Of the node's clock [ns].

    Raises:
        SignalError: It lies further away.

    """
    age = (now - taken) * 1e-9
    limit = max_age * port.clock.speed
    if abs(age) > limit:
        where = f'{age:.3g} s ago' if age > 0.0 else f'{-age:.3g} s ahead'
        msg = (
            f'stamped {where}, limit {limit:.3g} s: set the clocks of both machines alike, give '
            'both nodes the same use_sim_time, or raise max_age'
        )
        raise SignalError(msg)
