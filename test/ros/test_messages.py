"""Messages and values of the core: there and back, and the doors between."""

from __future__ import annotations

from math import cos, nan, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip('rclpy')

from geometry_msgs.msg import Pose as PoseMessage
from geometry_msgs.msg import Twist as TwistMessage
from rclpy.serialization import deserialize_message, serialize_message

from agv_motion.errors import SignalError
from agv_motion.planar import Pose, Twist
from agv_motion.ros.messages import (
    TurretJoints,
    fill_pose,
    fill_twist,
    pose_of,
    seconds_of,
    stamp_of,
    twist_of,
)

NUMBER = st.floats(-1e3, 1e3)


@given(NUMBER, NUMBER, st.floats(-pi, pi, exclude_max=True))
def test_a_pose_there_and_back(x, y, theta):
    message = PoseMessage()
    fill_pose(message, Pose(x, y, theta))
    back = pose_of(message)
    assert (back.x, back.y) == (x, y)
    assert (cos(back.theta), sin(back.theta)) == pytest.approx((cos(theta), sin(theta)))


def test_whole_numbers_arrive_as_they_are():
    """A message takes an int for a field of decimals, and sends another number."""
    pose, twist = PoseMessage(), TwistMessage()
    fill_pose(pose, Pose(2, 3, 0))
    fill_twist(twist, Twist(1, -1, 2))
    pose, twist = (
        deserialize_message(serialize_message(each), type(each)) for each in (pose, twist)
    )
    assert pose_of(pose) == Pose(2.0, 3.0, 0.0)
    assert twist_of(twist) == Twist(1.0, -1.0, 2.0)


@given(NUMBER, NUMBER, NUMBER)
def test_a_twist_there_and_back(vx, vy, wz):
    message = TwistMessage()
    fill_twist(message, Twist(vx, vy, wz))
    assert twist_of(message) == (vx, vy, wz)


@given(st.integers(0, 2**61))
def test_a_stamp_loses_nothing(nanoseconds):
    stamp = stamp_of(min(nanoseconds, (2**31 - 1) * 10**9))
    assert 0 <= stamp.nanosec < 10**9
    assert stamp.sec * 10**9 + stamp.nanosec == min(nanoseconds, (2**31 - 1) * 10**9)
    assert seconds_of(stamp) == pytest.approx(stamp.sec + stamp.nanosec * 1e-9)


def test_a_quaternion_of_another_length_is_refused():
    message = PoseMessage()
    message.orientation.w = 0.5
    with pytest.raises(SignalError, match=r'length 0\.5'):
        pose_of(message)
    message.orientation.w = nan
    with pytest.raises(SignalError, match='pose must be finite'):
        pose_of(message)


def test_a_pose_farther_than_any_map_reaches_is_refused_and_national_metres_are_not():
    message = PoseMessage()
    message.orientation.w, message.position.x, message.position.y = 1.0, 5e5, 6.8e6
    assert pose_of(message).y == 6.8e6
    message.position.y = -1.1e7
    with pytest.raises(SignalError, match=r'must be within 1e\+07 m of the origin'):
        pose_of(message)


def test_joints_are_read_by_name_in_any_order():
    joints = TurretJoints(2)
    message = joints.message()
    joints.fill(message, [0.1, 0.2], [3.0, 4.0])
    order = [3, 0, 2, 1]
    message.name, message.position, message.velocity = (
        [column[i] for i in order] for column in (message.name, message.position, message.velocity)
    )
    assert joints.read(message) == ([0.1, 0.2], [3.0, 4.0])
    assert joints.is_standstill(joints.standstill())
    assert not joints.is_standstill(message)
