"""Of all who ask a robot to move, one is obeyed: the highest that speaks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.arbitration.choice import FREE, Choice, HeldStop, Standing, Verdict
from agv_motion.arbitration.source import DEAD_MEN, DRIVERS, RANKED, TwistSource
from agv_motion.errors import ConfigurationError
from agv_motion.planar import REST, Twist, require_twist

if TYPE_CHECKING:
    from collections.abc import Mapping

    from agv_motion.arbitration.choice import Hold


class Arbiter:
    """Takes what all sources say, and chooses.

    A source counts from when it spoke until its time-out. One that keeps saying zero drives still:
    the robot stands. It leaves the robot to others by its silence.

    All times are of one clock that never leaps; should one leap all the same, whoever seems to have
    spoken in the future is silent.
    """

    def __init__(self, timeouts: Mapping[TwistSource, float], hold: Hold = FREE) -> None:
        """Start with sources that have never spoken.

        Args:
            timeouts: Silence after which each driver counts no more [s].
            hold: What is held from before.

        Raises:
            ConfigurationError: A driver has no time-out, or one that is not positive.

        """
        for source in DRIVERS:
            if not timeouts.get(source, 0.0) > 0.0:
                msg = f'time-out of {source.value} = {timeouts.get(source)} s: must be above 0'
                raise ConfigurationError(msg)
        self._timeouts = dict(timeouts)
        self._said: dict[TwistSource, tuple[Twist, float]] = {}
        """twist of each source that has spoken, and when [s]"""
        self.hold = hold

    # What the sources say

    def receive(self, source: TwistSource, twist: Twist, spoken: float) -> None:
        """Take a twist that ``source`` asked for at ``spoken`` [s]; any of STOP's latches.

        Raises:
            SignalError: A number is not finite, or beyond any robot.

        """
        if source is TwistSource.STOP:
            self.stop('asked for', spoken)
            return
        require_twist(twist)
        self._said[source] = twist, spoken
        if source in self.hold.lost:
            self.hold = self.hold._replace(lost=self.hold.lost - {source})

    def rest(self, source: TwistSource) -> bool:
        """Let ``source`` ask for no motion, and be no younger for it; return whether it moved."""
        twist, spoken = self._said.get(source, (REST, 0.0))
        if twist == REST:
            return False
        self._said[source] = REST, spoken
        return True

    def forget(self) -> None:
        """Let nothing count any more that was said; a dead-man that drove is lost."""
        moved = {source for source, (twist, _) in self._said.items() if twist != REST}
        self._lose(moved & DEAD_MEN)
        self._said.clear()

    # What holds until a person releases it

    def stop(self, reason: str, since: float) -> None:
        """Hold STOP; one that holds already keeps its reason.

        Args:
            reason: Who asks for it, in words.
            since: When that was, by the robot's clock [s].

        """
        if self.hold.stop is None:
            self.hold = self.hold._replace(stop=HeldStop(reason, since))

    def release(self) -> None:
        """End STOP; nothing that was said before it counts any more."""
        self._said.clear()
        self.hold = self.hold._replace(stop=None, lost=frozenset())

    def lock(self, source: TwistSource) -> None:
        """Let nothing below ``source`` drive; where it is silent the robot stands."""
        self.hold = self.hold._replace(locks=self.hold.locks | {source})

    def unlock(self, source: TwistSource) -> None:
        """Let others drive where ``source`` is silent, also if it was lost."""
        hold = self.hold
        self.hold = hold._replace(locks=hold.locks - {source}, lost=hold.lost - {source})

    # Who drives

    def choose(self, now: float) -> Choice:
        """Decide what to command at ``now`` [s]; a dead-man that was let go is noted as lost."""
        gone = {source for source in DEAD_MEN if self._has_let_go(source, now)}
        self._lose(gone)
        driver = self._driver(now)
        drives = driver is not None and driver is not TwistSource.STOP and self._speaks(driver, now)
        twist = self._said[driver][0] if driver is not None and drives else REST
        standings = {source: self._standing(source, driver, now) for source in RANKED}
        return Choice(twist, driver, standings, self.hold)

    def _driver(self, now: float) -> TwistSource | None:
        """Return the highest source that speaks or is held, STOP before all."""
        if self.hold.stop is not None:
            return TwistSource.STOP
        held = self.hold.locks | self.hold.lost
        return next((one for one in DRIVERS if one in held or self._speaks(one, now)), None)

    def _speaks(self, source: TwistSource, now: float) -> bool:
        """Return whether what ``source`` said last still counts."""
        if source not in self._said:
            return False
        return 0.0 <= now - self._said[source][1] < self._timeouts[source]

    def _has_let_go(self, source: TwistSource, now: float) -> bool:
        """Return whether ``source`` has fallen silent without a zero."""
        moved = source in self._said and self._said[source][0] != REST
        return moved and not self._speaks(source, now)

    def _lose(self, sources: set[TwistSource]) -> None:
        """Let the robot stand for dead-men that were let go; what they said has ended in that."""
        for source in sources:
            self.rest(source)
        if sources:
            self.hold = self.hold._replace(lost=self.hold.lost | sources)

    def _standing(self, source: TwistSource, driver: TwistSource | None, now: float) -> Standing:
        age = now - self._said[source][1] if source in self._said else None
        if source is driver:
            return Standing(*self._of_driver(source, now), age)
        if source is TwistSource.STOP or not self._speaks(source, now):
            return Standing(Verdict.NEVER if age is None else Verdict.SILENT, '', age)
        assert driver is not None
        return Standing(*self._of_waiting(driver), age)

    def _of_driver(self, source: TwistSource, now: float) -> tuple[Verdict, str]:
        if source is TwistSource.STOP or self._speaks(source, now):
            return Verdict.DRIVES, ''
        if source in self.hold.lost:
            return Verdict.LOST, 'it speaks anew, or is released'
        return Verdict.HOLDS, 'it speaks, or is released'

    def _of_waiting(self, driver: TwistSource) -> tuple[Verdict, str]:
        """Return how one stands that speaks below ``driver``."""
        name = driver.value
        if driver is TwistSource.STOP:
            return Verdict.STOPPED, 'STOP holds until released'
        if driver in self.hold.locks:
            return Verdict.LOCKED_OUT, f'{name} is locked until released'
        if driver in self.hold.lost:
            return Verdict.LOCKED_OUT, f'{name} was let go'
        return Verdict.OUTRANKED, f'{name} comes first'
