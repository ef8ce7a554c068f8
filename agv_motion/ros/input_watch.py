"""A watchdog over one input of a node, which says in the log when it falls silent and comes back.

Each change is told once, and an input that comes and goes only now and then: a fault that lasts a
night fills no log. How things stand is the matter of the diagnostics.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Any

from agv_motion.motion.watchdog import Silence, Watchdog

if TYPE_CHECKING:
    from agv_motion.ros.node import ManagedNode


CALM = 5.0
"""[s] for which an input must be back before another silence is told at once."""


class InputWatch(Watchdog):
    """Judges the age of the last input, and tells of it."""

    def __init__(
        self,
        node: ManagedNode[Any],
        name: str,
        report_after: float,
        stop_after: float,
        remedy: str = '',
    ) -> None:
        """Start with an input that has never come.

        Args:
            node: In whose log to tell.
            name: Of the input.
            report_after: Age from which the input is late [s].
            stop_after: Age from which it is lost [s].
            remedy: What a person can do when it is lost.

        Raises:
            ConfigurationError: The two are not positive and in order.

        """
        super().__init__(report_after, stop_after)
        self._node, self._name = node, name
        self._remedy = f'; {remedy}' if remedy else ''
        self._told = Silence.FRESH
        self._silent_for = 0.0
        self._back_at = -inf

    def tell(self, now: float) -> Silence:
        """Return how silent the input is at ``now`` [s]; log it where that has changed."""
        silence, age = self.judge(now), self.age(now)
        if age is None:
            return silence
        if silence is not self._told and not self._is_restless():
            self._log(silence, age)
            self._told = silence
        self._silent_for = abs(age)
        return silence

    def _is_restless(self) -> bool:
        """Return whether the input has come back only just now."""
        calm = self._node.steady_seconds() - self._back_at >= CALM
        return self._told is Silence.FRESH and not calm

    def _log(self, silence: Silence, age: float) -> None:
        logger, name = self._node.get_logger(), self._name
        since = f'for {age:.1f} s' if age >= 0.0 else f'since the clock went back {-age:.1f} s'
        if silence is Silence.FRESH:
            text = f'{name} is back after {self._silent_for:.1f} s'
            logger.info(text)
            self._back_at = self._node.steady_seconds()
        elif silence is Silence.LATE:
            text = f'no {name} {since}: going on'
            logger.warning(text)
        else:
            text = f'no {name} {since}: stopping{self._remedy}'
            logger.error(text)
