"""Every kind of fault is planted into a sound bag, and found there and nowhere else."""

from __future__ import annotations

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.checks.check import Limits, check
from agv_motion.bag.checks.silences import regular, silences
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
    headers[200] = headers[198]
    (finding,) = found(write(tmp_path / 'bag', steady, headers=headers))
    assert (finding.severity, finding.where) == ('error', '/flow')
    assert 'header.stamp goes back 1 times, first by 0.100000000 s at message 200' in finding.text


@pytest.mark.parametrize(('talkers', 'severity'), [(1, 'error'), (2, 'warning')])
def test_stamps_of_two_who_number_their_messages_may_go_back(tmp_path, steady, talkers, severity):
    headers = steady.copy()
    headers[200] = headers[198]
    numbers = np.arange(COUNT) // talkers + 1
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


def test_a_rate_that_changes(tmp_path, steady):
    slower = np.concatenate([steady, steady[-1] + (np.arange(60) + 1) * 14 * TENTH // 10])
    (finding,) = found(write(tmp_path / 'bag', slower))
    assert finding.text == 'its rate changes from 7.143 to 10.000 Hz'


def test_nan(tmp_path, steady):
    xs = np.ones(COUNT)
    xs[[30, 31]] = np.nan
    (finding,) = found(write(tmp_path / 'bag', steady, xs=xs))
    assert finding == ('error', '/flow', 'vector.x is NaN in 2 messages, first at 3.000 s')


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
            writer.write(topic, i, bytes(STORE.serialize_cdr(message, JOINTS)))
    (finding,) = found(tmp_path / 'bag')
    assert 'position is NaN in 2 messages' in finding.text


def test_a_flipped_bit_is_a_crc_error_and_does_not_hide_the_rest(tmp_path, steady):
    path = write(tmp_path / 'bag', np.delete(steady, slice(100, 140)))
    file = path / 'bag_0.mcap'
    with BagReader(path) as bag:
        chunk = bag.files[0].chunks[2]
    data = bytearray(file.read_bytes())
    data[chunk.offset + chunk.length - 20] ^= 4
    file.write_bytes(data)
    findings = found(path)
    assert any(f.severity == 'error' and f'byte {chunk.offset}' in f.text for f in findings)
    assert any('silent for' in f.text for f in findings)


def test_a_topic_that_changed_its_type(tmp_path):
    (tmp_path / 'bag').mkdir()
    for number, text in enumerate(('string data', 'string data\nint32 more')):
        part = tmp_path / f'bag_{number}'
        with BagWriter(part) as writer:
            topic = writer.add_topic('/a', 'std_msgs/msg/String', text, type_hash='')
            writer.write(topic, number, b'\x00\x01\x00\x00\x01\x00\x00\x00\x00')
        (part / f'{part.name}_0.mcap').rename(tmp_path / 'bag' / f'bag_{number}.mcap')
    texts = [f.text for f in found(tmp_path / 'bag')]
    assert any('its type changed: std_msgs/msg/String, defined differently' in t for t in texts)


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
