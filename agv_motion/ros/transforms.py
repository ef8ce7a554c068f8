"""/tf, where tf2_msgs is installed: PyPI has no wheel of it, a ROS installation does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import TransformStamped
from rclpy.qos import QoSProfile

from agv_motion.ros.messages import fill_rotation

if TYPE_CHECKING:
    from agv_motion.planar import Pose
    from agv_motion.ros.port import Port

try:
    from tf2_msgs.msg import TFMessage
except ImportError:
    TFMessage = None

TF = QoSProfile(depth=100)


class Transforms:
    """Publishes transforms on /tf for as long as the node is configured."""

    def __init__(self, port: Port) -> None:
        """Open /tf, or say once why there is none."""
        self.available = TFMessage is not None
        if self.available:
            self._publisher = port.publisher(TFMessage, '/tf', TF)
        else:
            port.info('tf2_msgs is not installed: nothing goes to /tf')

    def publish(self, stamp: Any, *transforms: tuple[str, str, Pose]) -> None:
        """Publish transforms, each (frame, child frame, pose of the child in the frame)."""
        if self.available:
            self._publisher.publish(
                TFMessage(transforms=[_message(stamp, *transform) for transform in transforms])
            )


def _message(stamp: Any, frame: str, child: str, pose: Pose) -> TransformStamped:
    message = TransformStamped(child_frame_id=child)
    message.header.stamp, message.header.frame_id = stamp, frame
    transform = message.transform
    transform.translation.x, transform.translation.y, _ = pose
    fill_rotation(transform.rotation, pose.theta)
    return message
