"""What the summary of a file says is believed only where it agrees with itself."""

from __future__ import annotations

from struct import pack_into

import pytest

from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.record_parsing import walk
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter

MESSAGES_OF_A_CHANNEL = 48
"""[bytes] from the beginning of the statistics"""


@pytest.mark.parametrize('wrong', [0, 7, 13, 2**64 - 1])
def test_counts_of_the_topics_that_do_not_sum_up_are_counted_anew(tmp_path, wrong):
    with BagWriter(tmp_path / 'bag') as writer:
        topics = [writer.add_topic(n, 'a/msg/A', 'int8 x', type_hash='') for n in ('/a', '/b')]
        for i in range(24):
            writer.write(topics[i % 2], i, b'\0\1\0\0\1')
    (file,) = (tmp_path / 'bag').glob('*.mcap')
    data = bytearray(file.read_bytes())
    places = walk(data, len(records.MAGIC), len(data))
    (at,) = [at for opcode, at, _ in places if opcode == records.STATISTICS]
    pack_into('<Q', data, at + MESSAGES_OF_A_CHANNEL, wrong)
    end = len(data) - len(records.MAGIC)
    data[end - 4 : end] = bytes(4)  # as if nobody had computed a CRC
    file.write_bytes(data)
    with BagReader(file) as bag:
        assert bag.counts == {'/a': 12, '/b': 12}
        assert bag.message_count == len(list(bag.messages())) == 24
