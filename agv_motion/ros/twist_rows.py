"""Twists of the body as rows, and `cmd_vel`, which may have a stamp or not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from geometry_msgs.msg import Twist as TwistMessage
from geometry_msgs.msg import TwistStamped

from agv_motion.planar import without_minus_zero
from agv_motion.ros.messages import fill_twist, twist_of
from agv_motion.ros.qos import COMMAND

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from agv_motion.planar import Twist
    from agv_motion.ros.port import Port

PLANAR = 'linear.x', 'linear.y', 'angular.z'
"""The planar part of a geometry_msgs/Twist."""


class TwistRows:
    """Twists as geometry_msgs/TwistStamped."""

    def __init__(self, frame: str) -> None:
        """Tell them in ``frame``."""
        self._frame = frame

    def message(self) -> TwistStamped:
        """Return a message of no motion."""
        message = TwistStamped()
        message.header.frame_id = self._frame
        return message

    def fill(self, message: Any, row: Twist) -> None:
        """Write a twist into a message."""
        fill_twist(message.twist, row)

    def fill_table(self, table: NDArray[Any], rows: Sequence[Twist]) -> None:
        """Write many twists into the columns of a table."""
        for axis, column in zip(PLANAR, np.array(rows).reshape(-1, 3).T, strict=True):
            table[f'twist.{axis}'] = column

    def read(self, message: Any) -> Twist:
        """Return the twist of a message; raise a `SignalError` where it is not finite."""
        return twist_of(message.twist)


def twist_publisher(port: Port, frame: str, *, stamped: bool) -> Callable[[Twist], float]:
    """Open `cmd_vel`, and return what commands a twist and returns the instant of it [s].

    The instant is that of the stamp: who limits rates counts from it, so that they hold by stamps
    whatever else the machine does in between.

    Args:
        port: Of the node that commands.
        frame: Of the twist, where the message has a header.
        stamped: Whether to send TwistStamped, else Twist.

    """
    if not stamped:
        return _plain_publisher(port)
    publish, now = (
        port.row_publisher(TwistRows(frame), 'cmd_vel', COMMAND).publish,
        port.nanoseconds,
    )

    def command(twist: Twist) -> float:
        instant = now()
        publish(without_minus_zero(twist), instant)
        return instant * 1e-9

    return command


def _plain_publisher(port: Port) -> Callable[[Twist], float]:
    message, topic = TwistMessage(), port.publisher(TwistMessage, 'cmd_vel', COMMAND)

    def command(twist: Twist) -> float:
        fill_twist(message, without_minus_zero(twist))
        instant = port.seconds()
        topic.publish(message)
        return instant

    return command
