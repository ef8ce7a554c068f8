"""The channels of several files in one new file: which ids they get there."""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.mcap.writer import channel_of, schema_of
from agv_motion.bag.metadata import Topic
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from agv_motion.bag.connection import Connection
    from agv_motion.bag.mcap.records import Channel, Schema
    from agv_motion.bag.storage import Storage

_MOST = 1 << 16


class NewIds(NamedTuple):
    """What becomes of the channels of a file."""

    ids: Mapping[int, int]
    """of each wanted channel its id in the new file"""
    foreign: frozenset[int]
    """those that are described in other words there"""


class NewChannels:
    """Gives every channel an id: its own where that is free, so that chunks can be copied whole.

    Channels of two files that are described alike become one.
    """

    def __init__(self) -> None:
        """Begin with none."""
        self.schemas: dict[int, Schema] = {}
        self.channels: dict[int, Channel] = {}

    def add(self, file: Storage, wanted: Collection[int]) -> NewIds:
        """Return which ids some channels of a file get.

        Raises:
            ConfigurationError: There are more channels than a file can have.

        """
        schemas, channels = _described(file)
        before = dict(self.channels)
        ids, foreign = {}, set()
        for number in sorted(wanted):
            channel = channels[number]
            schema = schemas.get(channel.schema_id)
            new = channel._replace(schema_id=self._schema(schema) if schema else 0)
            ids[number] = self._channel(new, before)
            if self.channels[ids[number]] != channel:
                foreign.add(number)
        return NewIds(ids, frozenset(foreign))

    def _schema(self, schema: Schema) -> int:
        alike = {n for n, other in self.schemas.items() if other[1:] == schema[1:]}
        if schema.id in alike:
            return schema.id
        if alike:
            return min(alike)
        number = _own_or_free(schema.id, self.schemas, 1)
        self.schemas[number] = schema._replace(id=number)
        return number

    def _channel(self, channel: Channel, before: Mapping[int, Channel]) -> int:
        """Return the id of a channel: that of an equal one of a file before, or its own."""
        alike = {n for n, other in before.items() if other[1:] == channel[1:]}
        if alike:
            return channel.id if channel.id in alike else min(alike)
        number = _own_or_free(channel.id, self.channels, 0)
        self.channels[number] = channel._replace(id=number)
        return number


def topic_of(connection: Connection) -> Topic:
    """Return a topic of a bag as a new bag is told of it."""
    foreign = connection.encoding != 'cdr'
    return Topic(
        connection.topic,
        connection.type,
        connection.definition,
        connection.hash,
        connection.qos,
        connection.definition_encoding or ('' if foreign else 'ros2msg'),
        connection.encoding,
        connection.notes,
    )


def _described(file: Storage) -> tuple[Mapping[int, Schema], Mapping[int, Channel]]:
    """Return types and channels of a file as records, though it may be none of MCAP."""
    chunks = file.as_chunks()
    if chunks is not None:
        return chunks.summary.schemas, chunks.summary.channels
    schemas, channels = {}, {}
    for number, connection in file.channels.items():
        topic = topic_of(connection)
        has_type = bool(topic.type or topic.definition)
        if has_type:
            schemas[number] = schema_of(topic, number)
        channels[number] = channel_of(topic, number, number if has_type else 0)
    return schemas, channels


def _own_or_free(own: int, taken: Collection[int], first: int) -> int:
    """Return an id that is not taken: the own one if that can be, else the first from ``first``."""
    if first <= own < _MOST and own not in taken:
        return own
    number = next(n for n in count(first) if n not in taken)
    if number >= _MOST:
        msg = f'more than {_MOST - first} channels, or types, in one file: filter the bags before'
        raise ConfigurationError(msg)
    return number
