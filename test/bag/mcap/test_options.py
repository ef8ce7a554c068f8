"""Files that the writer of the MCAP project makes, every option on and off, are read as it does."""

from __future__ import annotations

import io
from dataclasses import astuple
from struct import pack

from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import NonSeekingReader, make_reader
from mcap.writer import CompressionType, IndexType, Writer

from agv_motion.bag.checks.stamps import stamps
from agv_motion.bag.columns.columns import read_topic
from agv_motion.bag.editing.recovery import Recovery
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter

LATEST = 2**64 - 1
TIMES = st.one_of(st.integers(0, 40), st.integers(0, LATEST), st.just(LATEST))
MESSAGES = st.lists(
    st.tuples(st.integers(0, 3), TIMES, TIMES, st.integers(0, 2**32 - 1), st.binary(max_size=80)),
    min_size=1,  # of a file without messages mcap's reader does not find the schemas
    max_size=30,
)
OPTIONS = st.fixed_dictionaries(
    {
        'chunk_size': st.sampled_from([1, 90, 300, 1 << 20]),
        'compression': st.sampled_from(list(CompressionType)),
        'index_types': st.integers(0, IndexType.ALL.value).map(IndexType),
        **dict.fromkeys(
            (
                *('repeat_channels', 'repeat_schemas', 'use_chunking', 'use_statistics'),
                *('use_summary_offsets', 'enable_crcs', 'enable_data_crcs'),
            ),
            st.booleans(),
        ),
    }
)


def written(options, messages):
    """Return the bytes of a file: four channels, one without schema and one of an odd encoding."""
    stream = io.BytesIO()
    writer = Writer(stream, **options)
    writer.start('ros2', 'test')
    schema = writer.register_schema('std_msgs/msg/UInt32', 'ros2msg', b'uint32 data')
    other = writer.register_schema('Odd', 'protobuf', b'\xff\0\x80')
    channels = [
        writer.register_channel('/a', 'cdr', schema, {'offered_qos_profiles': ''}),
        writer.register_channel('/b', 'cdr', schema),
        writer.register_channel('/c', 'protobuf', other, {'why': 'so'}),
        writer.register_channel('/d', 'text', 0),
    ]
    for number, (channel, stamp, publish, sequence, data) in enumerate(messages):
        content = b'\0\1\0\0' + pack('<I', sequence) if channel < 2 else data
        writer.add_message(channels[channel], stamp, content, publish, sequence)
        if number == 3:
            writer.add_attachment(1, 2, 'calib', 'text/plain', b'k')
            writer.add_metadata('site', {'tree': 'oak'})
    writer.finish()
    return stream.getvalue()


def by_mcap(data):
    """Return what mcap's reader finds, in the order of time and then of the file."""
    reader = NonSeekingReader(io.BytesIO(data))
    found = [
        (
            *(m.log_time, m.publish_time, m.sequence, m.data),
            *(c.topic, c.message_encoding, s.name if s else '', s.encoding if s else ''),
            s.data if s else b'',
        )
        for s, c, m in reader.iter_messages(log_time_order=False)
    ]
    return sorted(found, key=lambda message: message[0])


def by_ours(path):
    """Return what our reader finds, after a look whether columns and stamps say the same."""
    with BagReader(path) as bag:
        found = [
            (
                *(m.stamp, m.publish, m.sequence, m.data),
                *(m.connection.topic, m.connection.encoding, m.connection.type),
                m.connection.definition_encoding,
                m.connection.definition.encode(errors='surrogateescape'),
            )
            for m in bag.messages()
        ]
        assert not bag.problems, bag.problems
        assert bag.message_count == len(found)
        assert (bag.start, bag.end) == ((found[0][0], found[-1][0]) if found else (0, 0))
        for topic, encoding in {m[4]: m[5] for m in found}.items():
            mine = [m for m in found if m[4] == topic]
            assert sorted(stamps(bag, [topic])[topic].tolist()) == [m[0] for m in mine]
            if encoding == 'cdr':
                columns = read_topic(bag, topic)
                assert columns.stamps.tolist() == [m[0] for m in mine]
                assert columns.fields['data'].tolist() == [m[2] for m in mine]
        middle = found[len(found) // 2][0]
        assert [m.stamp for m in bag.messages(stop=middle)] == [
            m[0] for m in found if m[0] < middle
        ]
        later = [m[3] for m in found if m[0] >= middle]
        assert [m.data for m in bag.messages(start=middle)] == later
    return found


@settings(max_examples=25, deadline=None)
@given(OPTIONS, MESSAGES)
def test_read_and_recovered_as_the_writer_of_mcap_wrote_it(tmp_path_factory, options, messages):
    folder = tmp_path_factory.mktemp('options')
    data = written(options, messages)
    (folder / 'a.mcap').write_bytes(data)
    expected = by_mcap(data)
    assert by_ours(folder / 'a.mcap') == expected
    with BagWriter(folder / 'saved') as writer:
        recovery = Recovery(writer)
        recovery.save(folder / 'a.mcap')
    assert (recovery.messages, recovery.missing, recovery.problems) == (len(expected), 0, [])
    assert by_ours(folder / 'saved') == expected
    (saved,) = (folder / 'saved').glob('*.mcap')
    with saved.open('rb') as stream:
        reader = make_reader(stream, validate_crcs=True)
        assert len(list(reader.iter_messages())) == len(expected)
        kept = [astuple(one)[2:] for one in reader.iter_attachments()]
        notes = {one.name: one.metadata for one in reader.iter_metadata() if one.name != 'rosbag2'}
    attachments = NonSeekingReader(io.BytesIO(data)).iter_attachments()
    metadata = NonSeekingReader(io.BytesIO(data)).iter_metadata()
    assert kept == [astuple(one)[2:] for one in attachments]
    assert notes == {one.name: one.metadata for one in metadata}
