"""What a node does about its clock: while it has a fault, every input is lost, and that is told.

A node that has not run at all for a while (its process halted, its machine asleep) has lost its
inputs too, however soon the next message comes: its motors have stopped by themselves, and what it
knew is old.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Any, Protocol

from agv_motion.clock_watch import STANDS_AFTER, WAITING, ClockWatch

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.watchdog import Watchdog

LOOK_PERIOD = 0.1
"""[s] between two looks at the node's clock."""

CLOCK_TOPIC = '/clock'

SELDOM = 5.0
"""[s] between two words in the log on what is wrong with the clock."""

WAITS = 100
"""Number of looks for which a node waits for /clock to begin without a word: 10 s, and longer
where it does not come to look, since then others may not come to publish either."""


class Timed(Protocol):
    """Whose clock is looked at."""

    active: bool

    @property
    def is_simulated(self) -> bool:
        """Whether it is simulated."""

    def crowd(self, topic: str) -> str:
        """Return which nodes publish a topic together, in words; empty if one or none does."""

    def seconds(self) -> float:
        """Return the time of the clock [s]."""

    def steady_seconds(self) -> float:
        """Return the time of a clock that never leaps [s]."""

    @property
    def info(self) -> Callable[..., Any]:
        """What logs that all is well again."""

    @property
    def warning(self) -> Callable[..., Any]:
        """What logs that it may be waited for in vain."""

    @property
    def error(self) -> Callable[..., Any]:
        """What logs that something is not well."""


class ClockLog:
    """Logs that a clock has a fault, and that it runs again; to wait for it to begin is none."""

    def __init__(self, port: Timed) -> None:
        """Have said nothing."""
        self._port = port
        self._told, self._told_at, self._waited = False, -inf, 0

    def update(self, fault: str) -> None:
        """Take what is wrong with the clock now; empty if nothing is."""
        port, steady = self._port, self._port.steady_seconds()
        if fault in WAITING:
            self._waited += 1
            if self._waited == WAITS:
                self._told = True
                port.warning(f'{fault}: waiting for it; does nobody simulate? use_sim_time:=false')
        elif fault and not self._told and steady - self._told_at >= SELDOM:
            self._told = True
            port.error(f'{fault}: standing still until it runs well{self._rivals()}')
        elif self._told and not fault:
            self._told, self._told_at = False, steady
            port.info('the clock runs well: going on')

    def _rivals(self) -> str:
        """Return who tell the time together, and what to do; empty if one alone does."""
        rivals = self._port.crowd(CLOCK_TOPIC) if self._port.is_simulated else ''
        return f'; {rivals} all tell the time on {CLOCK_TOPIC}: let only one do so' * bool(rivals)


class ClockGuard:
    """Looks at the clock of one node by the steady clock, and acts upon what it finds."""

    def __init__(self, port: Timed) -> None:
        """Look not yet."""
        self.watch = ClockWatch()
        self._port = port
        self._inputs: list[Watchdog] = []
        self._acts: list[Callable[[], None]] = []
        self._ran_at, self._longest_nap = port.steady_seconds(), inf
        self._log = ClockLog(port)

    def add(self, watchdog: Watchdog) -> None:
        """Take an input for lost until it comes again, whenever the clock has a fault.

        A clock that stands is found before the most impatient of the inputs is lost.
        """
        self._inputs.append(watchdog)
        limit = min(each.stop_after for each in self._inputs)
        self.watch.stands_after = max(limit - LOOK_PERIOD, 0.5 * limit)
        self._longest_nap = limit

    def on_fault(self, act: Callable[[], None]) -> None:
        """Call ``act``, which judges the inputs, while the clock has a fault, and after a nap."""
        self._acts.append(act)

    def clear(self) -> None:
        """Forget inputs and acts."""
        self._inputs.clear()
        self._acts.clear()
        self.watch.stands_after = STANDS_AFTER
        self._longest_nap = inf

    def forget_inputs(self) -> None:
        """Take all inputs for lost until they come again."""
        for watchdog in self._inputs:
            watchdog.forget()

    def wake(self) -> None:
        """Judge the inputs first where nothing has run for as long as one of them may be silent."""
        now = self._port.steady_seconds()
        slept, self._ran_at = now - self._ran_at > self._longest_nap, now
        if slept:
            self._act()

    def look(self) -> None:
        """Take all inputs for lost while the clock has a fault, and tell of it."""
        port, watch = self._port, self.watch
        self.wake()
        watch.look(port.seconds(), port.steady_seconds())
        if watch.fault:
            self.forget_inputs()
            self._act()
        self._log.update(watch.fault)

    def _act(self) -> None:
        for act in self._acts if self._port.active else ():
            act()


def if_possible(
    callback: Callable[[Any], None], refuse: Callable[[str], None]
) -> Callable[[Any], None]:
    """Return ``callback`` of /clock for times that can be; a negative one raises in rclpy's own.

    Args:
        callback: Of rclpy, which takes the message.
        refuse: Called with what is wrong with a time, in words.

    """

    def guarded(message: Any) -> None:
        if message.clock.sec >= 0:
            callback(message)
        else:
            refuse(f'{CLOCK_TOPIC} told {message.clock.sec} s, and no time is negative')

    return guarded
