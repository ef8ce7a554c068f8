"""What one tree tells the others: the floor it holds, what it asks for, where it means to go."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from math import isfinite
from typing import TYPE_CHECKING

from agv_motion.errors import SignalError
from agv_motion.motion.polyline import Way, joined, line

if TYPE_CHECKING:
    from collections.abc import Mapping

    import shapely

IDLE = (2**31 - 1) * 10**9
"""[ns] Journey of a tree that has none: younger than any."""

TOUCH = 1e-6
"""[m] Rounding that is no overlap."""


@dataclass(frozen=True)
class Claim:
    """One message of one tree; immutable."""

    name: str
    """of the tree: its namespace"""
    stamp: int
    """[ns] of the sender's clock; every message of a tree has a later one than the last"""
    radius: float
    """[m] of the disc about a centre that the tree may occupy: body, error and half the margin"""
    held: Way
    """where its centre may be, from where it is on: nobody else may come near"""
    asked: Way = ()
    """where its centre would go next, joined to the end of ``held``"""
    wish: Way = ()
    """the whole rest of its way"""
    journey: int = IDLE
    """[ns] when the tree set out for its goal: who set out first goes first"""
    heard: Mapping[str, int] = field(default_factory=dict)
    """stamp of the last message it has of each tree that it hears"""
    parked: bool = False
    """it stays where it is, and asks before it ever moves again"""

    def __post_init__(self) -> None:
        """Refuse what would void the promises of :class:`RightOfWay`.

        Raises:
            SignalError: No name, no place, or a number that is not finite.

        """
        if not self.name or not self.held:
            msg = f"claim of '{self.name}' with {len(self.held)} points held: needs name and place"
            raise SignalError(msg)
        if not (isfinite(self.radius) and self.radius > 0.0):
            msg = f"claim of '{self.name}': radius {self.radius} m must be positive"
            raise SignalError(msg)
        for x, y in (*self.held, *self.asked, *self.wish):
            if not (isfinite(x) and isfinite(y)):
                msg = f"claim of '{self.name}' goes through ({x}, {y}): must be finite"
                raise SignalError(msg)

    @property
    def precedence(self) -> tuple[int, str]:
        """Who goes first: the lesser; a total order, since names differ."""
        return self.journey, self.name

    @cached_property
    def held_line(self) -> shapely.Geometry:
        """The way of ``held``."""
        return line(self.held)

    @cached_property
    def asked_line(self) -> shapely.Geometry:
        """The way of ``asked``; empty if it asks for nothing."""
        return line(self.asked)

    @cached_property
    def both(self) -> shapely.Geometry:
        """All that it may hold by now: ``held``, and ``asked`` if that was granted meanwhile."""
        return line(joined(self.held, self.asked))

    @cached_property
    def wish_line(self) -> shapely.Geometry:
        """The way of ``wish``; empty if it has none."""
        return line(self.wish)


def apart(a: shapely.Geometry, b: shapely.Geometry, clearance: float) -> bool:
    """Return whether two ways keep ``clearance`` [m]; nothing keeps it from anything."""
    return bool(not a.distance(b) < clearance - TOUCH)  # the distance of an empty one is NaN
