"""Who drives the omni robot of the demo: from goal to goal, by the pose that localization tells."""

from __future__ import annotations

from math import cos, hypot, sin

import numpy as np
from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.lifecycle import LifecycleNode

from agv_motion.planar import Pose, Twist
from agv_motion.ros.messages import fill_twist, pose_of
from agv_motion.ros.qos import COMMAND, SENSOR

ROOM = 8.0, 6.0
"""[m] In which the driver chooses its goals."""
SPEED = 0.4
"""[m/s]"""
SEARCHING = Twist(0.3, 0.0, 0.3)
"""The circle it drives until it knows where it is."""


class OmniDriver(LifecycleNode):
    """Steers by the pose that localization tells, from goal to goal, turning as it likes."""

    def __init__(self, seed: int) -> None:
        """Start without a pose."""
        super().__init__('demo_driver')
        self._random = np.random.default_rng(seed)
        self._pose: Pose | None = None
        self._silent = 0
        self._choose()
        self._command = self.create_publisher(
            TwistStamped, 'cmd_vel/agent', COMMAND,
            event_callbacks=PublisherEventCallbacks(use_default_callbacks=False),
        )  # fmt: skip
        for kind, topic, act in (
            (PoseWithCovarianceStamped, 'pose', self._on_pose),
            (Odometry, 'odom', self._on_odometry),
        ):
            self.create_subscription(
                kind, topic, act, SENSOR,
                event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
            )  # fmt: skip

    def _choose(self) -> None:
        self._goal = self._random.uniform((1.0, 1.0), (ROOM[0] - 1.0, ROOM[1] - 1.0))
        self._turning = float(self._random.uniform(-0.5, 0.5))

    def _on_pose(self, message: PoseWithCovarianceStamped) -> None:
        self._pose, self._silent = pose_of(message.pose.pose), 0

    def _on_odometry(self, message: Odometry) -> None:
        """Drive on, once for each step of the wheels."""
        self._silent += 1
        known = self._pose is not None and self._silent < 20
        command = TwistStamped()
        command.header.stamp, command.header.frame_id = message.header.stamp, 'base_link'
        fill_twist(command.twist, self._towards_goal(self._pose) if known else SEARCHING)
        self._command.publish(command)

    def _towards_goal(self, pose: Pose | None) -> Twist:
        assert pose is not None
        x, y = self._goal[0] - pose.x, self._goal[1] - pose.y
        distance = hypot(x, y)
        if distance < 0.3:
            self._choose()
        c, s = cos(pose.theta), sin(pose.theta)
        share = SPEED / max(distance, SPEED)
        return Twist(share * (c * x + s * y), share * (c * y - s * x), self._turning)
