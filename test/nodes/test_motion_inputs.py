"""What a tree hears: the last of each input, and what it wants for."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped, Vector3Stamped

from agv_motion.activity import Activity, Cause
from agv_motion.errors import AgvMotionError
from agv_motion.nodes.motion_inputs import FLOW, MotionInputs
from agv_motion.nodes.motion_parameters import MotionGeneratorParameters
from agv_motion.ros.messages import stamp_of


class Port:
    """A port whose clocks the test sets."""

    def __init__(self):
        self.now, self.clock = 100.0, SimpleNamespace(fault='', speed=1.0)
        self.info = self.warning = self.error = lambda text, **_: None

    def nanoseconds(self):
        return round(self.now * 1e9)

    def steady_seconds(self):
        return self.now

    def watch_over(self, watchdog):
        pass


@pytest.fixture
def port():
    return Port()


@pytest.fixture
def inputs(port):
    return MotionInputs(port, MotionGeneratorParameters())


def flow(port, s1=0.5):
    message = Vector3Stamped()
    message.header.stamp, message.header.frame_id = stamp_of(port.nanoseconds()), 'base_link'
    message.vector.x, message.vector.y, message.vector.z = s1, 0.5, 0.5
    return message


def pose(port, x=1.0):
    message = PoseWithCovarianceStamped()
    message.header.stamp, message.header.frame_id = stamp_of(port.nanoseconds()), 'map'
    message.pose.pose.position.x, message.pose.pose.orientation.w = x, 1.0
    return message


def test_a_tree_wants_for_both_and_for_probes_that_can_be_believed(port, inputs):
    inputs.begin()
    assert inputs.obstacle()[:3] == ('resting: no sap flow', Activity.STARTING, Cause.SAP_FLOW)
    assert inputs.take_pose(pose(port))
    assert inputs.take_flow(flow(port))
    assert inputs.obstacle() is None
    assert (inputs.flow.s1, inputs.pose.x) == (0.5, 1.0)
    inputs.valid = False
    assert inputs.obstacle().because is Cause.PROBES


def test_a_repeat_is_no_news_and_what_is_none_changes_nothing(port, inputs):
    assert inputs.take_pose(pose(port))
    assert not inputs.take_pose(pose(port, 9.0))
    assert inputs.take_flow(flow(port))
    port.now += 1.0
    with pytest.raises(AgvMotionError, match='three numbers in'):
        inputs.take_flow(flow(port, 2.0))
    assert (inputs.pose.x, inputs.flow.s1) == (1.0, 0.5)


def test_a_pose_that_is_lost_is_none_now_and_a_new_beginning_knows_nothing(port, inputs):
    inputs.take_pose(pose(port))
    assert inputs.pose_now.x == 1.0
    port.now += 1000.0
    assert inputs.pose_now is None
    assert inputs.pose.x == 1.0
    inputs.begin()
    assert (inputs.pose, inputs.flow, inputs.watches.lost) == (None, None, FLOW)


def test_a_fault_of_the_clock_is_told_before_what_is_missing(port, inputs):
    inputs.begin()
    port.clock.fault = 'the clock stands still'
    assert inputs.obstacle()[:3] == (
        'resting: the clock stands still', Activity.STOPPED, Cause.CLOCK,
    )  # fmt: skip
