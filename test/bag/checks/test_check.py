"""Every kind of fault is planted into a sound bag, and found there and nowhere else."""

from __future__ import annotations

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.checks.check import Limits, check
from agv_motion.bag.checks.silences import regular, silences
from agv_motion.bag.columns.columns import read_topic
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.metadata import Topic
from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError

STORE = get_typestore(Stores.ROS2_JAZZY)
VECTOR = 'geometry_msgs/msg/Vector3Stamped'
JOINTS = 'sensor_msgs/msg/JointState'
TENTH = 100_000_000
COUNT = 300


def vector(stamp, x=1.0):
    make = STORE.types
    time = make['builtin_interfaces/msg/Time'](*divmod(int(stamp), 10**9))
    values = make['geometry_msgs/msg/Vector3'](x, 2.0, 3.0)
    return bytes(
        STORE.serialize_cdr(make[VECTOR](make['std_msgs/msg/Header'](time, 'a'), values), VECTOR)
    )


def write(path, stamps, *, headers=None, xs=None, numbers=None):
    text = STORE.generate_msgdef(VECTOR, ros_version=2)[0]
    with BagWriter(path, chunk_size=2000) as writer:
        topic = writer.add_topic('/flow', VECTOR, text, type_hash='')
        for i, stamp in enumerate(stamps):
            header = stamp if headers is None else headers[i]
            data = vector(header, 1.0 if xs is None else xs[i])
            number = 0 if numbers is None else int(numbers[i])
            writer.write(topic, int(stamp), data, sequence=number)
    return path


def found(path, limits=None):
    with BagReader(path) as bag:
        return list(check(bag, limits) if limits else check(bag))


@pytest.fixture
def steady():
    return (np.arange(COUNT) + 1) * TENTH


def test_a_sound_bag_has_no_findings(tmp_path, steady):
    assert found(write(tmp_path / 'bag', steady), Limits({'/flow': 10.0})) == []


def test_a_stamp_that_goes_back(tmp_path, steady):
    headers = steady.copy()
    headers[200] = headers[190]
    text = (
        'header.stamp goes back 1 times, first by 0.900000000 s at message 200 (20000000000 ns, '
        'then 19100000000 ns)'
    )
    assert found(write(tmp_path / 'bag', steady, headers=headers)) == [('error', '/flow', text)]


@pytest.mark.parametrize('first', [0, 1])
@pytest.mark.parametrize(('talkers', 'severity'), [(1, 'error'), (2, 'warning')])
def test_stamps_of_two_who_number_their_messages_may_go_back(
    tmp_path, steady, talkers, severity, first
):
    headers = steady.copy()
    headers[200] = headers[198]
    numbers = np.arange(COUNT) // talkers + first
    (finding,) = found(write(tmp_path / 'bag', steady, headers=headers, numbers=numbers))
    assert (finding.severity, finding.where) == (severity, '/flow')


@pytest.mark.parametrize(('talkers', 'severity'), [(1, 'error'), (2, 'warning')])
def test_stamps_of_two_publishers_that_the_bag_tells_of_may_go_back(tmp_path, talkers, severity):
    text = STORE.generate_msgdef(VECTOR, ros_version=2)[0]
    with BagWriter(tmp_path / 'bag') as writer:
        qos = [OfferedQos(depth=1)] * talkers
        topic = writer.add_topic('/flow', VECTOR, text, type_hash='', qos=qos)
        for i, header in enumerate((1, 3, 2, 4)):
            writer.write(topic, i * TENTH, vector(header * TENTH))
    (finding,) = found(tmp_path / 'bag')
    assert (finding.severity, finding.where) == (severity, '/flow')


def test_stamps_of_two_channels_or_of_transforms_may_go_back(tmp_path):
    text = STORE.generate_msgdef(VECTOR, ros_version=2)[0]
    for number, kind in enumerate((VECTOR, 'a/msg/Log', VECTOR)):
        writer = McapWriter(tmp_path / f'{number}.mcap', '')
        for one in ('RIHS01_1', 'RIHS01_2')[: 2 - (number > 0)]:
            writer.add_topic(Topic('/flow', kind, text, one, ()))
        for i, header in enumerate((1, 3, 2, 4)):
            channel = i % 2 + 1 if number == 0 else 1
            writer.write(channel, i * TENTH, vector(header * TENTH), i, 0)
        writer.flush()
        writer.close({})
        finding = found(tmp_path / f'{number}.mcap')[-1]
        assert (finding.severity, finding.where) == (('warning', 'error')[number == 2], '/flow')
        assert finding.text.startswith('header.stamp goes back 1 times, first by 0.100000000 s at')


