"""A bag of ten seconds: a counter ten times a second, and a description that is latched."""

from __future__ import annotations

import struct

import pytest

from agv_motion.bag import BagWriter, OfferedQos

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND


def text(words):
    data = words.encode() + b'\0'
    return b'\0\1\0\0' + struct.pack('<I', len(data)) + data


@pytest.fixture(scope='session')
def counted(tmp_path_factory):
    """Return the path of the bag."""
    path = tmp_path_factory.mktemp('bags') / 'counted'
    with BagWriter(path) as bag:
        latched = bag.add_topic(
            '/description', 'std_msgs/msg/String', qos=[OfferedQos(durability='transient_local')]
        )
        count = bag.add_topic('/count', 'std_msgs/msg/String')
        bag.write(latched, BEGIN, text('urdf'))
        for number in range(1, 101):
            bag.write(count, BEGIN + number * SECOND // 10, text(str(number)))
    return path
