"""What takes a tree where it wants to be: by which path, and where to head for now.

There are two: :class:`PathFollower`, for a tree that is alone in its zone, and `SharedNavigator`
of `reservations/`, for one among others. A tree without a zone goes straight.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    import shapely

    from agv_motion.errors import GeometryError
    from agv_motion.motion.navigation.polyline import Path, Point


class Guidance(NamedTuple):
    """How a tree goes on now."""

    target: Point | None = None
    """where to head for, straight [m]; None: stay"""
    path: Path = ()
    """corners from here on to the goal, or to where it gives way [m]; empty if it goes nowhere"""
    reason: str = ''
    """why it stays or gives way, in words; empty while it goes on to its goal"""
    blocked: float = 0.0
    """[s] for how long others have kept it from going on to its goal"""
    gives_way: bool = False
    """whether it goes out of the way of others, not to its goal"""
    waits_for: str = ''
    """the other tree for which it stays, or out of whose way it goes; empty if for none"""
    failure: GeometryError | None = None
    """why no path leads to the goal; None if one does"""


class Navigator(Protocol):
    """Finds the path to a goal and says where to head for, step by step."""

    patience: float
    """[s] one that is blocked for longer should look for another goal"""

    def navigate(
        self, goal: Point | None, here: Point, now: float, *, straight: bool = False
    ) -> Guidance:
        """Return how to go on to ``goal``.

        Args:
            goal: Where to be in the map [m]; None: nowhere, but out of the way of others.
            here: Where the centre is in the map [m].
            now: Time of one clock [s].
            straight: Whether the straight line leads there: back into a zone nothing is planned.

        """

    def rest(self, here: Point, now: float) -> None:
        """Note that the tree stays at ``here`` [m], whoever comes."""

    def closed(self) -> shapely.Geometry | None:
        """Return the floor on which no goal makes sense now; None: there is none."""


class StraightNavigator:
    """Goes straight: for a tree that knows of no zone, and of no other tree."""

    patience = inf

    def navigate(
        self,
        goal: Point | None,
        here: Point,
        now: float,  # noqa: ARG002 - whenever it is
        *,
        straight: bool = True,  # noqa: ARG002 - it always is
    ) -> Guidance:
        """Return the straight line to ``goal``; see :meth:`Navigator.navigate`."""
        return Guidance() if goal is None else Guidance(goal, (here, goal))

    def rest(self, here: Point, now: float) -> None:
        """Do nothing: nobody needs to know."""

    def closed(self) -> None:
        """Return None: nobody takes any floor."""
