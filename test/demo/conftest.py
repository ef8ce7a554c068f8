"""What the pictures of the demos show: a tree that says all that a recorder hears of it."""

from __future__ import annotations

import io

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped, TwistStamped, Vector3Stamped
from nav_msgs.msg import Odometry
from rich.console import Console
from sensor_msgs.msg import JointState
from std_msgs.msg import String

from agv_motion.demo.map_view import Room
from agv_motion.motion.navigation.zone_file import load_zone
from agv_motion.ros.config import find_config

NOW = 1_434_366_000.0


class Heard:
    """What a recorder has heard."""

    def __init__(self):
        self.messages = {}

    def latest(self, topic):
        return self.messages.get(topic)

    def hear_tree(self, prefix='', x=7.25, speed=-1e-6):
        """Hear all topics of a tree that hardly rolls back."""
        odometry, goal, flow = Odometry(), PoseStamped(), Vector3Stamped()
        odometry.pose.pose.position.x, odometry.pose.pose.position.y = x, 5.5
        odometry.pose.pose.orientation.w = 1.0
        goal.pose.position.x, goal.pose.position.y = 10.0, 7.5
        flow.vector.x, flow.vector.y, flow.vector.z = 0.42, 1.0, -1e-4
        water = Vector3Stamped()
        water.vector.x, water.vector.y, water.vector.z = 3.214, 1.0, 10.3
        twist = TwistStamped()
        twist.twist.linear.x, twist.twist.angular.z = -speed, speed
        names = [f'turret_{i}_{part}' for part in ('steering', 'wheel') for i in range(3)]
        joints = JointState(name=names, position=[0.0] * 6, velocity=[speed] * 6)
        state = String(data='walking to (10.00, 7.50): 3.3 m to go, the sap flow is low there')
        self.messages |= {
            f'{prefix}ground_truth': odometry, f'{prefix}goal': goal, f'{prefix}state': state,
            f'{prefix}granier/sap_flow': flow, f'{prefix}cmd_vel': twist, 'odom': odometry,
            f'{prefix}turrets/state': joints, f'{prefix}granier/water_use_today': water,
        }  # fmt: skip


@pytest.fixture
def shown():
    """Return what gives the lines of a picture on a terminal of a size."""
    return _shown


def _shown(view, factor, columns, rows):
    """Return the lines of a picture on a terminal of a size."""
    console = Console(width=columns, height=rows, file=io.StringIO(), force_terminal=False)
    console.print(view.draw(NOW, factor, Room(columns, rows - 2)))
    return console.file.getvalue().splitlines()


@pytest.fixture
def heard():
    return Heard()


@pytest.fixture
def zone():
    return load_zone(find_config('zone_outdoor.yaml'), 1.3)
