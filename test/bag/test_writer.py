"""What the writer writes, others read: rosbags, mcap, and mcap's decoder of ROS messages."""

from __future__ import annotations

import zlib
from pathlib import Path

import numpy as np
import pytest
import yaml
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import Reader, ReaderError
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.mcap.together import Together
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter, OfferedQos
from agv_motion.errors import ConfigurationError, SignalError, SourceError

STORE = get_typestore(Stores.ROS2_JAZZY)
TWIST = 'geometry_msgs/msg/TwistStamped'
TEXT = 'std_msgs/msg/String'
SECOND = 1_000_000_000


def twist(i):
    types = STORE.types
    vector = types['geometry_msgs/msg/Vector3']
    header = types['std_msgs/msg/Header'](types['builtin_interfaces/msg/Time'](i, 7), 'base_link')
    content = types['geometry_msgs/msg/Twist'](vector(i, 0.5, -1.0), vector(0.0, 0.0, i / 3))
    return bytes(STORE.serialize_cdr(types[TWIST](header, content), TWIST))


def text(i):
    return bytes(STORE.serialize_cdr(STORE.types[TEXT](f'line {i}'), TEXT))


def known(message_type):
    """Return definition and hash from the types of rosbags, so that ROS need not be installed."""
    definition, _ = STORE.generate_msgdef(message_type, ros_version=2)
    return {'definition': definition, 'type_hash': STORE.hash_rihs01(message_type)}


@pytest.fixture(params=['zstd', 'lz4', 'none'])
def bag(request, tmp_path):
    """Return a bag of 300 messages on two topics, in many small chunks."""
    with BagWriter(tmp_path / 'bag', compression=request.param, chunk_size=2000) as writer:
        twists = writer.add_topic('/cmd_vel', TWIST, **known(TWIST), qos=[OfferedQos(depth=1)])
        texts = writer.add_topic(
            '/state', TEXT, **known(TEXT), qos=[OfferedQos(durability='transient_local')]
        )
        writer.add_topic('/silent', TEXT, **known(TEXT))
        for i in range(200):
            writer.write(twists, i * SECOND, twist(i), publish=i * SECOND - min(i, 1))
            if i % 2:
                writer.write(texts, i * SECOND, text(i), sequence=i)
    return tmp_path / 'bag'


def test_rosbags_reads_every_message_back(bag):
    with AnyReader([bag]) as reader:
        read = [(c.topic, stamp, data) for c, stamp, data in reader.messages()]
        counts = {c.topic: c.msgcount for c in reader.connections}
    assert [(s, d) for t, s, d in read if t == '/cmd_vel'] == [
        (i * SECOND, twist(i)) for i in range(200)
    ]
    assert [(s, d) for t, s, d in read if t == '/state'] == [
        (i * SECOND, text(i)) for i in range(1, 200, 2)
    ]
    assert counts == {'/cmd_vel': 200, '/state': 100, '/silent': 0}


def test_rosbags_finds_type_hash_quality_of_service_and_times(bag):
    with Reader(bag) as reader:
        by_topic = {c.topic: c for c in reader.connections}
        assert by_topic['/cmd_vel'].digest == STORE.hash_rihs01(TWIST)
        assert by_topic['/state'].ext.offered_qos_profiles[0].durability.name == 'TRANSIENT_LOCAL'
        assert (reader.start_time, reader.duration) == (0, 199 * SECOND + 1)
        assert reader.ros_distro == 'jazzy'


def test_mcap_validates_the_crcs_and_finds_the_index(bag):
    from mcap.reader import SeekingReader

    with (bag / 'bag_0.mcap').open('rb') as stream:
        reader = SeekingReader(stream, validate_crcs=True)
        summary = reader.get_summary()
        messages = list(reader.iter_messages())
        record = next(reader.iter_metadata())
    assert summary.statistics.message_count == len(messages) == 300
    assert summary.statistics.chunk_count == len(summary.chunk_indexes) > 10
    assert yaml.safe_load(record.metadata['serialized_metadata'])['message_count'] == 300
    assert messages[3][2].publish_time == messages[3][2].log_time - 1


