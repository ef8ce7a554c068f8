"""Compare two bags topic by topic: what is missing, what differs, by how much and since when.

The messages of a topic are paired by time or by place (`agv_motion.bag.editing.pairing`). Numbers
may differ by a tolerance, times by one of their own; everything else must be equal. Numbers are
compared as Python's, whose integers know no largest: 127 and -1 in int8 are 128 apart.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf, isfinite, isnan
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.cdr.message_decoder import MessageDecoder
from agv_motion.bag.editing.pairing import Pairing, pairs
from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.bag.connection import Connection, Message
    from agv_motion.bag.reader import BagReader

TIMES = 'builtin_interfaces/msg/Time', 'builtin_interfaces/msg/Duration'
BY_STAMP = Pairing()


class Tolerance(NamedTuple):
    """Numbers a and b count as equal if ``|a - b| <= absolute + relative * max(|a|, |b|)``."""

    absolute: float = 0.0
    relative: float = 0.0


class Difference(NamedTuple):
    """The numbers of one field that lie furthest apart, or values that are not equal."""

    path: str
    """such as ``twist.linear.x`` or ``position[2]``"""
    stamp: int
    """[ns] log time in the first bag"""
    first: Any
    second: Any


@dataclass
class TopicDiff:
    """What sets one topic of two bags apart."""

    topic: str
    counts: tuple[int, int]
    """messages in each bag"""
    compared: int = 0
    differing: int = 0
    """pairs of messages that differ beyond the tolerance"""
    unpaired: int = 0
    """messages without a partner"""
    since: int | None = None
    """[ns] log time of the first difference"""
    worst: dict[str, Difference] = field(default_factory=dict)
    """by field"""
    apart: int = 0
    """[ns] furthest that two times in a pair are apart"""
    note: str = ''

    @property
    def same(self) -> bool:
        """Whether nothing sets them apart."""
        return not (self.differing or self.unpaired or self.note)


def diff(
    first: BagReader,
    second: BagReader,
    topics: list[str] | None,
    tolerance: Tolerance,
    pairing: Pairing = BY_STAMP,
) -> Iterator[TopicDiff]:
    """Yield the comparison of each topic.

    Args:
        first: What should be.
        second: What is.
        topics: Which ones; None: all that either has.
        tolerance: Of numbers.
        pairing: How messages find their partners, and the tolerance of times.

    Raises:
        ConfigurationError: One of ``topics`` is in neither bag.

    """
    every = sorted({*first.topics, *second.topics})
    for topic in topics or ():
        if topic not in every:
            msg = f"neither bag has a topic '{topic}'; they have {', '.join(every)}"
            raise ConfigurationError(msg)
    for topic in topics or every:
        yield _topic(topic, first, second, _Comparison(tolerance, pairing))


def _topic(topic: str, first: BagReader, second: BagReader, compare: _Comparison) -> TopicDiff:
    found = TopicDiff(topic, (first.counts.get(topic, 0), second.counts.get(topic, 0)))
    for bag, which in ((first, 'first'), (second, 'second')):
        if topic not in bag.topics:
            found.note = f'not in the {which} bag'
            return found
    found.note = _unlike(topic, first, second)
    if found.note:
        return found
    for one, other in pairs(first.messages([topic]), second.messages([topic]), compare.pairing):
        if one is None or other is None:
            found.unpaired += 1
            differences = []
        else:
            found.compared += 1
            differences = compare(one, other)
            found.differing += bool(differences)
            _keep_worst(found.worst, one.stamp, differences)
        known = one or other
        if found.since is None and (differences or one is None or other is None) and known:
            found.since = known.stamp
    found.apart = compare.apart
    return found


def _keep_worst(
    worst: dict[str, Difference], stamp: int, differences: list[tuple[str, Any, Any]]
) -> None:
    """Keep of each field the values that lie furthest apart, the first of such."""
    for path, a, b in differences:
        known = worst.get(path)
        if known is None or distance(a, b) > distance(known.first, known.second):
            worst[path] = Difference(path, stamp, a, b)


def _unlike(topic: str, first: BagReader, second: BagReader) -> str:
    """Return how the types of a topic differ between two bags; empty if they do not."""
    ours, theirs = (
        {c.type: c for c in bag.connections if c.topic == topic} for bag in (first, second)
    )
    if set(ours) != set(theirs):
        return f'type {", ".join(ours)} against {", ".join(theirs)}'
    for kind in ours:
        if _fields(ours[kind]) != _fields(theirs[kind]):
            return f'{kind} is defined differently'
    return ''


def _fields(connection: Connection) -> Any:
    """Return the fields of a type; where they cannot be understood, all that describes it."""
    try:
        return MessageDecoder(connection).store.fielddefs
    except ConfigurationError:
        return connection.definition, connection.definition_encoding, connection.encoding


class _Comparison:
    """Compares the messages of one topic pair by pair."""

    def __init__(self, tolerance: Tolerance, pairing: Pairing) -> None:
        self.pairing = pairing
        self.apart = 0
        """[ns] furthest that two times were apart"""
        self._tolerance = tolerance
        self._decoders: dict[Connection, MessageDecoder] = {}

    def __call__(self, one: Message, other: Message) -> list[tuple[str, Any, Any]]:
        """Return path and both values of each field that differs."""
        kinds = one.connection.type, other.connection.type
        if kinds[0] != kinds[1]:
            return [('type', *kinds)]
        if one.data == other.data:
            return []
        try:
            return list(self._differences(self._decode(one), self._decode(other), ''))
        except (ConfigurationError, SourceError) as error:  # nobody can tell more
            shown = one.data.hex()[:16], other.data.hex()[:16]
            whose = f', as one is no {kinds[0]}' if isinstance(error, SourceError) else ''
            return [(f'bytes that cannot be decoded{whose}', *shown)]

    def _decode(self, message: Message) -> Any:
        connection = message.connection
        if connection not in self._decoders:
            self._decoders[connection] = MessageDecoder(connection)
        return self._decoders[connection](message)

    def _differences(self, a: Any, b: Any, path: str) -> Iterator[tuple[str, Any, Any]]:
        if getattr(a, '__msgtype__', '') in TIMES:
            yield from self._times(a, b, path)
        elif hasattr(a, '__dataclass_fields__'):
            for name in a.__dataclass_fields__:
                if name != '__msgtype__':
                    inner = f'{path}.{name}' if path else name
                    yield from self._differences(getattr(a, name), getattr(b, name), inner)
        elif isinstance(a, (str, bytes)) or not hasattr(a, '__len__'):
            if not equal(a, b, self._tolerance):
                yield path, a, b
        else:
            if len(a) != len(b):
                yield f'length of {path}', len(a), len(b)
            for i, x, y in _unequal(a, b):
                yield from self._differences(x, y, f'{path}[{i}]')

    def _times(self, a: Any, b: Any, path: str) -> Iterator[tuple[str, Any, Any]]:
        """Compare times as one number: of 0.999999999 and 1 s no part is near the other."""
        one, other = (int(t.sec) * 1_000_000_000 + int(t.nanosec) for t in (a, b))
        apart = abs(one - other)
        self.apart = max(self.apart, apart)
        limit = self.pairing.tolerance
        if limit is not None and apart > limit:
            yield f'{path} [ns]', one, other


def _unequal(a: Any, b: Any) -> Iterator[tuple[int, Any, Any]]:
    """Yield place and values of the items of two sequences that may differ, as Python's own."""
    if isinstance(a, np.ndarray):
        common = min(len(a), len(b))
        places = np.flatnonzero(a[:common] != b[:common])
        for i, x, y in zip(places.tolist(), a[places].tolist(), b[places].tolist(), strict=True):
            yield i, x, y
    else:
        for i, (x, y) in enumerate(zip(a, b, strict=False)):
            yield i, x, y


def equal(a: Any, b: Any, tolerance: Tolerance) -> bool:
    """Return whether two values of a field count as the same."""
    if isinstance(a, (str, bytes, bool, np.bool_)):
        return bool(a == b)
    a, b = (x.item() if isinstance(x, np.generic) else x for x in (a, b))
    if a == b or (isnan(a) and isnan(b)):
        return True
    if not (isfinite(a) and isfinite(b)):  # an infinity is near nothing else
        return False
    return bool(abs(a - b) <= tolerance.absolute + tolerance.relative * max(abs(a), abs(b)))


def distance(a: Any, b: Any) -> float:
    """Return how far apart two values are; infinite where they are no numbers."""
    a, b = (x.item() if isinstance(x, np.generic) else x for x in (a, b))
    try:
        distance = abs(a - b)
    except TypeError:
        return inf
    return inf if isnan(distance) else float(distance)
