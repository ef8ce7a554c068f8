"""How far a robot is on its path, and for how long it has stood."""

from __future__ import annotations

from itertools import accumulate, pairwise
from math import dist, nan
from typing import TYPE_CHECKING

from agv_motion.planar import wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.planar import Pose

AHEAD = 40
"""Pieces ahead that are looked at: a path that crosses itself is not cut short."""

GRAIN = 1e-3
"""[m] Places of a path nearer than this to each other are one."""

MOVED, TURNED = 0.01, 0.01
"""[m], [rad] Less is no motion: the grain of the wheels' encoders."""


class RemainingPath:
    """A polyline that a robot follows, and the piece of it that it has come to."""

    def __init__(self, points: Sequence[tuple[float, float]], frame: str = '') -> None:
        """Begin at the first of ``points`` [m], in a frame."""
        self.frame, self.last = frame, nan
        """in which the points are; what was left of it the last time [m]"""
        apart = _apart(points)
        self._pieces = list(pairwise(apart)) or [(one, one) for one in apart]
        lengths = [dist(a, b) for a, b in self._pieces]
        self._after = [sum(lengths) - behind for behind in accumulate(lengths)]
        self._piece = 0

    def left(self, place: tuple[float, float]) -> float:
        """Return the way from ``place`` to the end [m], and go on to there; it never goes back.

        That is the way to the nearest point of the path, and on from there; NaN without a path.
        """
        pieces = self._pieces[self._piece : self._piece + AHEAD]
        if not pieces:
            return nan
        found = [_to_end(place, *piece) for piece in pieces]
        best = min(range(len(found)), key=lambda i: found[i][0])
        self._piece += best
        self.last = sum(found[best]) + self._after[self._piece]
        return self.last


def _apart(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return places without those at which a path only turns."""
    kept = list(points[:1])
    for point in points:
        if dist(point, kept[-1]) > GRAIN:
            kept.append(point)
    return kept


def _to_end(
    place: tuple[float, float], start: tuple[float, float], end: tuple[float, float]
) -> tuple[float, float]:
    """Return how far ``place`` is from a piece, and how much of the piece is left from there."""
    length = dist(start, end)
    if length == 0.0:
        return dist(place, end), 0.0
    ux, uy = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    along = min(max((place[0] - start[0]) * ux + (place[1] - start[1]) * uy, 0.0), length)
    foot = start[0] + along * ux, start[1] + along * uy
    return dist(place, foot), length - along


class StandWatch:
    """Measures for how long a robot has stood, by what its wheels tell."""

    def __init__(self, now: float) -> None:
        """Begin at ``now``, by a steady clock [s]."""
        self._pose: Pose | None = None
        self._moved_at = now

    def begin(self, now: float) -> None:
        """Count from now on."""
        self._moved_at = now

    def look(self, pose: Pose, now: float) -> None:
        """Take in where the wheels have carried it."""
        last = self._pose
        if (
            last is None
            or dist(last[:2], pose[:2]) > MOVED
            or abs(wrap(last.theta - pose.theta)) > TURNED
        ):
            self._pose, self._moved_at = pose, now

    def seconds(self, now: float) -> float:
        """Return for how long it has stood [s]."""
        return now - self._moved_at
