"""Messages as objects that tell their fields as those of rclpy do."""

from __future__ import annotations

from pathlib import Path
from struct import pack

import pytest

from agv_motion.bag import BagReader, message_objects
from agv_motion.bag.mcap.writer import McapWriter
from agv_motion.bag.message_objects import decoded, decoder
from agv_motion.bag.metadata import Topic
from agv_motion.errors import ConfigurationError

DEFINITION = """bool on
byte raw
float32 small
float64[2] pair
int8[] many
string name
Inner inner
Inner[] more
Inner[3] three
=====
MSG: mine/Inner
float64 x
"""


@pytest.fixture
def bag(tmp_path):
    """A number each on /a at 5 and 7, on /b at 6; /c has a type without fields."""
    writer = McapWriter(tmp_path / 'x.mcap', '')
    for name, text in (('/a', 'int8 x'), ('/b', 'int8 y'), ('/c', DEFINITION)):
        writer.add_topic(Topic(name, f'mine/msg/{name[1:].upper()}', text, '', ()))
    for channel, stamp in ((1, 5), (2, 6), (1, 7)):
        writer.write(channel, stamp, b'\0\1\0\0' + pack('b', stamp), stamp, 0)
    writer.flush()
    writer.close({})
    with BagReader(writer.path) as reader:
        yield reader


def test_fields_are_told_in_the_words_of_ros(bag):
    kinds = decoder(bag.topics['/c'], Path('x')).store.types
    assert kinds['mine/msg/C'].get_fields_and_field_types() == {
        'on': 'boolean', 'raw': 'uint8', 'small': 'float', 'pair': 'double[2]',
        'many': 'sequence<int8>', 'name': 'string', 'inner': 'mine/Inner',
        'more': 'sequence<mine/Inner>', 'three': 'mine/Inner[3]',
    }  # fmt: skip
    assert kinds['mine/msg/Inner'].get_fields_and_field_types() == {'x': 'double'}
    empty = bag.topics['/c']._replace(definition='# nothing')
    assert decoder(empty, Path('x')).store.types['mine/msg/C'].get_fields_and_field_types() == {}


def test_messages_come_by_time_each_decoder_made_once(bag, monkeypatch):
    made, make = [], message_objects.MessageDecoder

    def counted(connection, path):
        made.append((connection.topic, path))
        return make(connection, path)

    monkeypatch.setattr(message_objects, 'MessageDecoder', counted)
    found = [(message.stamp, one) for message, one in decoded(bag, ['/a', '/b'])]
    assert [stamp for stamp, _ in found] == [5, 6, 7]
    assert (found[0][1].x, found[1][1].y, found[2][1].x) == (5, 6, 7)
    assert made == [('/a', bag.path), ('/b', bag.path)]
    assert [message.stamp for message, _ in decoded(bag, ['/a'], 6, 8)] == [7]
    assert list(decoded(bag, [])) == []
    with pytest.raises(ConfigurationError, match='/z'):
        list(decoded(bag, ['/z']))
