"""Small bags for the tests of edits, and what independent readers find in the results."""

from __future__ import annotations

from mcap.reader import make_reader
from mcap.stream_reader import StreamReader
from rosbags.rosbag2 import Reader

from agv_motion.bag import BagReader, BagWriter, OfferedQos
from agv_motion.bag.mcap.records import Attachment, Metadata

SECOND = 10**9
LATCHED = (OfferedQos(durability='transient_local', depth=1),)
TEXT = 'std_msgs/msg/String'


def text(word):
    data = word.encode() + b'\0'
    return b'\0\1\0\0' + len(data).to_bytes(4, 'little') + data


def write(folder, *, count=40, topics=('/a', '/b', '/c'), compression='zstd', **others):
    """Write messages of some topics in turn, ten a second, and a latched map before them."""
    start, extras = others.get('start', 100), others.get('extras', True)
    with BagWriter(folder, compression=compression, chunk_size=300) as bag:
        handles = [bag.add_topic(name, TEXT, 'string data', type_hash='') for name in topics]
        latched = bag.add_topic('/map', TEXT, 'string data', type_hash='', qos=LATCHED)
        bag.write(latched, start * SECOND, text('map'), 7, 1)
        for i in range(count):
            stamp = start * SECOND + i * SECOND // 10
            bag.write(handles[i % len(handles)], stamp, text(f'word {i}'), stamp - 5, i + 1)
        if extras:
            bag.keep(Attachment(1, 2, 'calibration.yaml', 'text/yaml', b'turret: 1\n'))
            bag.keep(Metadata('site', {'wood': 'spruce'}))
    return folder


def told(path, *, topics=None):
    """Return all messages of a bag by our reader, in order."""
    with BagReader(path) as bag:
        assert [str(p) for p in bag.problems] == []
        return [
            (m.connection.topic, m.stamp, m.publish, m.sequence, m.data)
            for m in bag.messages(topics)
        ]


def judged(path):
    """Return all messages by mcap's reader, after rosbags' reader and all CRCs agreed."""
    found = []
    for file in sorted(path.glob('*.mcap')):
        with file.open('rb') as stream:
            assert list(StreamReader(stream, emit_chunks=True, validate_crcs=True).records)
        with file.open('rb') as stream:
            reader = make_reader(stream, validate_crcs=True)
            here = [
                (channel.topic, m.log_time, m.publish_time, m.sequence, m.data)
                for _, channel, m in reader.iter_messages()
            ]
            assert reader.get_summary().statistics.message_count == len(here)
            found += here
    with Reader(path) as bag:
        assert bag.message_count == len(found)
        assert sum(c.msgcount for c in bag.connections) == len(found)
        assert len(list(bag.messages())) == len(found)
    return found


def extras(path):
    """Return attachments and metadata of a bag by mcap's reader, without rosbag2's own."""
    found = []
    for file in sorted(path.glob('*.mcap')):
        with file.open('rb') as stream:
            reader = make_reader(stream)
            found += [(a.name, a.data) for a in reader.iter_attachments()]
            found += [(m.name, m.metadata) for m in reader.iter_metadata() if m.name != 'rosbag2']
    return found


EXTRAS = [('calibration.yaml', b'turret: 1\n'), ('site', {'wood': 'spruce'})]
