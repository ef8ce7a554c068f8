"""Where a robot is, how old that is, and why nobody knows."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.nodes.driving_parameters import DrivingParameters
from agv_motion.nodes.pose_input import PoseInput
from agv_motion.planar import REST, Twist
from agv_motion.ros.messages import stamp_of

AHEAD = Twist(1.0, 0.0, 0.0)


class Port:
    """A port whose clocks the test sets."""

    def __init__(self):
        self.now, self.steady = 100.0, 5.0
        self.clock = SimpleNamespace(fault='', speed=1.0)
        self.heard = {}
        self.info = self.warning = self.error = lambda text, **_: None

    def seconds(self):
        return self.now

    def nanoseconds(self):
        return round(self.now * 1e9)

    def steady_seconds(self):
        return self.steady

    def watch_over(self, watchdog):
        pass

    def need(self, *topics):
        pass

    def listen(self, kind, topic, callback, _qos, *, sole):
        self.heard[topic] = kind, callback
        assert sole

    def tell(self, x, frame='odom', topic='odom'):
        kind, callback = self.heard[topic]
        message = kind()
        message.header.frame_id = frame
        message.header.stamp = stamp_of(self.nanoseconds())
        message.pose.pose.position.x = x
        message.pose.pose.orientation.w = 1.0
        callback(message)

    def wait(self, seconds):
        self.now += seconds
        self.steady += seconds


@pytest.fixture
def port():
    return Port()


def test_the_pose_is_carried_on_by_the_twist_commanded_since_unless_it_is_old(port):
    poses = PoseInput(port, DrivingParameters())
    assert poses.now(AHEAD) is None
    port.tell(2.0)
    port.wait(0.2)
    assert poses.measured.x == 2.0
    assert poses.now(AHEAD).x == pytest.approx(2.2)
    assert poses.require(REST).x == 2.0
    port.wait(0.2)
    assert poses.now(AHEAD).x == 2.0


def test_one_that_is_lost_stops_once_and_where_the_clock_stands_again_and_again(port):
    given = DrivingParameters(report_after=0.2, stop_after=0.5)
    poses = PoseInput(port, given)
    assert poses.lost == 'no odom yet'
    port.tell(2.0)
    assert not poses.look()
    port.wait(1.0)
    assert [poses.look(), poses.look()] == [True, False]
    assert poses.lost == 'no odom for 0.5 s'
    assert poses.measured is None
    with pytest.raises(SignalError, match='where the robot is must be known'):
        poses.require(REST)
    port.clock.fault = 'the clock stands still'
    assert [poses.look(), poses.look()] == [True, True]
    port.clock.fault = ''
    port.tell(3.0)
    assert (poses.lost, poses.measured.x) == ('', 3.0)


def test_after_a_new_beginning_the_pose_must_be_told_anew(port):
    poses = PoseInput(port, DrivingParameters())
    port.tell(2.0)
    poses.begin()
    assert (poses.measured, poses.lost) == (None, 'no odom yet')


def test_a_pose_in_another_frame_is_refused_and_the_topic_is_the_one_asked_for(port):
    poses = PoseInput(port, DrivingParameters(position='pose', frame='map'))
    assert port.heard['pose'][0] is PoseWithCovarianceStamped
    with pytest.raises(ConfigurationError, match="frame 'odom': this node drives in 'map'"):
        port.tell(1.0, 'odom', 'pose')
    port.tell(1.0, 'map', 'pose')
    assert poses.measured.x == 1.0
    other = Port()
    PoseInput(other, DrivingParameters())
    assert other.heard['odom'][0] is Odometry
