"""One order to a robot: whether it was taken, whether it is done, and how it ended."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping

LOST_ORDER = 1.0
"""[s] after which a state that came before the acceptance counts: topics keep no common order."""


class Outcome(Enum):
    """How an order stands."""

    RUNNING = 'running'
    SUCCEEDED = 'succeeded'
    FAILED = 'failed'
    CANCELLED = 'cancelled'


class Fault(Enum):
    """What has failed an order, for programs."""

    NONE = 'none'
    NODE = 'the node that drives says that it failed'
    STOPPED = 'STOP'
    SILENT = 'the robot is silent'
    STANDS = 'the robot stands'


class Result(NamedTuple):
    """How an order ended, or that it has not."""

    outcome: Outcome
    reason: str
    """in plain English"""

    @property
    def succeeded(self) -> bool:
        """Whether the robot did what it was to do."""
        return self.outcome is Outcome.SUCCEEDED


class Feedback(NamedTuple):
    """How far a robot is."""

    state: str
    """what it does, in the words of the node that drives it"""
    distance_left: float
    """[m] along its path; NaN as long as nobody knows"""
    why: str
    """why it stands, and what can be done; empty while it moves"""


class Task:
    """An order, from when it was sent to its end; the first end counts."""

    def __init__(self, ends: Mapping[str, Outcome], sent: float) -> None:
        """Be sent, not yet accepted.

        Args:
            ends: How each state ends it, by the first words of the state.
            sent: When, by a steady clock [s].

        """
        self._ends, self._sent = ends, sent
        self._early = ''
        self.accepted = False
        """Whether the node has taken it"""
        self.result = Result(Outcome.RUNNING, 'sent')
        self.fault = Fault.NONE
        """What has failed it"""

    @property
    def ended(self) -> bool:
        """Whether it is over."""
        return self.result.outcome is not Outcome.RUNNING

    def accept(self) -> None:
        """Be taken; a second time tells of an order of somebody else, which took its place."""
        if self.accepted:
            self.end(Outcome.CANCELLED, 'another order took its place')
        elif not self.ended:
            self.accepted = True
            self.result = Result(Outcome.RUNNING, 'under way')

    def tell(self, state: str) -> None:
        """Take in what the node says to be doing."""
        if not self.accepted:
            self._early = state
            return
        self._early = ''
        outcome = self._ends.get(state.partition(':')[0])
        if outcome is not None:
            self.end(outcome, state)

    def look(self, now: float) -> None:
        """Let a state count that overtook the acceptance."""
        if self.accepted and self._early and now - self._sent > LOST_ORDER:
            self.tell(self._early)

    def end(self, outcome: Outcome, reason: str, fault: Fault = Fault.NODE) -> None:
        """Be over, unless it is already; ``fault`` counts where it has failed."""
        if not self.ended:
            self.result = Result(outcome, reason)
            self.fault = fault if outcome is Outcome.FAILED else Fault.NONE
