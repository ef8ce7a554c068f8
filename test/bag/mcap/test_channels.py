"""A topic as an MCAP file tells it."""

from __future__ import annotations

from agv_motion.bag.mcap.channels import from_channel
from agv_motion.bag.mcap.records import Channel, Schema
from agv_motion.bag.quality_of_service import OfferedQos, as_yaml

LATCHED = OfferedQos(durability='transient_local')


def test_channel_and_schema_together():
    notes = {'offered_qos_profiles': as_yaml([LATCHED]), 'topic_type_hash': 'RIHS01_1'}
    channel = Channel(1, 4, '/map', 'cdr', notes)
    found = from_channel(channel, {4: Schema(4, 'a/msg/A', 'ros2msg', b'int8 x # \xff')})
    assert found[:4] == ('/map', 'a/msg/A', 'int8 x # \udcff', 'ros2msg')
    assert (found.hash, found.qos, found.latched) == ('RIHS01_1', (LATCHED,), True)
    assert dict(found.notes) == notes


def test_what_is_missing_is_left_out():
    found = from_channel(Channel(1, 4, '/a', 'cdr', {}), {})
    assert found[:7] == ('/a', '', '', '', 'cdr', '', ())
    assert not found.latched
