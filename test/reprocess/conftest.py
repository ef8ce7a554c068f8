"""Bags that are those of a recording but for something."""

from __future__ import annotations

import pytest


@pytest.fixture(scope='session')
def copied():
    """Return what writes a bag again, message by message as its last argument has it."""
    from agv_motion.bag.reader import BagReader
    from agv_motion.bag.writer import BagWriter

    def copy(source, target, change):
        with BagReader(source) as bag, BagWriter(target) as writer:
            topics = {}
            for message in bag.messages():
                for topic, stamp, data, kind in change(message):
                    if topic not in topics:
                        topics[topic] = writer.add_topic(topic, kind)
                    writer.write(topics[topic], stamp, data)
        return target

    return copy
