"""What sets two bags apart, told by field and by time."""

from __future__ import annotations

from math import inf, nan

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.editing.diff import BY_STAMP, Tolerance, diff, distance, equal
from agv_motion.bag.editing.pairing import Pairing
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.metadata import Topic
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError, SourceError

STORE = get_typestore(Stores.ROS2_JAZZY)
JOINTS, NUMBER = 'sensor_msgs/msg/JointState', 'std_msgs/msg/Float64'
SECOND = 1_000_000_000


def joints(i, values, name='wheel', nanosec=0):
    types = STORE.types
    header = types['std_msgs/msg/Header'](types['builtin_interfaces/msg/Time'](i, nanosec), 'base')
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

    def run(first, second, topics=None, pairing=BY_STAMP, **tolerance):
        folder = f'{len(list(tmp_path.iterdir()))}'
        bags = write(f'{folder}a', first), write(f'{folder}b', second)
        with BagReader(bags[0]) as one, BagReader(bags[1]) as other:
            found = list(diff(one, other, topics, Tolerance(**tolerance), pairing))
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
    assert (found.compared, found.counts, found.apart) == (10, (10, 10), 0)


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
    assert (found['/number'].counts, found['/joints'].counts) == ((1, 0), (0, 10))
    assert not found['/number'].same


def test_messages_of_other_types_and_what_nobody_can_decode(tmp_path):
    """The bags have both types on a topic, in turn and the other way round."""
    for name, first in (('one', 1), ('two', 2)):
        writer = McapWriter(tmp_path / f'{name}.mcap', '')
        for kind in 'AB':
            writer.add_topic(Topic('/a', f'a/msg/{kind}', 'int8 x', '', ()))
        writer.add_topic(Topic('/b', 'a/msg/A', 'nonsense', '', ()))
        for stamp, channel in ((5, first), (6, 3 - first), (7, 3)):
            writer.write(channel, stamp, b'\0\1\0\0' + bytes((first,)) * 8, 0, 0)
        writer.flush()
        writer.close({})
    with BagReader(tmp_path / 'one.mcap') as one, BagReader(tmp_path / 'two.mcap') as two:
        found = {topic.topic: topic for topic in diff(one, two, None, Tolerance())}
    assert list(found['/a'].worst.values()) == [('type', 5, 'a/msg/A', 'a/msg/B')]
    assert (found['/a'].since, found['/a'].differing) == (5, 2)
    what = 'bytes that cannot be decoded'
    assert found['/b'].worst[what] == (what, 7, '0001000001010101', '0001000002020202')


@pytest.mark.parametrize(('a', 'b', 'same'), [
    (inf, inf, True), (-inf, inf, False), (inf, 1.0, False), (1.0, inf, False), (nan, nan, True),
    (nan, 1.0, False), (-1.0, -1.5, True), (-1.0, -1.51, False), (1.0, 1.5, True),
    ('a', 'a', True), ('a', 'b', False), (True, True, True), (np.bool_(1), np.bool_(0), False),
    (np.int8(100), np.int8(-100), False), (np.float32(0.5), 1.0, True),
])  # fmt: skip
def test_values_that_count_as_equal_within_a_half(a, b, same):
    assert equal(a, b, Tolerance(0.5)) is same
    assert equal(b, a, Tolerance(0.5)) is same


def test_what_is_relative_is_so_to_the_larger():
    for limit, same in ((0.5, True), (0.49, False)):
        assert equal(1.0, -2.0, Tolerance(relative=3 * limit)) is same
        assert equal(2.0, 1.0, Tolerance(relative=limit)) is same


def test_how_far_apart_values_are():
    assert distance(127, -1) == distance(np.int8(127), np.int8(-1)) == 128
    assert distance(2**63 + 5000, 2**63) == 5000
    assert distance(-0.5, 1.0) == 1.5
    assert distance('a', 'b') == distance(nan, 1.0) == inf


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
    with BagReader(bags[0]) as one, BagReader(bags[1]) as other:
        (found,) = diff(one, other, None, Tolerance())
    ((path, stamp, *values),) = found.worst.values()
    assert path == 'bytes that cannot be decoded, as one is no made/msg/Pair'
    assert (found.same, stamp, values) == (False, 1, ['0001000000000000', '0001000000'])


ARRAYS = [
    ('int8[]', np.int8, 127, -1, 128),
    ('int8[]', np.int8, -128, 127, 255),
    ('uint8[]', np.uint8, 0, 255, 255),
    ('char[]', np.uint8, 1, 254, 253),
    ('int16[2]', np.int16, 32767, -32768, 65535),
    ('uint16[]', np.uint16, 65535, 1, 65534),
    ('int32[]', np.int32, -(2**31), 2**31 - 1, 2**32 - 1),
    ('uint32[<=9]', np.uint32, 0, 2**32 - 1, 2**32 - 1),
    ('int64[]', np.int64, 2**63 - 1, -(2**63), 2**64 - 1),
    ('int64[]', np.int64, 2**63 - 1, 2**63 - 2, 1),
    ('uint64[]', np.uint64, 2**64 - 1, 0, 2**64 - 1),
    ('bool[]', np.bool_, True, False, 1),
    ('float32[]', np.float32, inf, -inf, inf),
    ('float64[]', np.float64, 1.0, inf, inf),
    ('float64[]', np.float64, nan, 1.0, inf),
]


