"""Messages of a robot in CDR, as rosbags writes them."""

from __future__ import annotations

from math import cos, sin
from types import SimpleNamespace

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

STORE = get_typestore(Stores.ROS2_JAZZY)
TYPES = STORE.types
SECOND = 1_000_000_000


def cdr(message):
    return bytes(STORE.serialize_cdr(message, message.__msgtype__))


def _header(stamp, frame):
    time = TYPES['builtin_interfaces/msg/Time'](*divmod(round(stamp * SECOND), SECOND))
    return TYPES['std_msgs/msg/Header'](time, frame)


def _pose(x, y, heading):
    place = TYPES['geometry_msgs/msg/Point'](x, y, 0.0)
    turned = TYPES['geometry_msgs/msg/Quaternion'](0.0, 0.0, sin(heading / 2), cos(heading / 2))
    return TYPES['geometry_msgs/msg/Pose'](place, turned)


def _with_covariance(pose, variance):
    numbers = np.zeros(36)
    numbers[35] = variance
    return TYPES['geometry_msgs/msg/PoseWithCovariance'](_pose(*pose), numbers)


def odometry(stamp, pose, frame='odom', child='base_link'):
    zero = TYPES['geometry_msgs/msg/Vector3'](0.0, 0.0, 0.0)
    twist = TYPES['geometry_msgs/msg/TwistWithCovariance'](
        TYPES['geometry_msgs/msg/Twist'](zero, zero), np.zeros(36)
    )
    return cdr(TYPES['nav_msgs/msg/Odometry'](
        _header(stamp, frame), child, _with_covariance(pose, 0.0), twist
    ))  # fmt: skip


def pose(stamp, where, frame='map', variance=0.01):
    kind = TYPES['geometry_msgs/msg/PoseWithCovarianceStamped']
    return cdr(kind(_header(stamp, frame), _with_covariance(where, variance)))


def joints(stamp, positions, frame='base_link'):
    return cdr(TYPES['sensor_msgs/msg/JointState'](
        _header(stamp, frame), list(positions), np.array(list(positions.values())),
        np.array([]), np.array([]),
    ))  # fmt: skip


def text(content):
    return cdr(TYPES['std_msgs/msg/String'](content))


def transforms(data):
    """Return (parent, child, stamp [s], place, rotation) of each transform of a message."""
    found = STORE.deserialize_cdr(data, 'tf2_msgs/msg/TFMessage').transforms
    return [
        (
            t.header.frame_id, t.child_frame_id,
            t.header.stamp.sec + t.header.stamp.nanosec * 1e-9,
            (t.transform.translation.x, t.transform.translation.y, t.transform.translation.z),
            (t.transform.rotation.x, t.transform.rotation.y, t.transform.rotation.z,
             t.transform.rotation.w),
        )
        for t in found
    ]  # fmt: skip


@pytest.fixture
def say():
    """Return what makes messages, and reads transforms back."""
    return SimpleNamespace(
        odometry=odometry, pose=pose, joints=joints, text=text, transforms=transforms
    )
