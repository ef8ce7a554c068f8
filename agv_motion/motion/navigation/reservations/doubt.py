"""Where a tree may be whose pose has jumped: at all places it was taken to be at, until it is sure.

It was carried, or did not know where it was, or believes now what is wrong. Nobody can tell which
at once, so it holds all of these places, and stands. It is sure once its pose has agreed with
itself for long enough; a fix that comes and goes begins the time anew.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.motion.navigation.polyline import cut, joined, nearest

if TYPE_CHECKING:
    from agv_motion.motion.navigation.polyline import Path, Point

MOST_PLACES = 20
"""[1] places that are kept between what was held before and the latest; more is noise, or a trail
of being carried, and a tree that stands is at the first or at the last"""


class Doubt(NamedTuple):
    """Where a tree may be; immutable."""

    before: Path
    """what it held when the doubt began"""
    places: tuple[Point, ...]
    """where it was taken to be since then, the latest first"""
    since: float
    """from when on it was taken to be at the latest of them [s]"""
    why: str
    """in words"""

    @property
    def floor(self) -> Path:
        """All that it holds, and the straight paths between: from the latest place to the first."""
        return joined(self.places, self.before)

    def seen(self, place: Point, tolerance: float, now: float) -> Doubt:
        """Return what is known when the pose says ``place``.

        Args:
            place: Where the centre is said to be [m].
            tolerance: A place nearer than this is the same [m].
            now: Time of this tree's steady clock [s].

        """
        if nearest(self.places[:1], place)[1] <= tolerance:
            return self
        known = next((p for p in self.places if nearest((p,), place)[1] <= tolerance), None)
        if known is None:
            along, away = nearest(self.before, place)
            known = cut(self.before, along)[1][0] if away <= tolerance else place
        others = tuple(p for p in self.places if p != known)[:MOST_PLACES]
        return self._replace(places=(known, *others), since=now)


def jumped(held: Path, place: Point, tolerance: float, now: float) -> Doubt | None:
    """Return the doubt that begins when a tree that holds ``held`` is told to be at ``place``.

    None where it is on its path, or off it by no more than ``tolerance`` [m].
    """
    away = nearest(held, place)[1]
    if away <= tolerance:
        return None
    why = (
        f'it was {away:.2f} m off its way, more than the tolerance of {tolerance:g} m: it must be '
        'sure where it is, and others must have heard so'
    )
    return Doubt(held, (place,), now, why)