def test_mcap_decodes_from_the_schemas_in_the_file(bag):
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory

    with (bag / 'bag_0.mcap').open('rb') as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        decoded = [m[3] for m in reader.iter_decoded_messages(topics=['/cmd_vel'])]
    assert [m.twist.angular.z for m in decoded] == [i / 3 for i in range(200)]
    assert decoded[0].header.frame_id == 'base_link'


def test_a_stream_reader_accepts_every_record_and_the_summary_crc(bag):
    from mcap.records import Chunk, Footer
    from mcap.stream_reader import StreamReader

    data = (bag / 'bag_0.mcap').read_bytes()
    with (bag / 'bag_0.mcap').open('rb') as stream:
        found = list(StreamReader(stream, emit_chunks=True, validate_crcs=True).records)
    footer = found[-1]
    assert isinstance(footer, Footer)
    assert zlib.crc32(data[footer.summary_start : -12]) == footer.summary_crc
    assert all(record.uncompressed_crc for record in found if isinstance(record, Chunk))


def test_a_chunk_is_written_when_its_messages_span_the_chunk_duration(tmp_path):
    with BagWriter(tmp_path / 'bag', chunk_duration=1.0) as writer:
        topic = writer.add_topic('/state', TEXT, **known(TEXT))
        file = tmp_path / 'bag' / 'bag_0.mcap'
        empty = file.stat().st_size
        writer.write(topic, 5 * SECOND, text(0))
        assert file.stat().st_size == empty
        writer.write(topic, 6 * SECOND, text(1))
        assert file.stat().st_size > empty


