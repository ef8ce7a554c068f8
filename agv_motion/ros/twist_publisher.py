"""`cmd_vel`, with a stamp or without, in one message that is filled again and again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import Twist as TwistMessage
from geometry_msgs.msg import TwistStamped

from agv_motion.ros.messages import fill_twist
from agv_motion.ros.qos import COMMAND

if TYPE_CHECKING:
    from agv_motion.planar import Twist
    from agv_motion.ros.node import ManagedNode


class TwistPublisher:
    """The commands of one node."""

    def __init__(self, node: ManagedNode[Any], frame: str, *, stamped: bool) -> None:
        """Open the topic.

        Args:
            node: That commands.
            frame: Of the twist, where the message has a header.
            stamped: Whether to send TwistStamped, else Twist.

        """
        self._node, self.stamped = node, stamped
        self.message: Any = TwistStamped() if stamped else TwistMessage()
        if stamped:
            self.message.header.frame_id = frame
        self.topic = node.publisher(type(self.message), 'cmd_vel', COMMAND)

    def publish(self, twist: Twist) -> None:
        """Command ``twist`` from now on."""
        message = self.message
        if self.stamped:
            self._node.stamp(message)
            fill_twist(message.twist, twist)
        else:
            fill_twist(message, twist)
        self.topic.publish(message)
