"""Messages as text: the form of `ros2 topic echo`, and YAML back into messages."""

from __future__ import annotations

from math import inf

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovariance, TwistStamped
from nav_msgs.msg import Path
from sensor_msgs.msg import JointState
from std_msgs.msg import (
    Bool,
    Byte,
    ByteMultiArray,
    Float32,
    Float32MultiArray,
    Float64,
    Int8,
    Int8MultiArray,
    Int64,
    UInt8,
    UInt8MultiArray,
)

from agv_motion.cli.topic.message_text import MessageText, csv_row, fill
from agv_motion.errors import ConfigurationError


def test_yaml_in_the_order_of_the_fields():
    message = JointState(name=['a'], position=[1.5])
    assert MessageText().yaml(message) == (
        "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: ''\n"
        'name:\n- a\nposition:\n- 1.5\nvelocity: []\neffort: []\n'
    )  # fmt: skip


def test_an_empty_array_is_an_empty_cell():
    message = JointState(name=['a', 'b'], position=[1.0, 2.5])
    assert MessageText().csv(message) == '0,0,,a,b,1.0,2.5,,'
    assert csv_row(['a,b', '1\n2', 'c"', 3]) == '"a,b","1\n2","c""",3'


def test_long_arrays_are_cut_or_hidden():
    message = PoseWithCovariance()
    assert MessageText(3).yaml(message).endswith("covariance:\n- 0.0\n- 0.0\n- 0.0\n- '...'\n")
    assert "covariance: '<array type: double[36]>'" in MessageText(no_arr=True).yaml(message)
    hidden = MessageText(no_arr=True).yaml(JointState(name=['a']))
    assert "name: '<sequence type: string, length: 1>'" in hidden


@pytest.mark.parametrize(
    ('kind', 'values', 'check'),
    [
        (TwistStamped, {'twist': {'linear': {'x': 1}}}, lambda m: m.twist.linear.x == 1.0),
        (Bool, {'data': True}, lambda m: m.data is True),
        (UInt8MultiArray, {'data': [1, 255]}, lambda m: list(m.data) == [1, 255]),
        (ByteMultiArray, {'data': [b'\x01']}, lambda m: m.data == [b'\x01']),
        (
            Path,
            {'poses': [{'pose': {'position': {'x': 2}}}]},
            lambda m: m.poses[0].pose.position.x == 2.0,
        ),
    ],
)
def test_yaml_values_fill_a_message(kind, values, check):
    message = kind()
    assert fill(message, values) == []
    assert check(message)


@pytest.mark.parametrize(
    ('kind', 'value', 'reason'),
    [
        (Int8, 300, r'\[-128, 127\]'),
        (Int8, 1.5, 'whole number'),
        (UInt8, -1, r'\[0, 255\]'),
        (Byte, 256, 'range'),
        (Float32, 1e300, '3.4'),
        (Bool, 2, 'true or false'),
        (Bool, 'false', 'true or false'),
        (Int8MultiArray, [300], 'greater than maximum'),
        (Int8MultiArray, [1.5], 'integer'),
        (Float32MultiArray, [1e300], 'does not hold'),
    ],
)
def test_what_would_be_another_value_on_the_wire_is_refused(kind, value, reason):
    with pytest.raises(ConfigurationError, match=reason):
        fill(kind(), {'data': value})


@pytest.mark.parametrize(
    ('kind', 'value', 'held'),
    [
        (Int64, 2**62 + 1, 2**62 + 1), (Int8, 5.0, 5), (Float64, 3, 3.0), (Float64, inf, inf),
        (Bool, 1, True), (Byte, 255, b'\xff'), (Float32MultiArray, [2, inf], [2.0, inf]),
    ],
)  # fmt: skip
def test_the_same_value_in_another_form_is_taken(kind, value, held):
    message = kind()
    fill(message, {'data': value})
    assert (list(message.data) if isinstance(held, list) else message.data) == held


def test_auto_and_now_take_the_time_of_publishing():
    message = TwistStamped()
    (stamp,) = fill(message, {'header': 'auto'})
    stamp(type(message.header.stamp)(sec=7))
    assert message.header.stamp.sec == 7


@pytest.mark.parametrize(
    ('values', 'word'),
    [
        ({'twist': {'linear': {'w': 1}}}, "no field 'w'"),
        ({'twist': 3}, 'expected to be a dictionary'),
        ({'twist': {'linear': {'x': 'fast'}}}, "Failed to populate field: x .* with 'fast'"),
    ],
)
def test_values_that_do_not_fit_are_told(values, word):
    with pytest.raises(ConfigurationError, match=word):
        fill(TwistStamped(), values)
