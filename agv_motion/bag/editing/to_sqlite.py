"""Bags as one bag in sqlite3, for what reads no MCAP.

Such a file has no place for times of sending, numbers of messages, attachments and metadata. The
last two go into a file beside it, ``extras.mcap``, which this package reads again.
"""

from __future__ import annotations

import sqlite3
from heapq import merge
from itertools import chain
from operator import attrgetter
from typing import TYPE_CHECKING

from agv_motion.bag import metadata
from agv_motion.bag.bag_files import EXTRAS
from agv_motion.bag.cdr.message_type import declared
from agv_motion.bag.editing.blocks import blocks_ahead
from agv_motion.bag.editing.edited_bags import EditReport, extras, require_sound
from agv_motion.bag.editing.new_channels import topic_of
from agv_motion.bag.mcap.output import McapOutput
from agv_motion.bag.sqlite.file import LATEST
from agv_motion.bag.sqlite.writer import SqliteWriter
from agv_motion.errors import ConfigurationError, SignalError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from pathlib import Path

    from agv_motion.bag.connection import Connection, Message
    from agv_motion.bag.editing.edit import Edit
    from agv_motion.bag.reader import BagReader

_BLOCK = 1 << 21
"""[bytes] of messages that are handed over together"""


def edit_to_sqlite(
    bags: Sequence[BagReader],
    folder: Path,
    what: Edit,
    progress: Callable[[float], None] = lambda _: None,
) -> EditReport:
    """Make a bag in sqlite3; arguments and errors as of :func:`agv_motion.bag.editing.edit.edit`.

    Raises:
        ConfigurationError: A type is defined in two ways.
        SignalError: A time lies beyond what sqlite3 can hold, the year 2262.
        OSError: The disk takes no more.

    """
    require_sound(bags, whole=what.spans is None)
    folder.mkdir()
    writer = SqliteWriter(folder / f'{folder.name}_0.db3')
    try:
        made = _Tables(writer, bags, what)
        total = sum(bag.message_count for bag in bags) or 1
        for block in blocks_ahead(_messages(bags, what), _BLOCK):
            made.write(block)
            progress(min(made.messages / total, 1.0))
        told = made.described()
        writer.close(metadata.inside_mcap(told))
    except sqlite3.Error as error:
        raise OSError(str(error)) from error
    finally:
        writer.abandon()
    _keep(bags, folder)
    metadata.save(folder, told)
    return EditReport(made.messages, 0, 0, 1)


class _Tables:
    """The rows of the new file, and their numbers."""

    def __init__(self, writer: SqliteWriter, bags: Sequence[BagReader], what: Edit) -> None:
        self._writer = writer
        self._start, self._end = 2**64, 0
        connections = [
            connection
            for connection in dict.fromkeys(chain.from_iterable(bag.connections for bag in bags))
            if what.topics.takes(connection.topic)
        ]
        _require_one_definition(connections)
        topics: dict[tuple[str, ...], metadata.Topic] = {}
        for connection in connections:
            topic = topic_of(connection)
            known = topics.setdefault(_key(connection), topic)
            qos = tuple(dict.fromkeys((*known.qos, *topic.qos)))
            topics[_key(connection)] = known._replace(qos=qos)
        numbers = {key: writer.add_topic(topic) for key, topic in topics.items()}
        self._topics = {numbers[key]: topic for key, topic in topics.items()}
        self._counts = dict.fromkeys(self._topics, 0)
        self._ids = {connection: numbers[_key(connection)] for connection in connections}

    @property
    def messages(self) -> int:
        """Number of messages so far."""
        return sum(self._counts.values())

    def write(self, block: Sequence[Message]) -> None:
        """Append messages that are in the order of time."""
        first, last = block[0].stamp, block[-1].stamp
        if last > LATEST:
            msg = f'log time {last} ns: sqlite3 holds times up to {LATEST} ns, the year 2262'
            raise SignalError(msg)
        ids = [self._ids[message.connection] for message in block]
        self._writer.write((n, m.stamp, m.data) for n, m in zip(ids, block, strict=True))
        for number in ids:
            self._counts[number] += 1
        self._start, self._end = min(self._start, first), max(self._end, last)

    def described(self) -> str:
        """Return the metadata of the bag."""
        name = self._writer.path.name
        file = metadata.FileSummary(name, self._start, self._end, self.messages)
        topics = [(topic, self._counts[number]) for number, topic in self._topics.items()]
        return metadata.describe([file], topics, storage='sqlite3')


def _key(connection: Connection) -> tuple[str, ...]:
    """Return what makes connections one topic in the file."""
    return connection.topic, connection.type, connection.encoding


def _fields(connection: Connection) -> object:
    """Return the fields that a definition declares; its text where they cannot be understood."""
    try:
        return declared(connection.type, connection.definition, connection.definition_encoding)
    except ConfigurationError:
        return connection.definition


def _require_one_definition(connections: Iterable[Connection]) -> None:
    """Refuse types with several definitions: there is place for one, and all would be read by it.

    Raises:
        ConfigurationError: A type has.

    """
    known: dict[str, Connection] = {}
    for one in connections:
        other = known.setdefault(one.type, one)
        if one.definition and other.definition and _fields(one) != _fields(other):
            where = one.topic if one.topic == other.topic else f'{other.topic} and {one.topic}'
            msg = (
                f'{one.type} on {where} is defined in two ways, and sqlite3 holds one definition '
                'of a type: leave a topic out, or convert before the merge'
            )
            raise ConfigurationError(msg)


def _messages(bags: Sequence[BagReader], what: Edit) -> Iterator[Message]:
    for start, stop in what.spans or ((0, 2**64),):
        streams = [
            bag.messages([t for t in bag.topics if what.topics.takes(t)], start, stop)
            for bag in bags
        ]
        yield from streams[0] if len(streams) == 1 else merge(*streams, key=attrgetter('stamp'))


def _keep(bags: Sequence[BagReader], folder: Path) -> None:
    """Write attachments and named strings into a file of their own, if there are any."""
    file = None
    for extra in extras(bags):
        file = file or McapOutput(folder / EXTRAS)
        file.keep(extra)
    if file is not None:
        file.close({}, sync=False)
