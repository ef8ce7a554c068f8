"""Files and metadata of a bag that is made of chunks."""

from __future__ import annotations

import yaml

from agv_motion.bag import BagReader
from agv_motion.bag.editing.new_bag import NewBag
from agv_motion.bag.editing.new_channels import NewChannels
from agv_motion.bag.mcap.output import NewChunk
from agv_motion.bag.mcap.records import MESSAGE_HEAD, Channel, Schema


def chunk(channel, stamp):
    content = MESSAGE_HEAD.pack(5, 22 + 4, channel, 0, stamp, stamp) + b'\0\1\0\0'
    entry = stamp.to_bytes(8, 'little') + bytes(8)
    return NewChunk((stamp, stamp), len(content), 0, '', content, {channel: entry})


def test_every_file_describes_all_channels_and_an_empty_one_is_not_left(tmp_path):
    channels = NewChannels()
    channels.schemas = {1: Schema(1, 'a/msg/A', 'ros2msg', b'int8 x')}
    channels.channels = {n: Channel(n, 1, '/a', 'cdr', {'n': str(n)}) for n in (1, 2)}
    new = NewBag(tmp_path / 'bag', channels, 'odd')
    new.next_file()
    for stamp in (5, 9):
        new.put(chunk(stamp % 2 + 1, stamp))
        new.next_file()
    assert new.file_count == 3
    new.close()
    assert (new.messages, new.file_count) == (2, 2)
    told = yaml.safe_load((tmp_path / 'bag' / 'metadata.yaml').read_text())
    told = told['rosbag2_bagfile_information']
    assert told['relative_file_paths'] == ['bag_0.mcap', 'bag_1.mcap']
    assert [t['message_count'] for t in told['topics_with_message_count']] == [2]
    with BagReader(tmp_path / 'bag') as bag:
        assert [m.stamp for m in bag.messages()] == [5, 9]
        assert (bag.problems, len(bag.connections)) == ([], 2)
    assert b'\x03\0\0\0odd' in (tmp_path / 'bag' / 'bag_1.mcap').read_bytes()[:40]


def test_an_empty_bag_has_one_file(tmp_path):
    NewBag(tmp_path / 'bag', NewChannels()).close()
    with BagReader(tmp_path / 'bag') as bag:
        assert (bag.message_count, len(bag.files), bag.problems) == (0, 1, [])
