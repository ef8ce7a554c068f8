"""A sequence: actions one after another, each with its time-out and what to do when it fails."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from agv_motion.sequence.actions import Action

WORDS = re.compile(r'(stop|skip)|retry ([0-9]{1,6})(?: then (stop|skip))?')


@dataclass(frozen=True)
class OnFailure:
    """What to do when an action fails."""

    retries: int = 0
    """How often to try it again first"""
    skip: bool = False
    """Whether to go on with the next action then, rather than end the sequence"""

    @classmethod
    def parse(cls, words: str) -> OnFailure:
        """Return what ``stop``, ``skip``, ``retry N`` or ``retry N then skip`` means.

        Raises:
            ConfigurationError: It is none of them.

        """
        found = WORDS.fullmatch(words.strip())
        if found is None:
            msg = f"on_failure: '{words}': choose one of stop, skip, retry N, retry N then skip"
            raise ConfigurationError(msg)
        plain, retries, then = found.groups()
        return cls(int(retries or 0), 'skip' in (plain, then))

    def __str__(self) -> str:
        """Return the words that :meth:`parse` takes."""
        if not self.retries:
            return 'skip' if self.skip else 'stop'
        return f'retry {self.retries}' + (' then skip' if self.skip else '')


class SequenceStep(NamedTuple):
    """One action of a sequence."""

    name: str
    """for people: what was given, or the words of the action"""
    action: Action
    timeout: float
    """[s] of moving; a pause does not count"""
    on_failure: OnFailure
    where: str
    """file, line and column, for messages"""


class Sequence(NamedTuple):
    """All of it."""

    name: str
    steps: tuple[SequenceStep, ...]
