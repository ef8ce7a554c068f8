"""The other trees as one tree knows them: who was ever heard, and who still speaks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.motion.navigation.reservations.peer import Peer
from agv_motion.motion.navigation.reservations.reservation import IDLE, MessageId, Reservation
from agv_motion.motion.navigation.reservations.sides import Sides

if TYPE_CHECKING:
    from collections.abc import Iterator

    import shapely


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
