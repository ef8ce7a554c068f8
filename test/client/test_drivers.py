"""Every end that a node tells ends an order."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from agv_motion.client.drivers import GHOST, SEQUENCE
from agv_motion.client.task import Outcome
from agv_motion.sequence.runner import ENDS, SequenceState
from agv_motion.trajectory.follower_state import AT_REST, FollowerState


def test_each_end_of_a_ghost_is_known_and_nothing_else():
    words = {state.value for state in FollowerState}
    assert words & set(GHOST.ends) == {s.value for s in AT_REST - {FollowerState.IDLE}}


def test_each_end_of_a_sequence_is_known_and_nothing_else():
    words = {state.value for state in SequenceState}
    assert words & set(SEQUENCE.ends) == {state.value for state in ENDS}
    assert SEQUENCE.ends[SequenceState.DONE.value] is Outcome.SUCCEEDED
