"""An ideal robot on the graph of a test: each command moves it by one step, and it says where."""

from __future__ import annotations

from math import cos, sin

from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry

from agv_motion.planar import Pose, Twist, integrate
from agv_motion.ros.qos import SENSOR


class DrivenRobot:
    """`cmd_vel` in, `odom` out; as fast as the node under test commands."""

    def __init__(self, tester, pose=(0.0, 0.0, 0.0), step=0.1):
        """Listen before the node speaks; `find` it when it is there."""
        self.tester = tester
        self.pose = Pose(*pose)
        self.commands = []
        self.silent = False
        self._step = step
        tester.node.create_subscription(TwistStamped, 'cmd_vel', self._on_command, 50)

    def find(self):
        """Wait until the node listens, and say where the robot is."""
        self.odometry = self.tester.publisher(Odometry, 'odom', SENSOR)
        self.report()

    def report(self, frame='odom'):
        message = Odometry()
        message.header.frame_id = frame
        message.pose.pose.position.x, message.pose.pose.position.y = self.pose.x, self.pose.y
        message.pose.pose.orientation.z = sin(self.pose.theta / 2.0)
        message.pose.pose.orientation.w = cos(self.pose.theta / 2.0)
        self.odometry.publish(message)

    def moves(self):
        """Return the next command that is not zero."""
        self.commands.clear()
        return self.tester.wait(self.commands, any)

    def stands(self, timeout=20.0):
        """Return once an explicit zero has come."""
        self.commands.clear()
        self.tester.wait(self.commands, lambda command: not any(command), timeout)

    def _on_command(self, message):
        twist = Twist(message.twist.linear.x, message.twist.linear.y, message.twist.angular.z)
        self.commands.append(twist)
        self.pose = integrate(self.pose, twist, self._step)
        if not self.silent:
            self.report()
