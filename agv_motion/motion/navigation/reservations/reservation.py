"""What one tree tells the others of its floor, and what comes of its requests."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from math import isfinite
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import SignalError
from agv_motion.motion.navigation.polyline import Path, joined, line
from agv_motion.motion.navigation.reservations.separation import Floor
from agv_motion.planar import FARTHEST

if TYPE_CHECKING:
    from collections.abc import Mapping

    import shapely

IDLE = 2**62
"""[1] Journey of a tree that has none: younger than any."""

MOST_POINTS = 1000
"""of all three paths of a reservation together; a path through a zone has a few corners"""

WIDEST = 1000.0
"""[m] No tree is wider, nor keeps more margin."""

LONGEST_NAME = 200
"""[1] characters"""

MOST_RECEIVED = 200
"""[1] other trees in one reservation"""


class MessageId(NamedTuple):
    """Which message of a tree: what others name to say that they have heard it."""

    run: int
    """of the sender since it last started: a number that chance makes once and never again"""
    number: int
    """of the message in its run, from 0 on"""


@dataclass(frozen=True)
class Reservation:
    """One message of one tree; immutable."""

    name: str
    """of the tree: its namespace"""
    message_id: MessageId
    """which message it is"""
    radius: float
    """[m] of the disc about a centre that the tree may occupy: body and error"""
    held: Path
    """where its centre may be, from where it is on: nobody else may come near"""
    requested: Path = ()
    """where its centre would go next, joined to the end of ``held``"""
    planned: Path = ()
    """the whole rest of its path"""
    journey: int = IDLE
    """later than every journey known when the tree set out: who set out first goes first"""
    received: Mapping[str, MessageId] = field(default_factory=dict)
    """the last message it has of each tree that it hears"""
    parked: bool = False
    """it stays where it is, and asks before it ever moves again"""
    margin: float = 0.0
    """[m] it wants between its rim and that of any other, at least"""

    def __post_init__(self) -> None:
        """Refuse what would void the promises of :class:`RightOfWay`.

        Raises:
            SignalError: No name, no place, too long, or a number that is not finite or no sense.

        """
        whose = f"reservation of '{self.name:.40}'"
        if not self.name.strip() or not self.held:
            msg = f'{whose} with {len(self.held)} points held: needs name, place'
            raise SignalError(msg)
        if len(self.name) > LONGEST_NAME or len(self.received) > MOST_RECEIVED:
            msg = (
                f'{whose} has a name of {len(self.name)} letters and has heard '
                f'{len(self.received)} trees: at most {LONGEST_NAME} and {MOST_RECEIVED}'
            )
            raise SignalError(msg)
        self._check_numbers()
        points = len(self.held) + len(self.requested) + len(self.planned)
        if points > MOST_POINTS:
            msg = (
                f"reservation of '{self.name}' goes through {points} points: at most {MOST_POINTS}"
            )
            raise SignalError(msg)
        for x, y in (*self.held, *self.requested, *self.planned):
            if not (abs(x) <= FARTHEST and abs(y) <= FARTHEST):
                msg = (
                    f'{whose} goes through ({x}, {y}): must be finite and within '
                    f'{FARTHEST:g} m of the origin of the map'
                )
                raise SignalError(msg)

    def _check_numbers(self) -> None:
        """Refuse sizes and counts that no tree has.

        Raises:
            SignalError: One is negative, not finite or beyond all reason.

        """
        whose = f"reservation of '{self.name:.40}'"
        if not (isfinite(self.radius) and 0.0 < self.radius <= WIDEST):
            msg = f'{whose}: radius {self.radius} m must be positive, <= {WIDEST:g}'
            raise SignalError(msg)
        if not 0.0 <= self.margin <= WIDEST:
            msg = f'{whose}: margin {self.margin} m must lie in [0, {WIDEST:g}]'
            raise SignalError(msg)
        messages = (self.message_id, *self.received.values())
        if not all(0 <= n < 2**64 for message_id in messages for n in message_id) or not (
            0 <= self.journey <= IDLE
        ):
            msg = f'{whose}: run, number and journey must lie in [0, 2^64)'
            raise SignalError(msg)

    @property
    def precedence(self) -> tuple[int, str]:
        """Who goes first: the lesser; a total order, since names differ."""
        return self.journey, self.name

    @cached_property
    def requested_line(self) -> shapely.Geometry:
        """The path of ``requested``; empty if it asks for nothing."""
        return line(self.requested)

    @cached_property
    def both(self) -> shapely.Geometry:
        """All that it may hold by now: ``held``, and ``requested`` if granted meanwhile."""
        return line(joined(self.held, self.requested))

    @cached_property
    def floor(self) -> Floor:
        """What it holds, and where it is."""
        return Floor.of(self.held)

    @cached_property
    def most_floor(self) -> Floor:
        """All that it may hold by now, and where it was."""
        return Floor.of(joined(self.held, self.requested))


class Answer(Enum):
    """What came of a request."""

    GRANTED = 'granted'
    PENDING = 'waits for the answer of'
    TAKEN = 'waits for'
    LISTENING = 'listens who else is there'
    ALARM = 'stands:'


class Ruling(NamedTuple):
    """What came of a request, and through whom."""

    answer: Answer
    name: str = ''

    def __str__(self) -> str:
        """In words."""
        return f'{self.answer.value} {self.name}'.rstrip()


GRANTED = Ruling(Answer.GRANTED)

UNHEARD = (
    'which has not spoken since this tree started: start it, or where it is gone for good take it '
    'out of traffic.expected and peers_file'
)
"""What to do about a tree that is waited for. That one was parked and switched off is not kept on
disk: where two take each other for parked and both start again, each would rely on the other."""
