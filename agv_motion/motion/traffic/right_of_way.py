"""Floor is held by one tree at a time: how a tree comes to hold it, and why no two ever overlap.

A tree moves its centre only along the way it holds, and may let go of any part of it at any time.
To hold more it asks: the piece stands in every message it sends until it is granted or withdrawn.
It grants itself the piece when, for every other tree it knows, going by the last message of each,

1. the piece keeps clear of all that the other holds,
2. the other had heard of the request when it sent that message (its answer names the stamp), and
3. the piece keeps clear of what the other asks for, or this tree has precedence.

That no two hold overlapping floor follows without any word on time, so late and lost messages and
clocks that differ only cost time. Say A has precedence over B and their pieces overlap.
If B granted itself last, it had a message that A sent after hearing of B's request. Had A asked by
then, that message showed it, and B gave way (3, or 1 where A held it by then). Had A not asked by
then, A granted itself only on a message that B sent after hearing of A's request, hence while it
knew of it: B gave way. If A granted itself last: A had such a message of B as well; were B's piece
granted before B sent it, the message shows it as held (1); if after, B knew of A's request and
gave way. A message overtaken by a later one is dropped, so nobody forgets what it knew.

A tree that falls silent answers no more. What it held and asked for stays taken, and the floor is
shared as :class:`Sides` says, with those who knew of each other. A tree that says it is parked
needs no answer: it holds its place and will ask before it moves.

The idea is that of G. Ricart and A. K. Agrawala, "An optimal algorithm for mutual exclusion in
computer networks", Communications of the ACM 24(1), 1981, with floor in place of one resource.
"""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import SignalError
from agv_motion.motion.polyline import Way, cut, joined, length, line
from agv_motion.motion.traffic.claim import IDLE, TOUCH, Claim, apart
from agv_motion.motion.traffic.peers import Peer, Peers

if TYPE_CHECKING:
    import shapely

    from agv_motion.motion.polyline import Point
    from agv_motion.motion.traffic.parameters import TrafficParameters


class Answer(Enum):
    """What came of a request."""

    GRANTED = 'granted'
    PENDING = 'waits for the answer of'
    TAKEN = 'waits for'
    LISTENING = 'listens who else is there'


class Verdict(NamedTuple):
    """What came of a request, and through whom."""

    answer: Answer
    name: str = ''

    def __str__(self) -> str:
        """In words."""
        return f'{self.answer.value} {self.name}'.rstrip()


GRANTED = Verdict(Answer.GRANTED)


