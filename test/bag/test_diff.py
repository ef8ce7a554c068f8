"""What sets two bags apart, told by field and by time."""

from __future__ import annotations

from math import nan

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.diff import Tolerance, diff
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError, SourceError

STORE = get_typestore(Stores.ROS2_JAZZY)
JOINTS, NUMBER = 'sensor_msgs/msg/JointState', 'std_msgs/msg/Float64'
SECOND = 1_000_000_000


def joints(i, values, name='wheel'):
    types = STORE.types
    header = types['std_msgs/msg/Header'](types['builtin_interfaces/msg/Time'](i, 0), 'base')
    array = np.array(values, dtype=float)
    none = np.zeros(0)
    message = types[JOINTS](header, [name] * len(values), array, none, none)
    return bytes(STORE.serialize_cdr(message, JOINTS))


def number(value):
    return bytes(STORE.serialize_cdr(STORE.types[NUMBER](value), NUMBER))


@pytest.fixture
def compare(tmp_path):
    """Return a function that compares two lists of (topic, log time, data)."""

    def write(name, messages):
        with BagWriter(tmp_path / name) as writer:
            handles = {}
            for topic, stamp, data in messages:
                if topic not in handles:
                    kind = JOINTS if topic.startswith('/joints') else NUMBER
                    definition, _ = STORE.generate_msgdef(kind, ros_version=2)
                    handles[topic] = writer.add_topic(topic, kind, definition)
                writer.write(handles[topic], stamp, data)
        return tmp_path / name

    def run(first, second, topics=None, **tolerance):
        with BagReader(write('a', first)) as one, BagReader(write('b', second)) as other:
            found = list(diff(one, other, topics, Tolerance(**tolerance)))
        return {topic.topic: topic for topic in found}

    return run


def walk(change=lambda i, values: values, keep=lambda i: True, delay=0):
    return [
        ('/joints', i * SECOND + delay, joints(i, change(i, [float(i), 2.0])))
        for i in range(10)
        if keep(i)
    ]


def test_equal_content_is_the_same_whenever_it_was_received(compare):
    found = compare(walk(), walk(delay=12345))['/joints']
    assert found.same
    assert (found.compared, found.counts) == (10, (10, 10))


def test_the_worst_of_each_field_and_the_first_time(compare):
    def change(i, values):
        return [values[0], values[1] + (0.25 * (i - 3) if i > 3 else 0.0)]

    found = compare(walk(), walk(change))['/joints']
    assert not found.same
    assert (found.differing, found.unpaired, found.since) == (6, 0, 4 * SECOND)
    (worst,) = found.worst.values()
    assert worst == ('position[1]', 9 * SECOND, 2.0, 3.5)


@pytest.mark.parametrize(
    ('tolerance', 'same'),
    [
        ({'absolute': 0.125}, True),
        ({'absolute': 0.124}, False),
        ({'relative': 0.0625}, True),
        ({'relative': 0.0585}, False),
        ({'absolute': 0.0625, 'relative': 0.03125}, True),
    ],
)
def test_tolerances_at_their_limit(compare, tolerance, same):
    found = compare(walk(), walk(lambda _, values: [values[0], 2.125]), **tolerance)
    assert found['/joints'].same is same


def test_a_message_without_partner_does_not_shift_the_others(compare):
    found = compare(walk(), walk(keep=lambda i: i not in {2, 9}))['/joints']
    assert (found.compared, found.differing, found.unpaired) == (8, 0, 2)
    assert found.since == 2 * SECOND


def test_without_header_messages_pair_by_place(compare):
    first = [('/number', i, number(float(i))) for i in range(5)]
    second = [('/number', 7 * i, number(float(i))) for i in range(3)]
    found = compare(first, second)['/number']
    assert (found.compared, found.differing, found.unpaired) == (3, 0, 2)


def test_nan_equals_nan_and_nothing_else(compare):
    first = [('/number', i, number(value)) for i, value in enumerate([nan, 1.0])]
    second = [('/number', i, number(value)) for i, value in enumerate([nan, nan])]
    found = compare(first, second, absolute=100.0)['/number']
    assert found.differing == 1


def test_another_length_and_another_text_are_told(compare):
    first = [('/joints', 0, joints(0, [1.0])), ('/joints', 1, joints(1, [1.0]))]
    second = [('/joints', 0, joints(0, [1.0, 2.0])), ('/joints', 1, joints(1, [1.0], 'w'))]
    found = compare(first, second, absolute=1e9)['/joints']
    assert found.worst['length of position'][2:] == (1, 2)
    assert found.worst['name[0]'][2:] == ('wheel', 'w')


def test_topics_that_one_bag_lacks_and_topics_that_none_has(compare):
    first, second = [('/number', 0, number(1.0))], walk()
    found = compare(first, second)
    assert found['/number'].note == 'not in the second bag'
    assert found['/joints'].note == 'not in the first bag'
    assert not found['/number'].same


def test_a_topic_of_neither_bag_is_refused(compare):
    with pytest.raises(ConfigurationError, match='/nothing'):
        compare(walk(), walk(), ['/nothing'])


def _made(path, definition, data):
    with BagWriter(path) as writer:
        topic = writer.add_topic('/made', 'made/msg/Pair', definition, type_hash='')
        writer.write(topic, 1, data)
    return path


def test_a_type_that_is_defined_differently_is_told(tmp_path):
    data = b'\0\1\0\0' + bytes(8)
    bags = [_made(tmp_path / f, f'int32 {f}  # first\nint32 b\n', data) for f in ('a', 'c')]
    bags.append(_made(tmp_path / 'same', 'int32 a\nint32 b', data[:-1] + b'\1'))
    with BagReader(bags[0]) as one, BagReader(bags[1]) as other, BagReader(bags[2]) as same:
        (renamed,) = diff(one, other, None, Tolerance())
        (changed,) = diff(one, same, None, Tolerance())
    assert (renamed.same, renamed.note) == (False, 'made/msg/Pair is defined differently')
    assert (changed.note, list(changed.worst)) == ('', ['b'])


def test_a_message_that_is_not_of_its_type_is_told_with_its_time(tmp_path):
    bags = [_made(tmp_path / f'{n}', 'int32 a', b'\0\1\0\0' + bytes(n)) for n in (4, 1)]
    with (
        BagReader(bags[0]) as one,
        BagReader(bags[1]) as other,
        pytest.raises(SourceError, match='/made: the message at 1 ns is no made/msg/Pair'),
    ):
        list(diff(one, other, None, Tolerance()))
