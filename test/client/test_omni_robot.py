"""A script and an omni robot with its simulator, all nodes of its launch file live."""

from __future__ import annotations

from math import dist

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry

from agv_motion.client import Robot
from agv_motion.client.link import ScriptLink
from agv_motion.client.task import Outcome
from agv_motion.errors import AgvMotionError
from agv_motion.ros.qos import COMMAND, SENSOR

LIMIT = 100.0


@pytest.fixture(scope='module')
def heard(slim):
    """Return what drives the robot, and where it really is, newest last."""
    with slim('omni', 4.0):
        link, found = ScriptLink(''), {'page': [], 'truth': []}
        for topic, kind, qos, inbox in (
            ('cmd_vel/page', TwistStamped, COMMAND, 'page'),
            ('ground_truth', Odometry, SENSOR, 'truth'),
        ):
            link.hear(kind, topic, qos, lambda one, inbox=inbox: found[inbox].append(one.message))
        link.start(lambda _: None)
        found['link'] = link
        assert link.wait(lambda: found['truth'], LIMIT)
        yield found
        link.close()


@pytest.fixture(scope='module')
def robot(heard):
    with Robot(patience=LIMIT, silent_after=LIMIT) as found:
        yield found


def test_it_goes_where_it_is_sent_once_it_knows_where_it_is(robot, heard):
    """It slides: the law for a base that can go sideways asks for a speed across."""
    with pytest.raises(AgvMotionError, match='tell its localization'):
        robot.go_to(2.6, 2.0)
    robot.set_pose(2.0, 2.0, 0.5)  # where config/omni.yaml lets it start
    for _ in range(4):  # on a machine that lags it may end beside the goal, and says so
        robot.go_to(2.6, 2.2, 0.2)
        if robot.wait(LIMIT).outcome is Outcome.SUCCEEDED:
            break
    assert robot.result() == (Outcome.SUCCEEDED, 'arrived')
    place = heard['truth'][-1].pose.pose.position
    assert dist((place.x, place.y), (2.6, 2.2)) < 0.3
    assert any(abs(one.twist.linear.y) > 0.005 for one in heard['page'])
    assert robot.pose('map') is not None
    assert robot.pose('moon') is None


def test_it_tells_how_far_it_is_and_stands_when_it_is_cancelled(robot, heard):
    robot.go_to(50.0, 2.0)
    assert robot.feedback().distance_left > 40.0
    assert heard['link'].wait(lambda: robot.feedback().state == 'driving', LIMIT)
    assert robot.cancel(LIMIT).outcome is Outcome.CANCELLED
    assert heard['link'].wait(lambda: not any(twist(heard['page'][-1])), LIMIT)


def twist(message):
    return message.twist.linear.x, message.twist.linear.y, message.twist.angular.z