class RightOfWay:
    """What one tree holds of the floor, and what it asks for."""

    def __init__(self, name: str, place: Point, parameters: TrafficParameters) -> None:
        """Hold the place where the tree stands, and nothing else.

        Args:
            name: Of this tree, different from every other's.
            place: Where its centre is, in the map [m].
            parameters: How trees share the zone.

        """
        self.name, self.parameters = name, parameters
        self.radius = parameters.radius
        self.peers = Peers(name, parameters.silent_after)
        self.held: Way = (place,)
        self.parked = False
        self._journey = IDLE
        self._begun: float | None = None
        self._held_line = line(self.held)
        self.asked: Way = ()
        self._asked_line = line(())
        self._asked_since: int | None = None
        self._stamp = -1

    def hear(self, claim: Claim, now: float) -> None:
        """Take up the message of another tree.

        Raises:
            SignalError: It bears the name of this tree, but this tree did not send it.

        """
        if claim.name != self.name:
            self.peers.hear(claim, now, self._stamp + 1)
        elif claim.stamp > self._stamp:
            msg = f"another tree calls itself '{self.name}' as well: give each its own name"
            raise SignalError(msg)

    def claim(self, now: float, wish: Way = ()) -> Claim:
        """Return the next message; it must be sent, for what it asks counts as announced."""
        self._stamp = max(round(now * 1e9), self._stamp + 1)
        if self.asked and self._asked_since is None:
            self._asked_since = self._stamp
        self._begun = now if self._begun is None else self._begun
        self.peers.judge(now, self._held_line, self.radius)
        return Claim(
            self.name, self._stamp, self.radius, self.held, self.asked, wish, self._journey,
            self.peers.heard(), self.parked,
        )  # fmt: skip

    def stand(self, place: Point) -> None:
        """Hold ``place`` and nothing else, because the tree is there: a fact, not a request."""
        self.withdraw()
        self._hold((place,))

    def pass_by(self, distance: float) -> None:
        """Let go of the first ``distance`` [m] of what is held: the tree has left it behind."""
        if distance > 0.0:
            self._hold(cut(self.held, distance)[1])

    def stop(self) -> None:
        """Let go of all but the place where the tree is, and ask for nothing."""
        self.withdraw()
        if len(self.held) > 1:
            self._hold(self.held[:1])

    def park(self) -> None:
        """Promise to stay here until :meth:`ask` takes the promise back."""
        self.stop()
        self.parked = True

    @property
    def journey(self) -> int:
        """When the tree set out for its goal [ns]: the older of two has precedence."""
        return self._journey

    def set_out(self, journey: int) -> None:
        """Begin another journey; a request stands for the precedence it was made with, and ends."""
        self.withdraw()
        self._journey = journey

    def ask(self, piece: Way) -> None:
        """Ask for ``piece``, which begins where the held way ends; :meth:`settle` may grant it."""
        if self.parked:
            self.parked = False
            self.peers.forget_agreements(self._stamp + 1)
        self._ask(piece)

    def withdraw(self) -> None:
        """Ask for nothing."""
        if self.asked:
            self._ask(())

    @property
    def precedence(self) -> tuple[int, str]:
        """Who goes first: the lesser; see :class:`Claim`."""
        return self._journey, self.name

    @property
    def ahead(self) -> float:
        """Length of the way it holds [m]."""
        return length(self.held)

    def settle(self, now: float) -> Verdict:
        """Add what is asked for to what is held, if no other tree objects."""
        if not self.asked:
            return GRANTED
        self._begun = now if self._begun is None else self._begun
        if now - self._begun < self.parameters.listen:
            return Verdict(Answer.LISTENING)
        missing = [name for name in self.parameters.expected if name not in self.peers]
        if missing:
            return Verdict(Answer.PENDING, ', '.join(missing))
        self.peers.judge(now, self._held_line, self.radius)
        verdicts = [self._objection(peer) for peer in self.peers]
        for answer in (Answer.TAKEN, Answer.PENDING):
            for verdict in verdicts:
                if verdict.answer is answer:
                    return verdict
        self._hold(joined(self.held, self.asked))
        self._ask(())
        return GRANTED

    def clear_of(self, way: shapely.Geometry, peer: Peer) -> bool:
        """Return whether ``way`` keeps clear of what ``peer`` holds.

        Where the two are too near already, a way that does not lead nearer will do.
        """
        held, clearance = peer.claim.held_line, self.radius + peer.claim.radius
        if apart(way, held, clearance):
            return True
        return bool(way.distance(held) >= self._held_line.distance(held) - TOUCH)

    def _objection(self, peer: Peer) -> Verdict:
        claim, clearance = peer.claim, self.radius + peer.claim.radius
        if not self.clear_of(self._asked_line, peer):
            return Verdict(Answer.TAKEN, claim.name)
        if claim.parked:
            return GRANTED
        if peer.silent:
            allowed = peer.sides is not None and peer.sides.allow(self.asked, clearance)
            return GRANTED if allowed else Verdict(Answer.TAKEN, f'{claim.name}, which is silent')
        first = self.precedence < claim.precedence
        if not first and not apart(self._asked_line, claim.asked_line, clearance):
            return Verdict(Answer.TAKEN, claim.name)
        if self._asked_since is None or not peer.answered(self.name, self._asked_since):
            return Verdict(Answer.PENDING, claim.name)
        return GRANTED

    def _ask(self, piece: Way) -> None:
        self.asked, self._asked_since, self._asked_line = piece, None, line(piece)

    def _hold(self, way: Way) -> None:
        self.held, self._held_line = way, line(way)
