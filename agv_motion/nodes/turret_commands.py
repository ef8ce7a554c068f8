"""What `wheel_kinematics` says to the turrets, and to those who want to know it."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING

from std_msgs.msg import Float64MultiArray, String

from agv_motion.kinematics.steering.state import Limiter
from agv_motion.planar import REST, Twist, without_minus_zero
from agv_motion.ros.messages import stamp_of
from agv_motion.ros.qos import COMMAND, LATCHED
from agv_motion.ros.turret_rows import TurretRows
from agv_motion.ros.twist_rows import TwistRows

if TYPE_CHECKING:
    from agv_motion.kinematics.steering.controller import SteeringController
    from agv_motion.nodes.steering_parameters import WheelKinematicsParameters
    from agv_motion.ros.messages import TurretJoints
    from agv_motion.ros.port import Port


class PlainArrays:
    """The same as two arrays of numbers, where someone listens."""

    def __init__(self, port: Port) -> None:
        """Open the topics."""
        self._angles = port.publisher(Float64MultiArray, 'turrets/steering_commands', COMMAND)
        self._rates = port.publisher(Float64MultiArray, 'turrets/wheel_commands', COMMAND)
        self._wanted = False

    def look_for_listeners(self) -> None:
        """Find out whether someone listens."""
        listeners = self._angles.get_subscription_count() + self._rates.get_subscription_count()
        self._wanted = listeners > 0

    def send(self, angles: list[float], rates: list[float]) -> None:
        """Tell (n,) steering angles [rad] and wheel rates [rad/s]."""
        if self._wanted:
            self._angles.publish(Float64MultiArray(data=array('d', angles)))
            self._rates.publish(Float64MultiArray(data=array('d', rates)))


class LimiterReport:
    """What limits the motion, told where that changes."""

    def __init__(self, port: Port) -> None:
        """Open the topic."""
        self.limiter = Limiter.NONE
        self._publisher = port.publisher(String, 'turrets/limiter', LATCHED)

    def update(self, limiter: Limiter) -> None:
        """Take what limits the motion now."""
        if limiter is not self.limiter:
            self.limiter = limiter
            self._publisher.publish(String(data=limiter.value))


class TurretCommands:
    """Publishes `turrets/command`, the plain arrays, and `cmd_vel/limited`."""

    def __init__(self, port: Port, given: WheelKinematicsParameters, joints: TurretJoints) -> None:
        """Open the topics.

        Args:
            port: Of the node.
            given: Its parameters.
            joints: Names of the turrets.

        """
        self._joints, self._given, self._zero = joints, given, given.zeros()
        rows = TurretRows(joints, len(self._zero), given.base_frame)
        self._command = port.row_publisher(rows, 'turrets/command', COMMAND, sole=True)
        self._limited = port.row_publisher(TwistRows(given.base_frame), 'cmd_vel/limited', COMMAND)
        self.arrays = PlainArrays(port)

    def send(self, driving: SteeringController, instant: int) -> None:
        """Command what is planned for an ``instant`` [ns].

        Turrets that nobody has set or seen yet are left alone, their wheels stopped.
        """
        setpoints = driving.setpoints
        if setpoints is None:
            message = self._joints.standstill()
            message.header.frame_id = self._given.base_frame
            message.header.stamp = stamp_of(instant)
            self._command.publish_message(message)
            if self._limited.get_subscription_count():
                self._limited.publish(REST, instant)
            return
        share = driving.share()
        factor = share / self._given.wheel_radius
        # + 0.0: no minus before a zero
        rates = [factor * speed + 0.0 for speed in setpoints.speeds]
        angles = [
            angle - zero + 0.0 for angle, zero in zip(setpoints.angles, self._zero, strict=True)
        ]
        self._command.publish((angles, rates), instant)
        if self._limited.get_subscription_count():
            vx, vy, wz = setpoints.twist(driving.planner.turrets)
            limited = without_minus_zero(Twist(share * vx, share * vy, share * wz))
            self._limited.publish(limited, instant)
        self.arrays.send(angles, rates)
