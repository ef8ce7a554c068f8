"""What the mind of a tree makes of a moment, and what others allow it meanwhile."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import shapely

    from agv_motion.motion.behavior.goals import Goal
    from agv_motion.motion.command.limits import FloorRules
    from agv_motion.motion.command.polar import PolarCommand
    from agv_motion.motion.navigation.path_planner import Point


class Surroundings(NamedTuple):
    """What others allow: the seam to other trees."""

    avoid: shapely.Geometry | None = None
    """area to keep off, taken off the walkable floor; the same object while it is the same"""
    wait: str = ''
    """why the tree must not go on now, in words; empty if it may"""


ALONE = Surroundings()


class Decision(NamedTuple):
    """What the tree makes of a moment."""

    wanted: PolarCommand
    """before the limits"""
    activity: str
    """what it does, in words"""
    place: FloorRules
    """what the place allows, for the limits"""
    goal: Goal | None
    path: tuple[Point, ...]
    """corners from here to the goal; empty if it goes nowhere"""
    aside: float = 0.0
    """v at least while it walks out of the way of others; 0: it stays where it is"""
