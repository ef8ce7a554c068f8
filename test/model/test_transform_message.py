"""The bytes of a TFMessage are those that an independent library reads."""

from __future__ import annotations

import pytest
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.cdr.definitions import installed
from agv_motion.model.transform import Transform
from agv_motion.model.transform_message import TYPE, encoded

JAZZY = get_typestore(Stores.ROS2_JAZZY)
ONE = Transform(1_500_000_007, 'map', 'oak/odom', (1.0, -2.0, 0.5), (0.0, 0.6, 0.0, 0.8))
NAMES = ['', 'a', 'ab', 'abc', 'abcd', 'abcde', 'abcdef', 'abcdefg', 'Bäume/odom']


@pytest.mark.parametrize('name', NAMES)
def test_any_length_of_a_name_is_read_back(name):
    before = Transform(-1, name, f'{name}x', (0.1, 0.2, 0.3), (0.0, 0.0, 0.0, 1.0))
    told = JAZZY.deserialize_cdr(encoded([before, ONE]), TYPE).transforms
    assert [(t.header.frame_id, t.child_frame_id) for t in told] == [
        (name, f'{name}x'), ('map', 'oak/odom'),
    ]  # fmt: skip
    assert (told[0].header.stamp.sec, told[0].header.stamp.nanosec) == (-1, 999_999_999)
    assert (told[1].header.stamp.sec, told[1].header.stamp.nanosec) == (1, 500_000_007)
    place, turned = told[1].transform.translation, told[1].transform.rotation
    assert (place.x, place.y, place.z) == ONE.translation
    assert (turned.x, turned.y, turned.z, turned.w) == ONE.rotation


def test_the_bytes_are_those_of_another_writer():
    data = encoded([ONE, ONE._replace(child='a')])
    again = JAZZY.serialize_cdr(JAZZY.deserialize_cdr(data, TYPE), TYPE)
    assert data == bytes(again)


def test_none_at_all_is_a_message_too():
    assert JAZZY.deserialize_cdr(encoded([]), TYPE).transforms == []


def test_definition_and_hash_are_told_without_the_package():
    pytest.importorskip('geometry_msgs')
    text, hashed = installed(TYPE)
    assert text.startswith('geometry_msgs/TransformStamped[] transforms\n')
    assert 'MSG: geometry_msgs/Quaternion' in text
    assert 'MSG: builtin_interfaces/Time' in text
    assert hashed == 'RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087'
