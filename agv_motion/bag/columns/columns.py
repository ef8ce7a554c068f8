"""Topics of a bag straight into numpy columns, without a Python object for every message.

with BagReader('bag') as bag:
    odometry = read_topic(bag, '/odom', ['pose.pose.position', 'header.stamp'])
    plot(odometry.seconds('header.stamp'), odometry.fields['pose.pose.position.x'])

Seconds count from the first message of the bag, so those of several topics fit together.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.columns import tables
from agv_motion.bag.columns.column import Column, Ragged, Texts
from agv_motion.bag.columns.message_batches import joined
from agv_motion.bag.columns.topic_decoder import TopicDecoder
from agv_motion.bag.request import listed, span_of, whole
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from typing import TypeGuard

    from numpy.typing import NDArray
    from pandas import DataFrame
    from pyarrow import Table

    from agv_motion.bag.cdr.layout import Leaf
    from agv_motion.bag.columns.batch import Batch
    from agv_motion.bag.connection import Connection, Message
    from agv_motion.bag.reader import BagReader
    from agv_motion.bag.storage import Storage


class Columns(NamedTuple):
    """All messages of a topic, by the order of their log time."""

    connection: Connection
    stamps: NDArray[np.int64]
    """[ns] log time of each message; uint64 where one lies beyond the year 2262"""
    fields: dict[str, Column]
    """values of each field by its path, such as ``pose.position.x``: an array of shape (messages,
    ...), :class:`Texts`, or :class:`Ragged` where the length of a sequence changes; what is the
    same in all messages is in memory once, and read-only"""
    start: int = 0
    """[ns] log time of the first message of the bag, whatever its topic"""

    def __repr__(self) -> str:
        """Return one line."""
        count, fields = len(self.stamps), len(self.fields)
        return f'{self.connection.topic} ({self.connection.type}): {count} x {fields} fields'

    def nanoseconds(self, field: str) -> NDArray[np.int64]:
        """Return a ``builtin_interfaces/Time`` such as ``header.stamp`` [ns].

        Raises:
            ConfigurationError: The field is no such time, or was not read.

        """
        sec, nanosec = self.fields.get(f'{field}.sec'), self.fields.get(f'{field}.nanosec')
        if not (_whole(sec) and _whole(nanosec)):
            kind, topic = self.connection.type, self.connection.topic
            msg = f'{kind} on {topic}: {field} was not read, or is no time of sec and nanosec'
            raise ConfigurationError(msg)
        times: NDArray[np.int64] = sec.astype(np.int64) * 1_000_000_000 + nanosec.astype(np.int64)
        return times

    def seconds(self, field: str = '', since: int | None = None) -> NDArray[np.float64]:
        """Return a time of every message, by default its log time, since the bag began [s].

        Args:
            field: A ``builtin_interfaces/Time`` such as ``header.stamp``; empty: the log time.
            since: [ns] another instant to count from, such as ``columns.stamps[0]``, the first
                message of this topic; None means the first message of the bag.

        Raises:
            ConfigurationError: The field is no such time, or was not read.

        """
        times = self.nanoseconds(field) if field else self.stamps
        if not len(times):
            return np.empty(0)
        first = int(times[0]) - (self.start if since is None else whole('since', since))
        # from the first one, since differences of large numbers would be rounded
        passed: NDArray[np.float64] = (times - times[0]).astype(np.float64) * 1e-9
        return passed + first * 1e-9

    def to_pandas(self) -> DataFrame:
        """Return a DataFrame: a row a message by its log time (UTC), a column a field.

        A cell of an array or sequence holds its numpy array, that of texts a list.

        Raises:
            ConfigurationError: pandas is not installed.

        """
        return tables.to_pandas(self.stamps, self.fields)

    def to_arrow(self) -> Table:
        """Return an Arrow table: `log_time` (UTC), and a column a field, arrays as lists.

        Raises:
            ConfigurationError: pyarrow is not installed.

        """
        return tables.to_arrow(self.stamps, self.fields)


def _whole(column: Column | None) -> TypeGuard[NDArray[Any]]:
    """Return whether a column holds one whole number of every message."""
    return isinstance(column, np.ndarray) and column.dtype.kind in 'iu' and column.ndim == 1


def read_topic(
    bag: BagReader,
    topic: str,
    fields: Iterable[str] | None = None,
    start: int | None = None,
    stop: int | None = None,
) -> Columns:
    """Return the columns of one topic; arguments and errors as of :func:`read_topics`."""
    return read_topics(bag, {topic: fields}, start, stop)[topic]


def read_topics(
    bag: BagReader,
    topics: Iterable[str] | Mapping[str, Iterable[str] | None] | None = None,
    start: int | None = None,
    stop: int | None = None,
) -> dict[str, Columns]:
    """Return the columns of some topics, read in one go.

    Args:
        bag: The bag.
        topics: Names, or one, or names with the paths of the wanted fields (a path, or several,
            each for all that is in it); None means everything.
        start: [ns] first log time; None means the beginning.
        stop: [ns] log time before which to stop; None means never.

    Raises:
        ConfigurationError: A topic or a field is not there, or its type cannot be understood.
        DamagedBagError: The bag is damaged.

    """
    if topics is None:
        topics = list(bag.topics)
    wanted = dict(topics) if isinstance(topics, Mapping) else dict.fromkeys(listed(topics))
    bag.require(wanted)
    span = span_of(start, stop)
    expected = _expected(bag, frozenset(wanted), *span)
    decoders = {
        topic: _decoder(bag, topic, fields if fields is None else listed(fields), expected[topic])
        for topic, fields in wanted.items()
    }
    for file in bag.files:
        chosen = {n: decoders[c.topic] for n, c in file.channels.items() if c.topic in decoders}
        if chosen:
            _read_file(bag, file, chosen, *span)
    return {topic: _columns(decoder, bag.start) for topic, decoder in decoders.items()}


def columns_of(
    connection: Connection, fields: Iterable[str] | None, messages: Sequence[Message]
) -> Columns:
    """Return the columns of messages that are in memory, in the order of their log time.

    Raises:
        ConfigurationError: The type cannot be understood, or a field is not there.
        DamagedBagError: A message is not of its type.

    """
    decoder = TopicDecoder(connection, fields, len(messages), sum(len(m.data) for m in messages))
    if messages:
        decoder.put(joined(0, messages, Path(connection.topic)))
    return _columns(decoder, messages[0].stamp if messages else 0)


def _decoder(
    bag: BagReader, topic: str, fields: Iterable[str] | None, expected: tuple[int, int]
) -> TopicDecoder:
    try:
        return TopicDecoder(_connection(bag, topic), fields, *expected)
    except ConfigurationError as error:
        msg = f'bag {bag.path}, topic {topic}: {error}'
        raise ConfigurationError(msg) from error


def _connection(bag: BagReader, topic: str) -> Connection:
    """Return the only connection of a topic."""
    found = {(c.type, c.definition) for c in bag.connections if c.topic == topic}
    if len(found) > 1:
        types = ' and '.join(sorted(kind for kind, _ in found))
        msg = f'its type changed ({types}): agv bag check tells more'
        raise ConfigurationError(msg)
    return bag.topics[topic]


def _read_file(
    bag: BagReader, file: Storage, decoders: Mapping[int, TopicDecoder], start: int, stop: int
) -> None:
    """Decode the messages of a file; ``decoders`` are those of the wanted channels."""

    def put(part: Batch) -> None:
        decoders[part.channel].put(part)

    file.batches(decoders.keys(), start, stop, put, compressed=bag.messages_compressed)


def _expected(
    bag: BagReader, topics: frozenset[str], start: int, stop: int
) -> dict[str, tuple[int, int]]:
    """Return for each topic the messages and the bytes to expect at most, 0 where unknown."""
    rows, sizes = dict.fromkeys(topics, 0), 0
    for file in bag.files:
        for channel, count in file.expected(start, stop).items():
            if channel in file.channels and file.channels[channel].topic in topics:
                rows[file.channels[channel].topic] += count
        sizes += file.unpacked_size
    return {topic: (count, sizes) for topic, count in rows.items()}


def _columns(decoder: TopicDecoder, start: int) -> Columns:
    """Return what a decoder has read, in the order of time; the bag begins at ``start`` [ns]."""
    stamps: NDArray[Any] = decoder.stamps.finish()
    if len(stamps) and stamps.min() < 0:  # they wrapped: MCAP has 64 bits without a sign
        stamps = stamps.view(np.uint64)
    order = None
    if (stamps[1:] < stamps[:-1]).any():
        order = np.argsort(stamps, kind='stable')
        stamps = stamps[order]
    lengths: dict[int, NDArray[Any]] = {}
    fields: dict[str, Column] = {}
    for leaf in decoder.leaves:
        values, counts = decoder.builders.pop(leaf.number).finish()
        if order is not None:
            values, counts = _ordered(values, counts, order)
        if leaf.type == 'length':
            lengths[leaf.number] = values.ravel()
        else:
            fields[leaf.path] = _column(decoder, leaf, values, lengths, len(stamps))
    return Columns(decoder.connection, stamps, fields, start)


def _ordered(
    values: NDArray[Any], counts: int | NDArray[np.int64], order: NDArray[np.intp]
) -> tuple[NDArray[Any], int | NDArray[np.int64]]:
    """Return rows in another order."""
    if isinstance(counts, int):
        return values[order] if values.strides[0] else values, counts
    starts = np.cumsum(counts) - counts
    counts = counts[order]
    ends = np.cumsum(counts)
    places = np.repeat(starts[order] - (ends - counts), counts) + np.arange(len(values))
    return values[places], counts


def _column(
    decoder: TopicDecoder,
    leaf: Leaf,
    values: NDArray[Any],
    lengths: dict[int, NDArray[Any]],
    rows: int,
) -> Column:
    """Return values in the shape of the arrays around them."""
    numbers = iter(leaf.lengths)
    sizes = [_length(lengths[next(numbers)]) if size is None else size for size in leaf.dimensions]

    def flat(*shape: int) -> Column:
        table = values.reshape(shape)
        texts = decoder.texts.get(leaf.number)
        return Texts(table, texts.values) if texts else table

    column: Column | None = None
    inner: list[int] = []
    for size in reversed(sizes):
        if not isinstance(size, int):
            offsets = np.concatenate([[0], np.cumsum(size, dtype=np.int64)])
            column = Ragged(flat(int(offsets[-1]), *inner) if column is None else column, offsets)
        elif column is None:
            inner.insert(0, size)
        else:
            column = Ragged(column, np.arange(0, len(column) + 1, size))
    return flat(rows, *inner) if column is None else column


def _length(lengths: NDArray[Any]) -> int | NDArray[Any]:
    """Return the length that all sequences have, or that of each."""
    if not len(lengths):
        return 0
    first = int(lengths[0])
    return first if (lengths == first).all() else lengths
