"""A place to go to, and why."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from agv_motion.motion.navigation.polyline import Point


class Objective(Enum):
    """What the tree seeks, in the order in which it seeks them."""

    SUN = 'highest remembered sap flow'
    SHADE = 'lowest remembered sap flow'
    UNKNOWN = 'longest unvisited'


class Goal(NamedTuple):
    """A place to go to, and why."""

    x: float
    """[m]"""
    y: float
    """[m]"""
    reason: str
    """in words"""
    objective: Objective | None = None
    """None: asked for from outside"""

    @property
    def place(self) -> Point:
        """Where it is [m]."""
        return self.x, self.y
