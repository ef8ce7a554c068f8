"""What nodes say to fixed wheels, and to those who want to know it."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING

from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray

from agv_motion.planar import REST, Twist, without_minus_zero
from agv_motion.ros.messages import stamp_of
from agv_motion.ros.qos import COMMAND
from agv_motion.ros.twist_rows import TwistRows

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.ros.port import Port
    from agv_motion.ros.wheel_joints import WheelJoints


class WheelCommands:
    """Publishes `wheels/command`, `wheels/velocity_commands` and `cmd_vel/limited`."""

    def __init__(self, port: Port, joints: WheelJoints, frame: str) -> None:
        """Open the topics.

        Args:
            port: Of the node.
            joints: Names of the wheels.
            frame: Of the base.

        """
        self.joints = joints
        self.twist = REST
        """what was commanded last"""
        self._frame = frame
        self._rates_wanted = False
        self._command = port.publisher(JointState, 'wheels/command', COMMAND, sole=True)
        self._rates = port.publisher(Float64MultiArray, 'wheels/velocity_commands', COMMAND)
        self._limited = port.row_publisher(TwistRows(frame), 'cmd_vel/limited', COMMAND)

    def send(self, twist: Twist, rates: Sequence[float], instant: int) -> None:
        """Command the wheels for an instant; tell the others only where someone listens.

        Args:
            twist: Of the base.
            rates: (n,) of the wheels for it [rad/s].
            instant: [ns]

        """
        self.twist = twist = without_minus_zero(twist)
        rates = [rate + 0.0 for rate in rates]  # no minus before a zero
        message = self.joints.message(rates)
        message.header.stamp = stamp_of(instant)
        message.header.frame_id = self._frame
        self._command.publish(message)
        if self._limited.get_subscription_count():
            self._limited.publish(twist, instant)
        if self._rates_wanted:
            self._rates.publish(Float64MultiArray(data=array('d', rates)))

    def look_for_listeners(self) -> None:
        """Find out whether someone wants the plain rates."""
        self._rates_wanted = bool(self._rates.get_subscription_count())
