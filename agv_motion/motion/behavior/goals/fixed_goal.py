"""The strategy `fixed`: one goal that is given, and kept."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.motion.behavior.goals.goal import Goal

if TYPE_CHECKING:
    from agv_motion.motion.behavior.goals.strategy import GoalSetting
    from agv_motion.motion.behavior.memory import Memory
    from agv_motion.motion.navigation.polyline import Point


class FixedGoal:
    """Goes to one goal, and turns there."""

    lasting = True

    def __init__(self, setting: GoalSetting) -> None:
        """Take the goal that is given."""
        self.refusals: list[str] = []
        self.first: Goal | None = None
        if setting.goal is not None:
            x, y = setting.goal
            self.first = Goal(x, y, f'({x:.1f}, {y:.1f}), the first one')

    def next_goal(self, memory: Memory | None, here: Point, now: float) -> Goal | None:  # noqa: ARG002 - whatever is known
        """Return the goal that was given; see :meth:`GoalStrategy.next_goal`."""
        return self.first
