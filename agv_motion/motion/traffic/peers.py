"""The other trees as one tree knows them: what they claim, and whether they still speak."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import shapely

from agv_motion.motion.polyline import length, line
from agv_motion.motion.traffic.claim import Claim, apart

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.motion.polyline import Way

STRIDE = 0.05
"""[m] between the places at which a way is tested against the border of two sides."""


SQUARE = 0.5
"""[m] Edge of the squares in which the floor of the other side is told."""


class Sides(NamedTuple):
    """How two trees that do not hear each other share the floor: each keeps to what is nearer.

    With A and B what they held last, a tree at p keeps ``d(p, A) + c <= d(p, B)``, the other at q
    ``d(q, B) + c <= d(q, A)``. By the triangle inequality ``d(p, B) <= |pq| + d(q, B)`` and
    ``d(q, A) <= |pq| + d(p, A)``; added up, ``|pq| >= c``: they stay clear without a word.
    """

    own: shapely.Geometry
    """what this tree held when the other fell silent"""
    theirs: shapely.Geometry
    """all that the other may have held then"""

    def allow(self, way: Way, clearance: float) -> bool:
        """Return whether all of ``way`` lies on this tree's side.

        Both distances change by at most one metre a metre, so between two tested places the
        difference is off by no more than the distance between the two.
        """
        count = max(int(length(way) / STRIDE) + 1, 2)
        places = line(way)
        if len(way) > 1:
            places = shapely.line_interpolate_point(
                places, np.linspace(0.0, 1.0, count), normalized=True
            )
        slack = length(way) / (count - 1)
        own, theirs = shapely.distance(places, self.own), shapely.distance(places, self.theirs)
        return bool(np.all(own + clearance + slack <= theirs))

    def closed(
        self, bounds: tuple[float, float, float, float], clearance: float
    ) -> shapely.Geometry:
        """Return, in squares, the part of a rectangle that does not lie on this tree's side.

        Args:
            bounds: Smallest x and y, largest x and y of the rectangle [m].
            clearance: Between the two trees [m].

        """
        west, south, east, north = bounds
        half = SQUARE / 2.0
        x, y = np.meshgrid(
            np.arange(west + half, east + half, SQUARE),
            np.arange(south + half, north + half, SQUARE),
        )
        places = shapely.points(x, y)
        away = shapely.distance(places, self.theirs) - shapely.distance(places, self.own)
        out = away < clearance + STRIDE
        x, y = x[out], y[out]
        return shapely.union_all(shapely.box(x - half, y - half, x + half, y + half))


class Peer:
    """One other tree."""

    def __init__(self, claim: Claim, now: float, next_stamp: int) -> None:
        """Note its first words."""
        self.claim = claim
        self.heard_at = now
        self.mutual_from = next_stamp
        """Stamp of the first message sent to it since it was heard (again)."""
        self.silent = False
        self.sides: Sides | None = None
        """How the floor is shared while it is silent; None where nothing is agreed."""

    def answered(self, name: str, stamp: int) -> bool:
        """Return whether its last claim was made in the knowledge of message ``stamp``."""
        return self.claim.heard.get(name, -1) >= stamp


class Peers:
    """All other trees that were ever heard."""

    def __init__(self, name: str, silent_after: float) -> None:
        """Know nobody.

        Args:
            name: Of the tree that listens.
            silent_after: A peer not heard for longer is silent [s].

        """
        self._name = name
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

    def hear(self, claim: Claim, now: float, next_stamp: int) -> None:
        """Take up a message; one that was overtaken by a later one is dropped.

        Args:
            claim: What it says.
            now: When it came, on this tree's clock [s].
            next_stamp: Of the next message this tree will send [ns].

        """
        peer = self._peers.get(claim.name)
        if peer is None:
            self._peers[claim.name] = Peer(claim, now, next_stamp)
            return
        if claim.stamp <= peer.claim.stamp:
            return
        if peer.silent:
            peer.silent, peer.sides, peer.mutual_from = False, None, next_stamp
        peer.claim, peer.heard_at = claim, now

    def judge(self, now: float, held: shapely.Geometry, radius: float) -> None:
        """Find out who is silent, and agree on sides with those who knew of this tree.

        Args:
            now: Time of this tree's clock [s].
            held: What this tree holds.
            radius: Of this tree [m].

        """
        for peer in self:
            if peer.silent or peer.claim.parked or abs(now - peer.heard_at) <= self._silent_after:
                continue
            peer.silent = True
            if peer.answered(self._name, peer.mutual_from):
                claim = peer.claim
                granted = apart(claim.asked_line, held, radius + claim.radius)
                peer.sides = Sides(held, claim.both if granted else claim.held_line)

    def forget_agreements(self, next_stamp: int) -> None:
        """Share no floor with anybody who has not answered a message from ``next_stamp`` on."""
        for peer in self:
            peer.sides, peer.mutual_from = None, next_stamp

    def heard(self) -> dict[str, int]:
        """Return the stamp of the last message of each peer that is not silent."""
        return {peer.claim.name: peer.claim.stamp for peer in self if not peer.silent}
