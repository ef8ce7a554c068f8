"""A state of the search in `traffic_search.py`: trees and the words on their way, never changed."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from agv_motion.motion.navigation.polyline import line
from agv_motion.motion.navigation.reservations.separation import apart

if TYPE_CHECKING:
    from collections.abc import Hashable

    from agv_motion.motion.navigation.reservations.peers import Peer
    from agv_motion.motion.navigation.reservations.reservation import Reservation
    from agv_motion.motion.navigation.reservations.right_of_way import RightOfWay

T = TypeVar('T')


class State(NamedTuple):
    """All trees, and the words on their way; nothing in it is ever changed."""

    trees: tuple[RightOfWay, ...]
    keys: tuple[Hashable, ...]
    """what tells two states of each tree apart"""
    mail: tuple[Reservation, ...]

    def key(self) -> Hashable:
        """Return what tells two states apart."""
        return self.keys, tuple(
            (reservation.name, reservation.message_id) for reservation in self.mail
        )


def breached(state: State, clearance: float) -> bool:
    """Return whether two trees hold the same floor, that on which one only believes to be apart."""
    paths = [tree.held if tree.doubt is None else tree.doubt.before for tree in state.trees]
    return not all(apart(line(a), line(b), clearance) for a, b in combinations(paths, 2))


def same_run(a: Reservation, b: Reservation) -> bool:
    """Return whether two words are of the same run of the same tree."""
    return a.name == b.name and a.message_id.run == b.message_id.run


def news(reservation: Reservation, mail: tuple[Reservation, ...]) -> bool:
    """Return whether ``reservation`` says what the last word of its run did not."""
    last = next((old for old in reversed(mail) if same_run(old, reservation)), None)
    return last is None or _said(last) != _said(reservation)


def clone(tree: RightOfWay) -> RightOfWay:
    """Return a tree that can be changed without the other; what never changes is shared."""
    new = _copied(tree)
    new.peers = _copied(tree.peers)
    peers = tree.peers._peers  # noqa: SLF001
    new.peers._peers = {name: _clone_peer(peer) for name, peer in peers.items()}  # noqa: SLF001
    return new


def _clone_peer(peer: Peer) -> Peer:
    new = _copied(peer)
    new._runs, new._ended = dict(peer._runs), dict(peer._ended)  # noqa: SLF001
    return new


def _copied(thing: T) -> T:
    """Return a shallow copy, faster than `copy.copy`."""
    new = object.__new__(type(thing))
    new.__dict__.update(thing.__dict__)
    return new


def _said(reservation: Reservation) -> tuple[Hashable, ...]:
    return (
        reservation.held,
        reservation.requested,
        reservation.journey,
        reservation.received,
        reservation.parked,
    )


def key(tree: RightOfWay) -> Hashable:
    """Return what tells two states of a tree apart."""
    peers = tuple(_peer_key(peer) for peer in tree.peers)
    return (
        tree.run, tree._number, tree.held, tree.requested, tree._requested_since, tree.parked,  # noqa: SLF001
        tree.journey, tree.doubt, tree._moved_since, peers,  # noqa: SLF001
    )  # fmt: skip


def _peer_key(peer: Peer) -> Hashable:
    runs = tuple((r.reservation.message_id, r.since) for _, r in sorted(peer._runs.items()))  # noqa: SLF001
    ended = tuple(sorted(peer._ended.items()))  # noqa: SLF001
    sides = peer.sides and (peer.sides.own.wkb, peer.sides.theirs.wkb)
    return (
        runs, ended, peer.reservation.message_id, peer.echo, peer.mutual_from, peer.silent, sides,
        peer.doubled_at,
    )  # fmt: skip
