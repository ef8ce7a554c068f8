"""One goal that is given, and kept."""

from __future__ import annotations

from agv_motion.motion.behavior.goals.fixed_goal import FixedGoal
from agv_motion.motion.behavior.goals.strategy import GoalSetting


def fixed(goal):
    return FixedGoal(GoalSetting(goal, 1, 9, None, lambda _objective: 1.0))


def test_the_goal_is_known_before_anything_is_and_stays():
    strategy = fixed((10.0, 7.5))
    assert strategy.first.reason == '(10.0, 7.5), the first one'
    assert strategy.next_goal(None, (0.0, 0.0), 0.0) is strategy.first
    assert strategy.lasting


def test_none_is_given():
    strategy = fixed(None)
    assert strategy.first is None
    assert strategy.next_goal(None, (0.0, 0.0), 0.0) is None
