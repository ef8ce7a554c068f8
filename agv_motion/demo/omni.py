"""The graph of the omni demo: robot, wheels, localization, a driver and a recorder."""

from __future__ import annotations

from math import cos, hypot, sin
from typing import TYPE_CHECKING, Any

import numpy as np
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.lifecycle import LifecycleNode
from rclpy.signals import SignalHandlerOptions
from rich.progress import Progress
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64

from agv_motion.demo.configured import configured
from agv_motion.demo.recorder import DemoRecorder, RecordedTopic
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.nodes.omni_simulator import OmniSimulator
from agv_motion.planar import Pose, Twist
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.messages import fill_twist, pose_of
from agv_motion.ros.qos import COMMAND, SENSOR
from agv_motion.ros.run import spin, start
from agv_motion.ros.stop import Stop

if TYPE_CHECKING:
    from pathlib import Path

    from rich.console import Console


TOPICS = [
    RecordedTopic('cmd_vel', TwistStamped),
    RecordedTopic('wheels/command', JointState),
    RecordedTopic('wheels/state', JointState),
    RecordedTopic('wheels/free_speed', JointState),
    RecordedTopic('wheels/residual', Float64),
    RecordedTopic('imu', Imu),
    RecordedTopic('odom', Odometry),
    RecordedTopic('odom/filtered', Odometry),
    RecordedTopic('fix', PoseWithCovarianceStamped),
    RecordedTopic('pose', PoseWithCovarianceStamped),
    RecordedTopic('ground_truth', Odometry),
    RecordedTopic('/diagnostics', DiagnosticArray),
]
ROOM = 8.0, 6.0
"""[m] In which the driver chooses its goals."""
SPEED = 0.4
"""[m/s]"""
SEARCHING = Twist(0.3, 0.0, 0.3)
"""The circle it drives until it knows where it is."""
CARRIED = Pose(6.5, 5.0, -2.0)
"""Where the robot is set down when it is carried away."""


class Driver(LifecycleNode):
    """Steers by the pose that localization tells, from goal to goal, turning as it likes."""

    def __init__(self, seed: int) -> None:
        """Start without a pose."""
        super().__init__('demo_driver')
        self._random = np.random.default_rng(seed)
        self._pose: Pose | None = None
        self._silent = 0
        self._choose()
        self._command = self.create_publisher(
            TwistStamped, 'cmd_vel', COMMAND,
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


class OmniGraph:
    """Builds the graph and runs it."""

    def __init__(self, seed: int, time_factor: float, bag: Path) -> None:
        """Create and start all nodes with the values of ``config/omni.yaml``.

        Args:
            seed: Of the way and of all noise.
            time_factor: Simulated seconds per second.
            bag: Folder of the new bag.

        """
        rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
        self._stop = Stop()
        common: dict[str, Any] = {'use_sim_time': True}
        patient = common | {'report_after': 1.0, 'stop_after': 2.0}  # a busy machine runs late
        self.simulator = LiveNode(
            OmniSimulator,
            **configured('omni.yaml', 'omni_simulator', {'time_factor': time_factor, 'seed': seed}),
        )
        self._nodes: list[LiveNode[Any]] = [
            LiveNode(OmniKinematics, **configured('omni.yaml', 'omni_kinematics', patient)),
            LiveNode(Localization, **configured('omni.yaml', 'localization', common)),
            self.simulator,
        ]
        self._driver = Driver(seed)
        for node in self._nodes:
            start(node)
        self._recorder = DemoRecorder(bag, TOPICS, lambda: self.simulator.plain.time)

    def run(self, seconds: float, carry_after: float, console: Console) -> None:
        """Let simulated time pass, or until Ctrl-C.

        Args:
            seconds: How much [s].
            carry_after: When to carry the robot away [s]; beyond ``seconds``: never.
            console: For the progress bar.

        """
        carried = False
        with Progress(console=console, transient=True) as progress:
            task = progress.add_task('driving', total=seconds)

            def finished() -> bool:
                nonlocal carried
                elapsed = self.simulator.plain.elapsed
                progress.update(task, completed=elapsed)
                if not carried and elapsed >= carry_after:
                    carried = True
                    console.print(f'{elapsed:.0f} s: somebody carries the robot away')
                    self.simulator.plain.carry_to(CARRIED)
                ended = self._stop.requested or bool(self._recorder.failure)
                return ended or elapsed >= seconds

            spin([self._recorder, self._driver, *self._nodes], finished)
        self._recorder.close()
        rclpy.try_shutdown()
