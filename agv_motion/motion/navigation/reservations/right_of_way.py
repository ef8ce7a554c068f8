"""Floor is held by one tree at a time: how a tree comes to hold it, and why no two ever overlap.

A tree moves its centre only along the path it holds, and may let go of any part of it at any time.
To hold more it asks: the piece stands in every message it sends until it is granted or withdrawn.
It grants itself the piece when, for every other tree it knows, going by the last message of each,

1. the piece keeps clear of all that the other holds,
2. the other, in its present run, says that it has heard of the request: its answer names a message
   of this tree's present run from the request on, and
3. the piece keeps clear of what the other asks for, or this tree has precedence.

The invariant: *no tree takes floor that another may hold by any word not yet known to be outdated*.
It follows without any word on time, so late and lost messages and clocks that differ only cost
time. Say A has precedence over B and their pieces overlap.
If B granted itself last, it had a message that A sent after hearing of B's request. Had A asked by
then, that message showed it, and B gave way (3, or 1 where A held it by then). Had A not asked by
then, A granted itself only on a message that B sent after hearing of A's request, hence while it
knew of it: B gave way. If A granted itself last: A had such a message of B as well; were B's piece
granted before B sent it, the message shows it as held (1); if after, B knew of A's request and
gave way. A message overtaken by a later one of its run is dropped, so nobody forgets what it knew.

A tree that starts again has a new run: all it knew is void, and it holds the place where it stands,
which its last run held. Answers to the last run do not count for the new one, and of a peer both
old and new floor stay taken until its new run has answered (:mod:`.peers`). It takes nothing before
all that it was told of, by ``expected`` or by a file, have answered.

A tree whose pose jumps does not know where it is: it holds all places where it may be, and stands,
until it is sure (:mod:`.doubt`).

A tree that falls silent answers no more. What it held and asked for stays taken, and the floor is
shared as :class:`Sides` says, with those who knew of each other. A tree that says it is parked
needs no answer: it holds its place and will ask before it moves. Its word counts only where it
knows of this tree as it is now, and not from before this tree was parked itself.

What a message may not do is told, and for a while nobody moves: two trees of one name, and a
reservation that cannot be understood (:meth:`RightOfWay.alarm`).

The idea is that of G. Ricart and A. K. Agrawala, "An optimal algorithm for mutual exclusion in
computer networks", Communications of the ACM 24(1), 1981, with floor in place of one resource, and
the order of journeys that of L. Lamport, "Time, clocks, and the ordering of events in a distributed
system", Communications of the ACM 21(7), 1978.
"""

from __future__ import annotations

import secrets
from typing import TYPE_CHECKING

