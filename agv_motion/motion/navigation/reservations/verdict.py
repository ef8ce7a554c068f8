"""What comes of a request for floor, and through whom."""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple


class Answer(Enum):
    """What came of a request."""

    GRANTED = 'granted'
    PENDING = 'waits for the answer of'
    TAKEN = 'waits for'
    LISTENING = 'listens who else is there'
    ALARM = 'stands:'


class Verdict(NamedTuple):
    """What came of a request, and through whom."""

    answer: Answer
    name: str = ''

    def __str__(self) -> str:
        """In words."""
        return f'{self.answer.value} {self.name}'.rstrip()


GRANTED = Verdict(Answer.GRANTED)

UNHEARD = (
    'which has not spoken since this tree started: start it, or where it is gone for good take it '
    'out of traffic.expected and peers_file'
)
"""What to do about a tree that is waited for. That one was parked and switched off is not kept on
disk: where two take each other for parked and both start again, each would rely on the other."""
