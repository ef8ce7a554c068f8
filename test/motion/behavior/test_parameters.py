"""All that shapes an agent, in one."""

from __future__ import annotations

from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.motion.behavior.parameters import AgentParameters
from agv_motion.motion.command.polar import LINEAR_SPEED


def test_a_tree_of_which_nothing_is_told_is_that_of_the_original_installation():
    given = AgentParameters()
    assert (given.goal, given.goals.strategy) == (None, 'fixed')
    assert (given.linear_speed, given.platform_radius) == (LINEAR_SPEED, PLATFORM_RADIUS)