from agv_motion.errors import SignalError
from agv_motion.motion.navigation.polyline import Path, cut, joined, length, line, nearest
from agv_motion.motion.navigation.reservations.doubt import jumped
from agv_motion.motion.navigation.reservations.peers import Peer, Peers
from agv_motion.motion.navigation.reservations.reservation import (
    GRANTED,
    IDLE,
    UNHEARD,
    Answer,
    MessageId,
    Reservation,
    Ruling,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.motion.navigation.polyline import Point
    from agv_motion.motion.navigation.reservations.doubt import Doubt
    from agv_motion.motion.navigation.reservations.parameters import TrafficParameters

MOST_PEERS = 100
"""[1] other trees in one zone"""

MOST_PLANNED = 500
"""[1] corners of the rest of a path that are told"""


class RightOfWay:
    """What one tree holds of the floor, and what it asks for."""

    def __init__(
        self,
        name: str,
        place: Point,
        parameters: TrafficParameters,
        run: int | None = None,
        known: Sequence[str] = (),
    ) -> None:
        """Hold the place where the tree stands, and nothing else.

        Args:
            name: Of this tree, different from every other's.
            place: Where its centre is, in the map [m].
            parameters: How trees share the zone.
            run: A number that no other run of any tree ever had; None: by chance, of 64 bits.
            known: Names of other trees that earlier runs heard.

        """
        self.name, self.parameters = name, parameters
        self.run = secrets.randbits(64) if run is None else run
        self.radius, self.margin = parameters.radius, parameters.margin
        self.peers = Peers(name, self.run, parameters.silent_after)
        self.awaited = [one for one in dict.fromkeys((*parameters.expected, *known)) if one != name]
        self.held: Path = (place,)
        self.parked = False
        self.journey = IDLE
        """Which journey it is on: the older of two has precedence."""
        self._begun: float | None = None
        self._held_line = line(self.held)
        self.requested: Path = ()
        self._requested_since: int | None = None
        self._number = -1
        self._alarm: tuple[str, float] | None = None
        self._twin: MessageId | None = None
        self.doubt: Doubt | None = None
        """Where the tree may be, where its pose has jumped; None while it is sure"""
        self._moved_since = 0

    def receive(self, reservation: Reservation, now: float) -> None:
        """Take up the message of another tree.

        Raises:
            SignalError: It bears the name of this tree, but this run of it did not send it, or
                there are more trees than any zone holds.

        """
        if reservation.name not in self.peers and len(self.peers) >= MOST_PEERS:
            msg = f"'{reservation.name:.40}' is one tree more than {MOST_PEERS}: who speaks there?"
            self.alarm(msg, now)
            raise SignalError(msg)
        if reservation.name != self.name:
            self.peers.receive(reservation, now, self._number + 1)
        elif reservation.message_id.run != self.run:
            self._twin = reservation.message_id
            if (
                self.peers.echo(reservation) >= 0
            ):  # it heard this run: no late word of an earlier one
                self.peers.receive(reservation, now, self._number + 1)
            msg = f"another tree calls itself '{self.name}' as well: give each its own name"
            self.alarm(msg, now)
            raise SignalError(msg)

    def alarm(self, why: str, now: float) -> None:
        """Take floor from nobody for the time of silence: what was heard makes no sense."""
        self._alarm = why, now

    def obstacle(self, now: float) -> str:
        """Return why nobody may move at all now, in words; empty if nothing is wrong."""
        if self.doubt is not None:
            return self.doubt.why
        if self._alarm is not None and now - self._alarm[1] <= self.parameters.silent_after:
            return self._alarm[0]
        doubled = next((name for name in self.peers.doubled(now) if name != self.name), None)
        return f"two trees call themselves '{doubled}': give each its own name" if doubled else ''

    def reservation(self, now: float, planned: Path = ()) -> Reservation:
        """Return the next message; it must be sent, for what it asks counts as announced.

        Args:
            now: Time of this tree's steady clock [s].
            planned: The rest of its path.

        """
        self._number += 1
        if self.requested and self._requested_since is None:
            self._requested_since = self._number
        self._begun = now if self._begun is None else self._begun
        self.peers.judge(now, self._held_line, self._moved_since)
        received = self.peers.received()
        if self._twin is not None:
            received[self.name] = self._twin
        return Reservation(
            self.name, MessageId(self.run, self._number), self.radius, self.held, self.requested,
            planned[:MOST_PLANNED], self.journey, received, self.parked, self.margin,
        )  # fmt: skip

    def locate(self, place: Point, now: float, *, fresh: bool = True) -> bool:
        """Take up where the tree is told to be; return whether it is sure of it.

        One that is farther off what it holds than the tolerance holds both, a fact and no request,
        and nothing is let go until its pose has agreed with itself for the time of silence.

        Args:
            place: Where the centre is, as far as is known [m].
            now: Time of this tree's steady clock [s].
            fresh: Whether its pose says so now; one that is only remembered makes nothing surer.

        """
        given, before = self.parameters, self.doubt
        if before is not None:
            doubt: Doubt | None = before.seen(place, given.tolerance, now)
        elif nearest(self.held, place)[1] <= given.tolerance:
            return True
        else:
            doubt = jumped(self.held, place, given.tolerance, now)
        if doubt is not None and not fresh:
            doubt = doubt._replace(since=now)
        if doubt is not None and now - doubt.since > given.silent_after:
            self.withdraw()
            self._hold(doubt.places[:1])
            doubt = None
        elif doubt is not None and (before is None or doubt.places != before.places):
            self.withdraw()
            self._moved_since = self._number + 1
            self._hold(doubt.floor)
        self.doubt = doubt
        return doubt is None

    def pass_by(self, distance: float) -> None:
        """Let go of the first ``distance`` [m] of what is held: the tree has left it behind."""
        if distance > 0.0 and self.doubt is None:
            self._hold(cut(self.held, distance)[1])

    def stop(self) -> None:
        """Let go of all but the place where the tree is, or may be, and ask for nothing."""
        self.withdraw()
        if len(self.held) > 1 and self.doubt is None:
            self._hold(self.held[:1])

    def park(self) -> None:
        """Promise to stay here until :meth:`request` takes the promise back."""
        self.stop()
        self.parked = True

    def set_out(self, journey: int | None = None) -> None:
        """Begin another journey; a request stands for the precedence it was made with, and ends.

        Args:
            journey: Which; None: one later than all that are known.

        """
        self.withdraw()
        if journey is None:
            own = self.journey if self.journey < IDLE else 0
            journey = min(max(own, self.peers.latest_journey()) + 1, IDLE - 1)
        self.journey = journey

    def request(self, piece: Path) -> None:
        """Ask for ``piece``, which begins where the held path ends; :meth:`settle` may grant it."""
        if self.parked:
            self.parked = False
            self.peers.forget_agreements(self._number + 1)
        self._set_request(piece)

    def withdraw(self) -> None:
        """Ask for nothing."""
        if self.requested:
            self._set_request(())

    @property
    def precedence(self) -> tuple[int, str]:
        """Who goes first: the lesser; see :class:`Reservation`."""
        return self.journey, self.name

    @property
    def ahead(self) -> float:
        """Length of the path it holds [m]."""
        return length(self.held)

    def settle(self, now: float) -> Ruling:
        """Add what is asked for to what is held, if no other tree objects.

        Args:
            now: Time of this tree's steady clock [s].

        """
        if not self.requested:
            return GRANTED
        self._begun = now if self._begun is None else self._begun
        if now - self._begun < self.parameters.listen:
            return Ruling(Answer.LISTENING)
        if why := self.obstacle(now):
            return Ruling(Answer.ALARM, why)
        self.peers.judge(now, self._held_line, self._moved_since)
        rulings = [
            peer.objection(
                self.requested, self._requested_since, self.clearance(peer), self.precedence
            )
            for peer in self.peers
        ]
        unheard = [name for name in self.awaited if name not in self.peers]
        rulings += [Ruling(Answer.PENDING, f'{name}, {UNHEARD}') for name in unheard]
        for answer in (Answer.TAKEN, Answer.PENDING):
            against = next((ruling for ruling in rulings if ruling.answer is answer), None)
            if against is not None:
                return against
        self._hold(joined(self.held, self.requested))
        self._set_request(())
        return GRANTED

    def clearance(self, peer: Peer) -> float:
        """Return the distance that the centres of this tree and another keep [m]."""
        return self.radius + peer.radius + max(self.margin, peer.margin)

    def _set_request(self, piece: Path) -> None:
        self.requested, self._requested_since = piece, None

    def _hold(self, path: Path) -> None:
        self.held, self._held_line = path, line(path)
