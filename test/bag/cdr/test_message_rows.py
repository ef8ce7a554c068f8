"""Many messages as a table: written and read by an independent library."""

from __future__ import annotations

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

pytest.importorskip('rclpy')

from agv_motion.bag.cdr.message_rows import MessageRows

STORE = get_typestore(Stores.ROS2_JAZZY)
JOINTS = 'sensor_msgs/msg/JointState'


def joints(i, names=('left', 'right')):
    types = STORE.types
    header = types['std_msgs/msg/Header'](types['builtin_interfaces/msg/Time'](i, 7), 'base')
    values = np.array([i, i / 3])
    message = types[JOINTS](header, list(names), values, -values, np.empty(0))
    return bytes(STORE.serialize_cdr(message, JOINTS))


def test_what_others_wrote_is_read_by_columns():
    messages = [joints(i) for i in range(5)]
    table = MessageRows(JOINTS, messages[0]).read(messages)
    assert table['header.stamp.sec'].tolist() == list(range(5))
    assert table['position'].tolist() == [[i, i / 3] for i in range(5)]
    assert table['velocity'].shape == (5, 2)
    assert table.shape == (5,)


@pytest.mark.parametrize('names', [('left', 'rigth'), ('left', 'right one'), ('a', 'b', 'c')])
def test_messages_with_other_strings_or_lengths_are_no_rows(names):
    rows = MessageRows(JOINTS, joints(0))
    assert rows.read([joints(1), joints(2, names)]) is None


def test_a_length_that_takes_in_the_padding_is_another_layout():
    """With two zeros "left" has the same bytes as with one, but for its length."""
    rows, lying = MessageRows(JOINTS, joints(0)), bytearray(joints(1))
    at = lying.index(b'left') - 4
    assert lying[at : at + 12] == b'\5\0\0\0left\0\0\0\0'
    lying[at] = 6
    assert rows.read([joints(1), bytes(lying)]) is None
    assert rows.read([joints(1), joints(2) + bytes(4)]) is None
    assert rows.read([]).shape == (0,)


@pytest.mark.parametrize(('place', 'same'), [(0, False), (1, False), (2, True), (3, True)])
def test_the_order_of_bytes_counts_and_options_do_not(place, same):
    other = bytearray(joints(1))
    other[place] ^= 1
    found = MessageRows(JOINTS, joints(0)).read([bytes(other)])
    assert (found is not None) is same


def test_others_read_what_is_written_by_columns():
    rows = MessageRows(JOINTS, joints(0))
    table = rows.table(3)
    table['header.stamp.sec'] = [1, 2, 3]
    table['position'] = [[i, i / 3] for i in (1, 2, 3)]
    table['velocity'] = -table['position']
    assert rows.messages(table) == [joints(1), joints(2), joints(3)]
