"""A node knows whether the robot does what it says, or what somebody else says."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from agv_motion.blocked import BlockedParameters
from agv_motion.nodes.blocked_report import BlockedReport
from agv_motion.nodes.obedience import Obedience
from agv_motion.planar import Pose, Twist

HERE, FAST = Pose(0.0, 0.0, 0.0), Twist(1.0, 0.0, 0.0)


class PortOfOne:
    """What a node has of the world, as far as the driver goes; time goes on by hand."""

    def __init__(self, cmd_vel):
        self.cmd_vel, self.now, self.callbacks = cmd_vel, 0.0, {}
        self.errors = []
        self.error, self.info = self.errors.append, lambda _: None

    def full_name(self, topic):
        assert topic == 'cmd_vel'
        return self.cmd_vel

    def listen(self, kind, topic, callback, qos):
        assert kind is DiagnosticStatus
        self.callbacks[topic] = callback

    def seconds(self):
        return self.now

    steady_seconds = seconds

    def tell(self, driver):
        values = [KeyValue(key='driver', value=driver), KeyValue(key='stop', value='')]
        self.callbacks['driver'](DiagnosticStatus(values=values))


@pytest.mark.parametrize('other', ['stop', 'manual', 'page', 'none'])
def test_it_is_not_obeyed_while_another_drives_or_nobody(other):
    port = PortOfOne('/oak/cmd_vel/agent')
    obedience = Obedience(port)
    assert not obedience.held
    port.tell(other)
    assert obedience.held
    port.tell('agent')
    assert not obedience.held


def test_an_arbiter_that_has_fallen_silent_tells_nothing():
    port = PortOfOne('/oak/cmd_vel/agent')
    obedience = Obedience(port)
    port.tell('manual')
    port.now = 3.0
    assert obedience.held
    port.now = 3.01
    assert not obedience.held


def test_without_an_arbiter_nobody_is_asked():
    port = PortOfOne('/oak/cmd_vel')
    assert not Obedience(port).held
    assert port.callbacks == {}


def looked(port, report, given, driver):
    """Look a tenth of a second later, while that one drives."""
    port.now += 0.1
    port.tell(driver)
    return report.look(given, HERE, FAST)


def test_a_robot_that_a_person_has_stopped_is_not_blocked():
    port = PortOfOne('/cmd_vel/agent')
    given = BlockedParameters(after=1.0)
    report = BlockedReport(port, given, 0.2, 'clear its way', 1.0)
    assert not any(looked(port, report, given, 'stop') for _ in range(100))
    assert (report.reason, port.errors) == ('', [])
    assert any(looked(port, report, given, 'agent') for _ in range(20))
    assert report.reason.startswith('blocked: told to move by')
