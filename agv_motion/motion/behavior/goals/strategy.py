"""What a strategy of goals is: the one protocol that the agent knows, and what one is made of."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.motion.behavior.goals.goal import Goal, Objective
    from agv_motion.motion.behavior.memory import Memory
    from agv_motion.motion.navigation.open_floor import OpenFloor
    from agv_motion.motion.navigation.polyline import Point


class GoalStrategy(Protocol):
    """Chooses the goals of one tree."""

    first: Goal | None
    """known before anything is; None: the first is chosen like any other"""
    lasting: bool
    """whether a goal is kept once it is reached, or where no path leads to it"""
    refusals: list[str]
    """why goals before the one chosen last were not taken, in words"""

    def next_goal(self, memory: Memory | None, here: Point, now: float) -> Goal | None:
        """Return where to go next.

        Args:
            memory: What the tree remembers; None: it knows of no zone.
            here: Where it is in the map [m].
            now: Time [s since 1970].

        Returns:
            None where no goal can be reached, or none is known.

        """


class GoalSetting(NamedTuple):
    """What a strategy is made of; each takes what it needs."""

    goal: Point | None
    """where to go, for a strategy that is told its goal [m]"""
    seed: int
    """of the choice among equals"""
    attempts: int
    """goals without a path before there is none"""
    floor: OpenFloor | None
    """paths to goals; None: the tree knows of no zone"""
    arrival: Callable[[Objective], float]
    """how near each objective counts as fulfilled [m]"""