@pytest.mark.parametrize('case', ARRAYS, ids=str)
@pytest.mark.parametrize('array', [True, False])
def test_extreme_numbers_are_as_far_apart_as_they_are(tmp_path, case, array):
    """In arrays and by themselves; a tolerance just below the distance, and one at it."""
    kind, dtype, *values, apart = case
    form, path = (kind, 'a[0]') if array else (kind.partition('[')[0], 'a')
    prefix = b'\0\1\0\0'
    if array and kind[-2] != '2':
        prefix += (2).to_bytes(4, 'little') + bytes(4 if np.dtype(dtype).itemsize == 8 else 0)
    data = [prefix + np.array([value] * (1 + array), dtype).tobytes() for value in values]
    with (
        BagReader(_made(tmp_path / 'a', f'{form} a', data[0])) as one,
        BagReader(_made(tmp_path / 'b', f'{form} a', data[1])) as other,
    ):
        for absolute, relative in ((0.0, 0.0), (0.99 * min(apart, 1e300), 0.0)):
            (found,) = diff(one, other, None, Tolerance(absolute, relative))
            assert found.differing == 1
            np.testing.assert_equal(found.worst[path][2:], values)
        (found,) = diff(one, other, None, Tolerance(float(apart), 0.0 if apart < inf else 1.0))
        assert found.same is (apart < inf and dtype is not np.bool_)


def shifted(shift, keep=lambda i: True):
    """Return ten messages with header, whose stamps are some nanoseconds later."""
    return [
        ('/joints', i, joints(i, [float(i)], nanosec=500_000_000 + shift(i)))
        for i in range(10)
        if keep(i)
    ]


MILLISECOND = 1_000_000


def test_messages_pair_within_a_tolerance_of_time(compare):
    first, second = shifted(lambda _: 0), shifted(lambda i: (i % 3 - 1) * MILLISECOND)
    found = compare(first, second, pairing=Pairing(within=MILLISECOND))['/joints']
    assert (found.same, found.compared, found.apart) == (True, 10, MILLISECOND)
    found = compare(first, second, pairing=Pairing(within=MILLISECOND - 1))['/joints']
    assert (found.compared, found.unpaired) == (3, 14)
    found = compare(first, second)['/joints']
    assert (found.compared, found.unpaired) == (3, 14)


def test_within_a_tolerance_the_nearest_pair_and_none_is_shifted(compare):
    first = shifted(lambda _: 0)
    second = shifted(lambda _: -400 * MILLISECOND, keep=lambda i: i not in {0, 4})
    found = compare(first, second, pairing=Pairing(within=700 * MILLISECOND))['/joints']
    assert (found.compared, found.differing, found.unpaired) == (8, 0, 2)
    assert found.apart == 400 * MILLISECOND


def test_a_time_is_one_number(compare):
    """0.999999999 and 1 s are a nanosecond apart, though no part of them is near the other."""
    first = [('/joints', 0, joints(0, [1.0], nanosec=999_999_999))]
    second = [('/joints', 0, joints(1, [1.0], nanosec=0))]
    assert compare(first, second, pairing=Pairing(within=1))['/joints'].same
    placed = compare(first, second, pairing=Pairing(by_place=True, within=0))['/joints']
    assert placed.worst['header.stamp [ns]'][2:] == (999_999_999, 1_000_000_000)


def test_messages_pair_by_place_whatever_their_stamps(compare):
    first, second = shifted(lambda _: 0), shifted(lambda i: i * MILLISECOND)
    found = compare(first, second, pairing=Pairing(by_place=True))['/joints']
    assert (found.same, found.apart) == (True, 9 * MILLISECOND)
    found = compare(first, second[:-1], pairing=Pairing(by_place=True))['/joints']
    assert (found.compared, found.unpaired, found.since) == (9, 1, 9)


def test_without_header_messages_pair_by_arrival_within_a_tolerance(compare):
    first = [('/number', i * SECOND, number(float(i))) for i in range(5)]
    second = [('/number', i * SECOND + 7, number(float(i))) for i in range(5) if i != 1]
    found = compare(first, second, pairing=Pairing(within=7))['/number']
    assert (found.compared, found.differing, found.unpaired) == (4, 0, 1)
    assert compare(first, second)['/number'].differing == 3


def test_a_message_without_room_for_its_header_is_told(compare):
    whole = [('/joints', 0, joints(0, [1.0]))]
    with pytest.raises(SourceError, match='/joints: the message at 5 ns has 3 bytes'):
        compare(whole, [('/joints', 5, b'\0\1\0')])


def test_numbers_beyond_the_reach_of_a_tolerance(compare):
    """A share of infinity is infinity, and everything was near it."""
    first, second = [('/number', 0, number(inf))], [('/number', 0, number(5.0))]
    assert compare(first, second, relative=0.1)['/number'].differing == 1
