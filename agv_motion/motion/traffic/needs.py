"""What the other trees need of the floor, as one tree sees it: held, asked for, and wished."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import shapely

from agv_motion.motion.polyline import Way, cut, length, line
from agv_motion.motion.traffic.claim import IDLE, apart

if TYPE_CHECKING:
    from agv_motion.motion.traffic.peers import Peer
    from agv_motion.motion.traffic.right_of_way import RightOfWay

COURTESY = 4.0
"""[m] of the way of who goes first that the others keep off; who gave way keeps off all of it."""

SAMPLE = 0.1
"""[m] between the places at which a way is tested for how far it is free."""

Need = tuple[shapely.Geometry, float]
"""A way that another tree needs, and the clearance to keep from it [m]."""


class Needs:
    """What the peers of one tree need."""

    def __init__(self, right: RightOfWay) -> None:
        """Look at them through what ``right`` has heard."""
        self._right = right
        self.courtesy = COURTESY
        """[m] of the way of who goes first that this tree keeps off"""

    def of_all(self, *, wishes: bool = True, standing: bool = False) -> list[Need]:
        """Return what all others need.

        Args:
            wishes: Whether to count the next metres of those who go first, which courtesy leaves
                them; else whatever they ask for counts.
            standing: Whether to count only those who ask for nothing.

        """
        return [
            need
            for peer in self._right.peers
            if not standing or not peer.claim.asked
            for need in self._of(peer, wishes=wishes)
        ]

    def leave(self, piece: Way, least: float, *, wishes: bool) -> tuple[Way, str]:
        """Return how much of ``piece`` keeps clear of all others, and who is in the way.

        Args:
            piece: Where the tree would go next.
            least: A shorter piece is none [m].
            wishes: See :meth:`of_all`.

        """
        blocker = ''
        for peer in self._right.peers:
            for way, clearance in self._of(peer, wishes=wishes):
                if len(piece) > 1 and not apart(line(piece), way, clearance):
                    piece, blocker = _prefix(piece, way, clearance, least), peer.claim.name
        return piece, blocker

    def wishes(self, reach: float, spare: float) -> list[Need]:
        """Return the first ``reach`` [m] of the wishes of all who go first, ``spare`` [m] wider."""
        return [
            (line(cut(peer.claim.wish, reach)[0]), self.clearance(peer) + spare)
            for peer in self._right.peers
            if not peer.silent and self._goes_first(peer)
        ]

    def last_begun(self) -> float | None:
        """Return when the last of the journeys after this tree's own began [s]; None: no such."""
        after = [
            peer.claim.journey * 1e-9
            for peer in self._right.peers
            if not (peer.silent or peer.claim.journey == IDLE or self._goes_first(peer))
        ]
        return max(after, default=None)

    def clearance(self, peer: Peer) -> float:
        """Return the distance that the centres of the two trees keep [m]."""
        return self._right.radius + peer.claim.radius

    def _of(self, peer: Peer, *, wishes: bool) -> list[Need]:
        claim, clearance = peer.claim, self.clearance(peer)
        first = self._goes_first(peer)
        needs = [(claim.held_line, clearance)]
        if claim.asked and (first or not wishes):
            needs.append((claim.asked_line, clearance))
        if wishes and claim.wish and first and not peer.silent:
            needs.append((line(cut(claim.wish, self.courtesy)[0]), clearance))
        return needs

    def _goes_first(self, peer: Peer) -> bool:
        return peer.claim.precedence < self._right.precedence


def _prefix(piece: Way, way: shapely.Geometry, clearance: float, least: float) -> Way:
    """Return ``piece`` up to where it comes too near to ``way``, or nearer than it begins."""
    count = max(int(length(piece) / SAMPLE) + 1, 2)
    share = np.linspace(0.0, 1.0, count)
    places = shapely.line_interpolate_point(line(piece), share, normalized=True)
    away = shapely.distance(places, way)
    bad = np.flatnonzero(away < min(clearance, float(away[0])))
    upto = length(piece) * float(share[bad[0] - 1]) if len(bad) else length(piece)
    while upto > least:
        short = cut(piece, upto)[0]
        if apart(line(short), way, min(clearance, float(away[0]))):
            return short
        upto /= 2.0
    return piece[:1]
