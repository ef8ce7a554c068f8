"""The other trees as one tree knows them: their last words, their runs, and who still speaks.

A tree that starts again has a new run and knows nothing. Words of the run that ended may still come
late, and no clock tells which run is the later. What tells is an answer: a word of run Y that names
a message sent after a word of run X had come was itself sent later than X spoke. Runs of one tree
follow one another, so X has ended. Until then the floor of both stays taken, and nobody relies on
either. Where a run speaks that has been shown to have ended, there are two trees of one name.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.motion.navigation.polyline import line
from agv_motion.motion.navigation.reservations.reservation import (
    GRANTED,
    IDLE,
    Answer,
    MessageId,
    Reservation,
    Ruling,
)
from agv_motion.motion.navigation.reservations.separation import apart, keeps_away
from agv_motion.motion.navigation.reservations.sides import Sides

if TYPE_CHECKING:
    from collections.abc import Iterator

    import shapely

    from agv_motion.motion.navigation.polyline import Path
    from agv_motion.motion.navigation.reservations.separation import Floor

MOST_RUNS = 16
"""[1] runs of one tree that may be the present one; more is not one tree"""

MOST_ENDED = 64
"""[1] ended runs that are remembered; the late word of an older one costs an answer"""

LONG_AGO = -1e18
"""[s]"""


class _Run(NamedTuple):
    reservation: Reservation
    """its last word"""
    since: int
    """number of the next message this tree sent when it first heard of the run"""


class Peer:
    """One other tree, as one tree knows it."""

    def __init__(self, reservation: Reservation, echo: int, now: float, next_number: int) -> None:
        """Note its first words; see :meth:`receive`."""
        self._runs = {reservation.message_id.run: _Run(reservation, next_number)}
        self._ended: dict[int, int] = {}
        self.reservation = reservation
        """its last word"""
        self.echo = echo
        """number of the message of this tree's present run that it had when it spoke last"""
        self.received_at = now
        self.mutual_from = next_number
        """number of the first message sent to it since it was heard (again)"""
        self.silent = False
        self.sides: Sides | None = None
        """how the floor is shared while it is silent; None where nothing is agreed"""
        self.doubled_at = LONG_AGO
        """when it last was plain that two trees bear its name [s]"""
        self.journey_since = now
        """when its present journey was first heard of [s]"""

    def receive(self, reservation: Reservation, echo: int, now: float, next_number: int) -> None:
        """Take up a message; one that was overtaken by a later one of its run is dropped.

        Args:
            reservation: What it says.
            echo: Number of the last message it had of this tree's present run; -1: none.
            now: When it came, on this tree's steady clock [s].
            next_number: Of the next message this tree will send.

        """
        run = reservation.message_id.run
        if run in self._ended or (run not in self._runs and len(self._runs) >= MOST_RUNS):
            if echo >= self._ended.get(run, -1):
                self.doubled_at = now
            return
        known = self._runs.get(run)
        if (
            known is not None
            and reservation.message_id.number <= known.reservation.message_id.number
        ):
            return
        if self.silent or run != self.reservation.message_id.run:
            self.silent, self.sides, self.mutual_from = False, None, next_number
        if reservation.journey != self.reservation.journey:
            self.journey_since = now
        self._runs[run] = _Run(reservation, next_number if known is None else known.since)
        self.reservation, self.echo, self.received_at = reservation, echo, now
        self._end_others(echo, next_number)

    def _end_others(self, echo: int, next_number: int) -> None:
        """Note that all runs have ended which had spoken before message ``echo`` was sent."""
        present = self.reservation.message_id.run
        for run in [r for r, other in self._runs.items() if r != present and echo >= other.since]:
            del self._runs[run]
            self._ended[run] = next_number
        while len(self._ended) > MOST_ENDED:
            del self._ended[next(iter(self._ended))]

    def answered(self, number: int) -> bool:
        """Return whether it has said, in its present run, that it knows message ``number``."""
        return len(self._runs) == 1 and self.echo >= number

    @property
    def mutual(self) -> bool:
        """Whether it has heard of this tree since this tree heard of it, and told so."""
        return self.answered(self.mutual_from)

    @property
    def stays(self) -> bool:
        """Whether it will not move before it has an answer of this tree.

        Its word that it is parked does for that only if it was said to this tree as it is now: one
        that itself was taken for parked meanwhile has to be asked.
        """
        return self.reservation.parked and self.mutual

    @property
    def radius(self) -> float:
        """The largest of the runs that may be the present one [m]."""
        return max(run.reservation.radius for run in self._runs.values())

    @property
    def margin(self) -> float:
        """The largest of the runs that may be the present one [m]."""
        return max(run.reservation.margin for run in self._runs.values())

    def objection(
        self, piece: Path, asked_in: int | None, clearance: float, precedence: tuple[int, str]
    ) -> Ruling:
        """Return what it has against ``piece``, which this tree requests.

        Args:
            piece: Where the centre of this tree would go next.
            asked_in: Number of the first message that told of the request; None: none has yet.
            clearance: To keep between the two centres [m].
            precedence: Of this tree.

        """
        reservation = self.reservation
        first = precedence < reservation.precedence
        clear = all(keeps_away(piece, floor, clearance) for floor in self.floors())
        if self.stays and clear:
            return GRANTED
        if self.silent:
            allowed = self.sides is not None and self.sides.allow(piece, clearance)
            silent = f'{reservation.name}, which is silent'
            return GRANTED if allowed else Ruling(Answer.TAKEN, silent)
        if not clear or not (first or apart(line(piece), reservation.requested_line, clearance)):
            return Ruling(Answer.TAKEN, reservation.name)
        if asked_in is None or not self.answered(asked_in):
            return Ruling(Answer.PENDING, reservation.name)
        return GRANTED

    def floors(self) -> list[Floor]:
        """Return the floor that is taken, of the present run and of each that may be it yet."""
        present = self.reservation.message_id.run
        doubtful = [
            other.reservation.most_floor for run, other in self._runs.items() if run != present
        ]
        return [self.reservation.most_floor if self.silent else self.reservation.floor, *doubtful]