def test_flush_writes_what_is_there(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        topic = writer.add_topic('/state', TEXT, **known(TEXT))
        file = tmp_path / 'bag' / 'bag_0.mcap'
        empty = file.stat().st_size
        writer.write(topic, 0, text(0))
        writer.flush()
        assert file.stat().st_size > empty


def test_a_bag_without_messages_is_a_bag(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic('/state', TEXT, **known(TEXT))
    with Reader(tmp_path / 'bag') as reader:
        assert (reader.message_count, reader.duration) == (0, 0)


def test_what_was_written_before_an_error_is_kept(tmp_path):
    def fail():
        with BagWriter(tmp_path / 'bag') as writer:
            writer.write(writer.add_topic('/state', TEXT, **known(TEXT)), 0, text(0))
            raise KeyError

    with pytest.raises(KeyError):
        fail()
    with Reader(tmp_path / 'bag') as reader:
        assert reader.message_count == 1


def test_an_existing_folder_is_refused(tmp_path):
    with pytest.raises(SourceError, match='choose a new folder'):
        BagWriter(tmp_path)


def test_a_second_topic_of_the_same_name_is_refused(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        writer.add_topic('/state', TEXT, **known(TEXT))
        with pytest.raises(ConfigurationError, match='/state'):
            writer.add_topic('/state', TEXT, **known(TEXT))


@pytest.mark.parametrize('stamp', [-1, 2**64])
def test_a_stamp_that_fits_no_field_is_refused_and_the_bag_goes_on(tmp_path, stamp):
    with BagWriter(tmp_path / 'bag') as writer:
        topic = writer.add_topic('/state', TEXT, **known(TEXT))
        with pytest.raises(SignalError, match='2\\^64'):
            writer.write(topic, stamp, text(0))
        writer.write(topic, 1, text(1))
    with Reader(tmp_path / 'bag') as reader:
        assert [data for _, _, data in reader.messages()] == [text(1)]


@pytest.mark.parametrize(
    'options', [{'compression': 'gzip'}, {'chunk_size': 0}, {'chunk_duration': float('nan')}]
)
def test_an_option_out_of_range_is_refused(tmp_path, options):
    with pytest.raises(ConfigurationError, match=r'choose one of|must be positive'):
        BagWriter(tmp_path / 'bag', **options)


@pytest.mark.parametrize(
    ('size', 'span'),
    [(2000, 1e9), (1 << 20, 10.0), (1, 1.0), (30_000, 1e9), (1 << 20, 300.0), (1 << 20, 1e9)],
)
def test_several_messages_at_once_make_the_same_file(tmp_path, size, span):
    messages = [(i % 3 // 2, (i // 2 - i % 5) % 900 * SECOND, text(i)) for i in range(2000)]
    written = []
    for name in ('one', 'many'):
        folder = tmp_path / name / 'bag'
        with BagWriter(folder, chunk_size=size, chunk_duration=span) as writer:
            topics = [writer.add_topic(topic, TEXT, **known(TEXT)) for topic in ('/a', '/b')]
            rows = [(topics[topic], stamp, data) for topic, stamp, data in messages]
            if name == 'one':
                for row in rows:
                    writer.write(*row)
            else:
                for part in (rows[:7], rows[7:130], rows[130:950], rows[950:]):
                    writer.write_several(*zip(*part, strict=True))
        written.append((folder / 'bag_0.mcap').read_bytes())
    assert written[0] == written[1]


def test_several_messages_with_a_stamp_that_does_not_fit_are_refused(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        topic = writer.add_topic('/a', TEXT, **known(TEXT))
        with pytest.raises(SignalError, match='from -1 to 5'):
            writer.write_several([topic, topic], [5, -1], [text(0), text(1)])


def test_short_chunks_cost_no_look_at_all_the_messages_after_them():
    """Looked at for each chunk, a million messages in ten thousand chunks took minutes."""
    count = 100_000
    columns = Together([1] * count, range(count), [b''] * count)
    looked_at = []

    class Stamps:
        def __getitem__(self, part):
            looked_at.append(part.stop - part.start)
            return np.arange(part.start, part.stop, dtype=np.uint64)

    columns.stamps = Stamps()
    first = 0
    while first < count:
        first = columns.first_from(first, count, first + 99) + 1
    assert sum(looked_at) < 3 * count


def test_a_reader_that_goes_by_the_metadata_cannot_miss_the_file_that_a_kill_tore(tmp_path):
    """As after kill -9: nothing is closed. A split bag without its last file looked whole."""
    writer = BagWriter(tmp_path / 'bag')
    topic = writer.add_topic('/a', TEXT, **known(TEXT))
    for i in range(2):
        writer.write(topic, i, text(i))
        writer.flush()
        if i == 0:
            writer.split()
    with pytest.raises(ReaderError), Reader(tmp_path / 'bag'):
        pass
    with BagReader(tmp_path / 'bag') as bag:
        assert [message.stamp for message in bag.messages()] == [0, 1]
        assert bag.lossy
    writer.close()
    with Reader(tmp_path / 'bag') as reader:
        assert [stamp for _, stamp, _ in reader.messages()] == [0, 1]


def test_metadata_never_names_an_oldest_file_that_is_gone(tmp_path, monkeypatch):
    def end(*_, **__):
        raise KeyboardInterrupt

    with BagWriter(tmp_path / 'bag') as writer:
        topic = writer.add_topic('/a', TEXT, **known(TEXT))
        for i in range(3):
            writer.write(topic, i, text(i))
            if i < 2:
                writer.split()
        with monkeypatch.context() as patch:
            patch.setattr(Path, 'unlink', end)
            with pytest.raises(KeyboardInterrupt):
                writer.drop_oldest()
        description = yaml.safe_load((tmp_path / 'bag' / 'metadata.yaml').read_text())
    named = description['rosbag2_bagfile_information']['relative_file_paths']
    assert named == ['bag_1.mcap', 'bag_2.mcap']


def test_what_found_no_room_at_the_end_is_counted(tmp_path, monkeypatch):
    """Of three chunks of two messages the last two give way, and one message that waits."""
    writer = BagWriter(tmp_path / 'bag', chunk_size=60)
    topic = writer.add_topic('/a', 'a/msg/A', 'int8 x', type_hash='')
    for stamp in range(7):
        writer.write(topic, stamp, b'\0\1\0\0\1')
    full, close = [OSError(28, 'full')] * 2, writer._finished.close  # noqa: SLF001 - the disk
    flush = writer._file.flush  # noqa: SLF001

    def closing(file):
        if full:
            raise full.pop()
        close(file)

    def flushing():
        if full:
            raise full[0]
        flush()

    monkeypatch.setattr(writer._finished, 'close', closing)  # noqa: SLF001
    monkeypatch.setattr(writer._file, 'flush', flushing)  # noqa: SLF001
    with pytest.raises((OSError, SourceError), match='full'):
        writer.close()
    assert writer.discarded == 1 + 2 + 2
    with BagReader(tmp_path / 'bag') as bag:
        assert [message.stamp for message in bag.messages()] == [0, 1]
