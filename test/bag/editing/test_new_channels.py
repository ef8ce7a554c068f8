"""Ids of channels in a new file."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from agv_motion.bag.connection import Connection
from agv_motion.bag.editing.new_channels import NewChannels
from agv_motion.bag.mcap.records import Channel, Schema
from agv_motion.errors import ConfigurationError


def file(channels, schemas=((1, 'a/msg/A'),)):
    """Return a file as far as it matters here: ids, types and topics."""
    summary = SimpleNamespace(
        schemas={n: Schema(n, name, 'ros2msg', b'int8 x') for n, name in schemas},
        channels={n: Channel(n, s, topic, 'cdr', {}) for n, s, topic in channels},
    )
    return SimpleNamespace(as_chunks=lambda: SimpleNamespace(summary=summary), channels={})


def test_the_channels_of_a_file_keep_their_ids():
    new = NewChannels()
    ids, foreign = new.add(file([(7, 1, '/a'), (3, 1, '/b'), (9, 0, '/raw')]), [7, 9])
    assert (ids, foreign) == ({7: 7, 9: 9}, frozenset())
    assert set(new.channels) == {7, 9}
    assert new.channels[9].schema_id == 0


@pytest.mark.parametrize(
    ('name', 'definition', 'schema'), [('a/msg/A', '', 4), ('', 'int8 x', 4), ('', '', 0)]
)
def test_a_channel_of_sqlite3_has_a_type_where_a_name_or_a_definition_is_told(
    name, definition, schema
):
    told = Connection('/a', name, definition, '', 'cdr', '', ())
    new = NewChannels()
    new.add(SimpleNamespace(as_chunks=lambda: None, channels={4: told}), [4])
    assert new.channels[4].schema_id == schema
    assert [s.name for s in new.schemas.values()] == ([name] if schema else [])


def test_channels_alike_become_one_and_others_take_the_next_free_id():
    new = NewChannels()
    new.add(file([(0, 1, '/a'), (1, 1, '/b')]), [0, 1])
    ids, foreign = new.add(file([(0, 1, '/b'), (1, 1, '/c'), (5, 1, '/d')]), [0, 1, 5])
    assert ids == {0: 1, 1: 2, 5: 5}
    assert foreign == {0, 1}
    assert [new.channels[n].topic for n in (0, 1, 2, 5)] == ['/a', '/b', '/c', '/d']


def test_two_channels_of_one_file_stay_two_though_they_are_alike():
    ids, _ = NewChannels().add(file([(1, 1, '/a'), (2, 1, '/a')]), [1, 2])
    assert ids == {1: 1, 2: 2}


def test_types_are_told_apart_and_a_channel_whose_type_has_another_id_is_foreign():
    new = NewChannels()
    new.add(file([(1, 1, '/a')]), [1])
    ids, foreign = new.add(file([(2, 1, '/b')], [(1, 'b/msg/B')]), [2])
    assert (ids, foreign) == ({2: 2}, {2})
    assert new.schemas[new.channels[2].schema_id].name == 'b/msg/B'


def test_more_than_a_file_can_have_is_refused():
    many = file([(n, 0, f'/{n}') for n in range(1 << 16)])
    new = NewChannels()
    new.add(many, range(1 << 16))
    with pytest.raises(ConfigurationError, match='filter the bags before'):
        new.add(file([(1, 0, '/more')]), [1])


def test_of_several_channels_alike_the_first_is_taken():
    new = NewChannels()
    new.add(file([(2, 1, '/a'), (1, 1, '/a')]), [1, 2])
    assert new.add(file([(5, 1, '/a')]), [5]) == ({5: 1}, {5})
    assert new.add(file([(2, 1, '/a')]), [2]) == ({2: 2}, frozenset())
