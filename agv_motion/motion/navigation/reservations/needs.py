"""What the other trees need of the floor, as one tree sees it: held, asked for, and planned."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.motion.navigation.polyline import cut, line
from agv_motion.motion.navigation.reservations.reservation import IDLE
from agv_motion.motion.navigation.reservations.separation import Floor, free_part

if TYPE_CHECKING:
    import shapely

    from agv_motion.motion.navigation.polyline import Path
    from agv_motion.motion.navigation.reservations.peers import Peer
    from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay

ARRIVED = 0.05
"""[m] The end of what is held counts as reached from here."""

COURTESY = 4.0
"""[m] of the path of who goes first that the others keep off; who gave way keeps off all of it."""


class Need(NamedTuple):
    """A path that another tree needs, and the clearance to keep from it [m]."""

    path: shapely.Geometry
    clearance: float


class Blocked(NamedTuple):
    """How much of a path is free, and who is in the way of the rest; empty if nobody is."""

    path: Path
    by: str


class Needs:
    """What the peers of one tree need."""

    def __init__(self, right: RightOfWay) -> None:
        """Look at them through what ``right`` has heard."""
        self._right = right
        self.courtesy = COURTESY
        """[m] of the path of who goes first that this tree keeps off"""

    def of_all(self, *, plans: bool = True, standing: bool = False) -> list[Need]:
        """Return what all others need.

        Args:
            plans: Whether to count the next metres of those who go first, which courtesy leaves
                them; else whatever they ask for counts.
            standing: Whether to count only those who ask for nothing.

        """
        return [
            Need(floor.line, self.clearance(peer))
            for peer in self._right.peers
            if not standing or not peer.reservation.requested
            for floor in self._of(peer, plans=plans)
        ]

    def held(self) -> list[tuple[Floor, float]]:
        """Return the floor that others may hold, and the clearance to keep from each [m]."""
        return [
            (floor, self.clearance(peer)) for peer in self._right.peers for floor in peer.floors()
        ]

    def leave(self, piece: Path, least: float, *, plans: bool) -> Blocked:
        """Return how much of ``piece`` keeps clear of all others, and who is in the way.

        Args:
            piece: Where the tree would go next.
            least: A shorter piece is none [m].
            plans: See :meth:`of_all`.

        """
        blocker = ''
        for peer in self._right.peers:
            for floor in self._of(peer, plans=plans):
                free = free_part(piece, floor, self.clearance(peer), least)
                if free != piece:
                    piece, blocker = free, peer.reservation.name
        return Blocked(piece, blocker)

    def step(self, piece: Path, spare: float) -> Blocked:
        """Return how much of ``piece`` the tree may go, whatever floor it was granted.

        No step leads nearer to floor that another may hold, or to where it stands, than the
        clearance, unless it leads away. This is the last guard: it stops a tree where a promise
        was broken, as by one that was carried onto its floor.

        Args:
            piece: Straight from where the tree is.
            spare: The tree may be off its path by so much, and nearer by it [m].

        """
        blocker = ''
        for peer in self._right.peers:
            clearance = self.clearance(peer) - spare
            for floor in peer.floors():
                free = free_part(piece, floor, clearance)
                if free != piece:
                    piece, blocker = free, peer.reservation.name
        return Blocked(piece, blocker)

    def plans(self, reach: float, spare: float) -> list[Need]:
        """Return the first ``reach`` [m] of the plans of all who go first, ``spare`` [m] wider."""
        return [
            Need(line(cut(peer.reservation.planned, reach)[0]), self.clearance(peer) + spare)
            for peer in self._right.peers
            if not peer.silent and peer.reservation.planned and self._goes_first(peer)
        ]

    def last_begun(self) -> float | None:
        """Return when this tree first heard of the last of the journeys after its own [s].

        None where there is no such journey. Clocks of two trees are never compared.
        """
        after = [
            peer.journey_since
            for peer in self._right.peers
            if not (peer.silent or peer.reservation.journey == IDLE or self._goes_first(peer))
        ]
        return max(after, default=None)

    def clearance(self, peer: Peer) -> float:
        """Return the distance that the centres of the two trees keep [m]."""
        return self._right.clearance(peer)

    def _of(self, peer: Peer, *, plans: bool) -> list[Floor]:
        reservation = peer.reservation
        first = self._goes_first(peer)
        floors = peer.floors()
        if reservation.requested and not peer.silent and (first or not plans):
            floors.append(Floor(reservation.requested_line, reservation.floor.corners))
        if plans and reservation.planned and first and not peer.silent:
            floors.append(
                Floor(line(cut(reservation.planned, self.courtesy)[0]), reservation.floor.corners)
            )
        return floors

    def _goes_first(self, peer: Peer) -> bool:
        return peer.reservation.precedence < self._right.precedence
