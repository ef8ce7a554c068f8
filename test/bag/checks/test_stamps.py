"""When messages were received, topic by topic, in the order of the file."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.bag.checks.stamps import stamps
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError

BYTE = b'\x00\x01\x00\x00\x07'


@pytest.fixture
def bag(tmp_path):
    with BagWriter(tmp_path / 'bag') as writer:
        topics = [writer.add_topic(name, 'std_msgs/msg/Byte') for name in ('/a', '/b', '/none')]
        for stamp, topic in ((30, 0), (0, 0), (20, 1), (2**63 + 5, 1)):
            writer.write(topics[topic], stamp, BYTE)
    with BagReader(tmp_path / 'bag') as reader:
        yield reader


def test_each_topic_by_itself_as_it_was_written(bag):
    found = stamps(bag)
    assert found['/a'].tolist() == [30, 0]
    assert found['/b'].tolist() == [20, 2**63 + 5]  # later than int64 tells
    assert found['/b'].dtype == np.uint64
    assert found['/a'].dtype == np.int64
    assert found['/none'].tolist() == []
    assert list(stamps(bag, '/b')) == list(stamps(bag, ['/b'])) == ['/b']


def test_a_topic_that_is_not_there_is_refused(bag):
    with pytest.raises(ConfigurationError, match='/c'):
        stamps(bag, ['/a', '/c'])
