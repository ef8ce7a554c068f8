"""Where a tree goes next: the strategies, one a file, and the table of their names."""

from agv_motion.motion.behavior.goals.goal import Goal
from agv_motion.motion.behavior.goals.strategies import GoalParameters
from agv_motion.motion.behavior.goals.strategy import GoalStrategy

__all__ = [
    'Goal',
    'GoalParameters',
    'GoalStrategy',
]
