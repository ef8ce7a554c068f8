"""Where a tree goes next: the strategies, one a file, and the table of their names."""

from agv_motion.motion.behavior.goals.goal import Goal, Objective
from agv_motion.motion.behavior.goals.strategies import STRATEGIES, GoalParameters
from agv_motion.motion.behavior.goals.strategy import GoalSetting, GoalStrategy

__all__ = ['STRATEGIES', 'Goal', 'GoalParameters', 'GoalSetting', 'GoalStrategy', 'Objective']
