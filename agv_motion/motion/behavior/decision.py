"""What an agent makes of a moment."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.motion.command.limits import FloorRules

if TYPE_CHECKING:
    from agv_motion.motion.behavior.goals.goal import Goal
    from agv_motion.motion.navigation.polyline import Point

NO_RULES = FloorRules()


class Decision(NamedTuple):
    """What to do now, where to go and how; by which path, a navigator finds."""

    activity: str
    """what the tree does and why, in words"""
    goal: Goal | None
    """what it seeks, or would if it moved; for whoever watches"""
    destination: Point | None = None
    """where to go now [m]; None: it stays where it is"""
    speed: float = 0.0
    """v on the path there"""
    rotation: float = 0.0
    """omega, also while it stays or waits"""
    yield_speed: float = 0.0
    """v at least while it gives way to others; 0: it stays where it is, whoever comes"""
    straight: bool = False
    """whether it goes straight there, back into its zone"""
    rules: FloorRules = NO_RULES
    """what the floor allows, for the limits"""