class Peers:
    """All other trees that were ever heard."""

    def __init__(self, name: str, run: int, silent_after: float) -> None:
        """Know nobody.

        Args:
            name: Of the tree that listens.
            run: Its present run.
            silent_after: A peer not heard for longer is silent [s].

        """
        self._name, self._run = name, run
        self._silent_after = silent_after
        self._peers: dict[str, Peer] = {}

    def __iter__(self) -> Iterator[Peer]:
        """Yield every peer."""
        return iter(self._peers.values())

    def __len__(self) -> int:
        """Return how many are known."""
        return len(self._peers)

    def __contains__(self, name: object) -> bool:
        """Return whether the tree ``name`` was ever heard."""
        return name in self._peers

    def echo(self, reservation: Reservation) -> int:
        """Return the number of this run's last message that ``reservation`` knows; -1: none."""
        message_id = reservation.received.get(self._name)
        return message_id.number if message_id is not None and message_id.run == self._run else -1

    def receive(self, reservation: Reservation, now: float, next_number: int) -> None:
        """Take up a message; see :meth:`Peer.receive`."""
        peer, echo = self._peers.get(reservation.name), self.echo(reservation)
        if peer is None:
            self._peers[reservation.name] = Peer(reservation, echo, now, next_number)
        else:
            peer.receive(reservation, echo, now, next_number)

    def judge(self, now: float, held: shapely.Geometry, moved_since: int) -> None:
        """Find out who is silent, and agree on sides with those who knew of this tree.

        Whatever a silent tree asked for counts as granted to it.

        Args:
            now: Time of this tree's steady clock [s].
            held: What this tree holds.
            moved_since: Number of the first message that tells all of it; of a tree that was
                carried after its last word was heard, nobody else knows on which side it is.

        """
        for peer in self:
            if peer.silent or peer.stays or now - peer.received_at <= self._silent_after:
                continue
            peer.silent = True
            known = peer.mutual and peer.answered(moved_since)
            peer.sides = Sides(held, peer.reservation.both) if known else None

    def forget_agreements(self, next_number: int) -> None:
        """Share no floor with anybody who has not answered a message from there on."""
        for peer in self:
            peer.sides, peer.mutual_from = None, next_number

    def received(self) -> dict[str, MessageId]:
        """Return the last message of each peer that is not silent."""
        return {
            peer.reservation.name: peer.reservation.message_id for peer in self if not peer.silent
        }

    def doubled(self, now: float) -> list[str]:
        """Return the names that more than one tree bore within the time of silence."""
        return [p.reservation.name for p in self if now - p.doubled_at <= self._silent_after]

    def latest_journey(self) -> int:
        """Return the latest journey heard of; 0: none."""
        return max((p.reservation.journey for p in self if p.reservation.journey < IDLE), default=0)
