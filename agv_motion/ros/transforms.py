"""/tf, where tf2_msgs is installed: PyPI has no wheel of it, a ROS installation does.

Where it is not, recorders make /tf of what robots say: `model.graph_transforms`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import TransformStamped
from rclpy.qos import QoSProfile

from agv_motion.model.transform_message import TF, TF_STATIC
from agv_motion.ros.messages import fill_rotation, stamp_of
from agv_motion.ros.qos import LATCHED

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.model.transform import Transform
    from agv_motion.planar import Pose
    from agv_motion.ros.port import Port

try:
    from tf2_msgs.msg import TFMessage
except ImportError:
    TFMessage = None

DEEP = QoSProfile(depth=100)


class Transforms:
    """Publishes transforms on /tf for as long as the node is configured."""

    def __init__(self, port: Port, *, static: bool = False, complains: bool = True) -> None:
        """Open /tf, and /tf_static where transforms hold for good; or say once why there is none.

        Args:
            port: Of the node.
            static: Whether the node tells some that hold for good.
            complains: Whether this node is the one of its robot who says why there is none.

        """
        self.available = TFMessage is not None
        if self.available:
            self._publisher = port.publisher(TFMessage, TF, DEEP)
            self._static = port.publisher(TFMessage, TF_STATIC, LATCHED) if static else None
        elif complains:
            port.info('tf2_msgs is not installed: nothing goes to /tf; recorders write it all the '
                      'same')  # fmt: skip

    def publish(self, stamp: Any, *transforms: tuple[str, str, Pose]) -> None:
        """Publish transforms, each (frame, child frame, pose of the child in the frame)."""
        if self.available:
            self._publisher.publish(
                TFMessage(transforms=[_planar(stamp, *transform) for transform in transforms])
            )

    def tell(self, transforms: Sequence[Transform]) -> None:
        """Publish transforms, if there are any."""
        if self.available and transforms:
            self._publisher.publish(TFMessage(transforms=list(map(_message, transforms))))

    def tell_static(self, transforms: Sequence[Transform]) -> None:
        """Publish transforms that hold for good."""
        if self.available and self._static is not None:
            self._static.publish(TFMessage(transforms=list(map(_message, transforms))))


def _planar(stamp: Any, frame: str, child: str, pose: Pose) -> TransformStamped:
    message = TransformStamped(child_frame_id=child)
    message.header.stamp, message.header.frame_id = stamp, frame
    transform = message.transform
    transform.translation.x, transform.translation.y, _ = pose
    fill_rotation(transform.rotation, pose.theta)
    return message


def _message(told: Transform) -> TransformStamped:
    message = TransformStamped(child_frame_id=told.child)
    message.header.stamp, message.header.frame_id = stamp_of(told.stamp), told.parent
    place, rotation = message.transform.translation, message.transform.rotation
    place.x, place.y, place.z = told.translation
    rotation.x, rotation.y, rotation.z, rotation.w = told.rotation
    return message
