"""Where a tree goes next: the strategies, one a file, and the table of their names."""

from agv_motion.motion.behavior.goals.strategies import GoalParameters

__all__ = [
    'GoalParameters',
]