def test_log_times_that_go_back_are_a_warning(tmp_path, steady):
    shuffled = steady.copy()
    shuffled[[50, 51]] = shuffled[[51, 50]]
    (finding,) = found(write(tmp_path / 'bag', shuffled))
    assert finding.severity == 'warning'
    assert 'log time goes back 1 times' in finding.text


def test_a_silence_and_what_is_missing(tmp_path, steady):
    with_gap = np.delete(steady, slice(100, 140))
    (finding,) = found(write(tmp_path / 'bag', with_gap))
    assert finding.severity == 'warning'
    assert 'silent for 4.100 s after 9.900 s' in finding.text
    assert 'about 40 messages' in finding.text


def test_a_rate_that_is_not_as_asked_for(tmp_path, steady):
    (finding,) = found(write(tmp_path / 'bag', steady), Limits({'/flow': 12.0}))
    assert finding == ('error', '/flow', '10.000 Hz, expected 12 Hz within 10%')
    assert found(tmp_path / 'bag', Limits({'/flow': 11.0})) == []
    assert len(found(tmp_path / 'bag', Limits({'/flow': 11.0}, tolerance=0.09))) == 1
    assert len(found(tmp_path / 'bag', Limits({'/flow': 9.0}))) == 1


def test_a_rate_that_changes(tmp_path, steady):
    slower = np.concatenate([steady, steady[-1] + (np.arange(60) + 1) * 14 * TENTH // 10])
    (finding,) = found(write(tmp_path / 'bag', slower))
    assert finding.text == 'its rate changes from 7.143 to 10.000 Hz'


def test_nan(tmp_path, steady):
    xs = np.ones(COUNT)
    xs[[30, 31]] = np.nan
    (finding,) = found(write(tmp_path / 'bag', steady, xs=xs))
    assert finding == ('error', '/flow', 'vector.x is NaN in 2 messages, first at 3.000 s')


def test_a_large_bag_is_looked_through_in_slices_of_time(tmp_path, steady, monkeypatch):
    path = write(tmp_path / 'bag', steady[:4], xs=[1.0, np.nan, 1.0, np.nan])
    with BagReader(path) as bag:
        size = bag.files[0].unpacked_size
    slices = []

    def read(bag, topic, fields, start, stop):
        slices.append((start, stop))
        return read_topic(bag, topic, fields, start, stop)

    monkeypatch.setattr('agv_motion.bag.checks.check.read_topic', read)
    for room, expected in ((size + 1, [(TENTH, None)]),
                           (size, [(TENTH, 250_000_000), (250_000_000, None)]),
                           (size // 2, [(TENTH, 2 * TENTH), (2 * TENTH, 3 * TENTH),
                                        (3 * TENTH, None)])):  # fmt: skip
        monkeypatch.setattr('agv_motion.bag.checks.check._SLICE', room)
        slices.clear()
        (finding,) = found(path)
        assert finding.text == 'vector.x is NaN in 2 messages, first at 0.100 s'
        assert slices == expected


def test_nan_in_sequences_whose_length_changes(tmp_path):
    make = STORE.types
    header = make['std_msgs/msg/Header'](make['builtin_interfaces/msg/Time'](1, 5), 'a')
    empty = np.zeros(0)
    with BagWriter(tmp_path / 'bag') as writer:
        text = STORE.generate_msgdef(JOINTS, ros_version=2)[0]
        topic = writer.add_topic('/joints', JOINTS, text, type_hash='')
        for i in range(6):
            position = np.full(i, np.nan if i in {2, 5} else 0.0)
            message = make[JOINTS](header, [], position, empty, empty)
            writer.write(topic, i * 10**9, bytes(STORE.serialize_cdr(message, JOINTS)))
    (finding,) = found(tmp_path / 'bag')
    assert finding.text == 'position is NaN in 2 messages, first at 2.000 s'


def test_a_flipped_bit_is_a_crc_error_and_does_not_hide_the_rest(tmp_path, steady):
    path = write(tmp_path / 'bag', np.delete(steady, slice(100, 140)))
    file = path / 'bag_0.mcap'
    with BagReader(path) as bag:
        chunk = bag.files[0].chunks[2]
    data = bytearray(file.read_bytes())
    data[chunk.offset + chunk.length - 20] ^= 4
    file.write_bytes(data)
    damage, lost, silence, values = found(path)
    assert lost == ('error', 'bag_0.mcap', '249 messages, but its statistics tell of 260')
    assert (damage.severity, damage.where) == ('error', 'bag_0.mcap')
    assert f'byte {chunk.offset}: ' in damage.text
    assert (silence.severity, silence.where) == ('warning', '/flow')
    assert silence.text.startswith('silent for 4.100 s after 9.900 s, usual are 0.100 s')
    text = 'values were not looked at, as the file is damaged: agv bag recover, then check'
    assert values == ('warning', str(path), text)


def test_what_the_metadata_has_wrong_is_a_warning_and_what_is_lost_an_error(tmp_path, steady):
    path = write(tmp_path / 'bag', steady[:20])
    (path / 'metadata.yaml').unlink()
    (finding,) = found(path)
    assert (finding.severity, finding.where) == ('warning', str(path / 'metadata.yaml'))
    (path / 'bag_0.mcap').write_bytes((path / 'bag_0.mcap').read_bytes()[:1000])
    assert [f.severity for f in found(path)] == ['warning', 'error']


def test_what_cannot_be_decoded_is_told_and_not_looked_at(tmp_path):
    writer = McapWriter(tmp_path / 'a.mcap', '')
    writer.add_topic(Topic('/a', 'a/msg/A', 'int8 x', '', (), encoding='json'))
    writer.add_topic(Topic('/b', 'a/msg/A', '', '', ()))
    writer.write(1, 5, b'{}', 5, 0)
    writer.flush()
    writer.close({})
    assert found(tmp_path / 'a.mcap') == [
        ('warning', '/a', "its messages are encoded in 'json': values were not looked at"),
        ('warning', '/b', 'the bag has no definition of a/msg/A'),
    ]
    with BagReader(tmp_path / 'a.mcap') as bag:  # one message has no rate, and none has neither
        texts = [f.text for f in check(bag, Limits({'/a': 5.0, '/b': 5.0}))]
    assert texts.count('0.000 Hz, expected 5 Hz within 10%') == 2


@pytest.mark.parametrize(('kinds', 'texts', 'what'), [
    (('a/msg/A', 'a/msg/A'), ('string data', 'string data\nint32 more'),
     'its type changed: a/msg/A, defined differently'),
    (('b/msg/B', 'a/msg/A'), ('string data', 'string data'),
     'its type changed: a/msg/A and b/msg/B'),
])  # fmt: skip
def test_a_topic_that_changed_its_type(tmp_path, kinds, texts, what):
    (tmp_path / 'bag').mkdir()
    for number, text in enumerate(texts):
        part = tmp_path / f'bag_{number}'
        with BagWriter(part) as writer:
            topic = writer.add_topic('/a', kinds[number], text, type_hash='')
            writer.write(topic, number, b'\x00\x01\x00\x00\x01\x00\x00\x00\x00')
        (part / f'{part.name}_0.mcap').rename(tmp_path / 'bag' / f'bag_{number}.mcap')
    findings = [(f.severity, f.text) for f in found(tmp_path / 'bag') if f.where == '/a']
    assert findings[0] == ('error', what)
    assert len(findings) == 2  # and that its values cannot be looked at


def test_a_topic_that_is_not_there_cannot_have_a_rate(tmp_path, steady):
    with pytest.raises(ConfigurationError, match="did you mean '/flow'"):
        found(write(tmp_path / 'bag', steady), Limits({'/flw': 12.0}))


def test_only_regular_topics_have_silences_of_their_own():
    steady = np.arange(100) * TENTH
    assert regular(steady)
    assert not regular(np.cumsum(np.arange(100) ** 2) * TENTH)
    assert not regular(steady[:9])
    assert silences(steady, 5.0) == []
    (silence,) = silences(np.delete(steady, [10, 11, 12, 13, 14]), 5.0)
    assert (silence.after, silence.length, silence.missing) == (9 * TENTH, 6 * TENTH, 5)
