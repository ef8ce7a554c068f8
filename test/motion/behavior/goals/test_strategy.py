"""Every strategy keeps the protocol that the agent knows."""

from __future__ import annotations

import pytest

from agv_motion.motion.behavior.goals.goal import Goal
from agv_motion.motion.behavior.goals.strategies import STRATEGIES
from agv_motion.motion.behavior.goals.strategy import GoalSetting
from agv_motion.motion.behavior.memory import Memory
from agv_motion.motion.navigation.open_floor import OpenFloor
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.zone import Zone

ZONE = Zone([[0, 0], [10, 0], [10, 10], [0, 10]])
SETTING = GoalSetting(
    (2.0, 2.0), 1, 9, OpenFloor(PathPlanner(ZONE)), lambda _objective: 1.0
)  # fmt: skip


@pytest.mark.parametrize('name', STRATEGIES)
def test_each_gives_a_goal_that_can_be_walked_to_or_none(name):
    strategy = STRATEGIES[name].build(SETTING)
    chosen = [strategy.next_goal(Memory(ZONE), (8.0, 8.0), 1e9) for _ in range(5)]
    for goal in (strategy.first, *chosen):
        assert goal is None or (isinstance(goal, Goal) and ZONE.walkable(*goal.place))
    assert isinstance(strategy.lasting, bool)
    assert strategy.refusals == []


@pytest.mark.parametrize('name', STRATEGIES)
def test_each_that_needs_no_zone_says_its_first_goal(name):
    kind = STRATEGIES[name]
    assert kind.remembers or kind.build(SETTING._replace(floor=None)).first, (
        f"strategy '{name}' needs no zone: give it a `first` goal, or let its row say `remembers`"
    )
