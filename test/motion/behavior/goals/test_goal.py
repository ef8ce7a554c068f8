"""A goal is a place with a reason."""

from __future__ import annotations

from agv_motion.motion.behavior.goals.goal import Goal, Objective


def test_a_goal_from_outside_has_a_place_and_no_objective():
    goal = Goal(1.0, 2.0, 'asked for')
    assert (goal.place, goal.objective) == ((1.0, 2.0), None)


def test_the_objectives_come_in_their_order():
    assert [objective.name for objective in Objective] == ['SUN', 'SHADE', 'UNKNOWN']
