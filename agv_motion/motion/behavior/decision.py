"""What an agent makes of a moment."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.activity import Activity, Cause
from agv_motion.motion.command.floor_rules import FloorRules

if TYPE_CHECKING:
    from agv_motion.motion.behavior.goals.goal import Goal
    from agv_motion.motion.navigation.polyline import Point

NO_RULES = FloorRules()


class Decision(NamedTuple):
    """What to do now, where to go and how; by which path, a navigator finds."""

    state: str
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
    activity: Activity = Activity.RESTING
    """the same as `state`, for programs"""
    because: Cause = Cause.GOAL
    """what that goes back to"""


def standing(state: str, goal: Goal | None, activity: Activity, because: Cause) -> Decision:
    """Return that the tree stands where it is, whoever comes."""
    return Decision(state, goal, activity=activity, because=because)


def resting(why: str, goal: Goal | None, because: Cause, yield_speed: float = 0.0) -> Decision:
    """Return that the tree rests where it is, and why; it may have to give way."""
    return Decision(f'resting: {why}', goal, yield_speed=yield_speed, because=because)


def stopped(why: str, goal: Goal | None) -> Decision:
    """Return that the tree stands where its zone does not let it go on, and why."""
    return Decision(f'stopped: {why}', goal, activity=Activity.STOPPED, because=Cause.ZONE)
