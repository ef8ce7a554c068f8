"""Compare two bags topic by topic: what is missing, what differs, by how much and since when.

The messages of a topic are paired by the time in their header where they have one, else by their
place. Numbers may differ by a tolerance; everything else must be equal.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf, isnan
from struct import Struct
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.bag.definitions import begins_with_header
from agv_motion.bag.message_decoder import MessageDecoder
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.bag.connection import Message
    from agv_motion.bag.reader import BagReader

_LITTLE, _BIG = Struct('<iI'), Struct('>iI')


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
    note: str = ''

    @property
    def same(self) -> bool:
        """Whether nothing sets them apart."""
        return not (self.differing or self.unpaired or self.note)


def diff(
    first: BagReader, second: BagReader, topics: list[str] | None, tolerance: Tolerance
) -> Iterator[TopicDiff]:
    """Yield the comparison of each topic.

    Args:
        first: What should be.
        second: What is.
        topics: Which ones; None: all that either has.
        tolerance: Of numbers.

    Raises:
        ConfigurationError: One of ``topics`` is in neither bag.

    """
    every = sorted({*first.topics, *second.topics})
    for topic in topics or ():
        if topic not in every:
            msg = f"neither bag has a topic '{topic}'; they have {', '.join(every)}"
            raise ConfigurationError(msg)
    for topic in topics or every:
        yield _topic(topic, first, second, tolerance)


def _topic(topic: str, first: BagReader, second: BagReader, tolerance: Tolerance) -> TopicDiff:
    found = TopicDiff(topic, (first.counts.get(topic, 0), second.counts.get(topic, 0)))
    for bag, which in ((first, 'first'), (second, 'second')):
        if topic not in bag.topics:
            found.note = f'not in the {which} bag'
            return found
    types = first.topics[topic].type, second.topics[topic].type
    if types[0] != types[1]:
        found.note = f'type {types[0]} against {types[1]}'
        return found
    ours, theirs = (MessageDecoder(bag.topics[topic]) for bag in (first, second))
    if ours.store.fielddefs != theirs.store.fielddefs:
        found.note = f'{types[0]} is defined differently'
        return found
    for one, other in _pairs(first, second, topic, found):
        found.compared += 1
        if one.data == other.data:
            continue
        differences = list(_differences(ours(one), theirs(other), tolerance, ''))
        if differences:
            found.differing += 1
            found.since = one.stamp if found.since is None else found.since
        for path, a, b in differences:
            known = found.worst.get(path)
            if known is None or distance(a, b) > distance(known.first, known.second):
                found.worst[path] = Difference(path, one.stamp, a, b)
    return found


def _pairs(
    first: BagReader, second: BagReader, topic: str, found: TopicDiff
) -> Iterator[tuple[Message, Message]]:
    """Yield both messages of each pair; count those without a partner."""
    header = begins_with_header(first.topics[topic].definition)
    ours, theirs = (bag.messages([topic]) for bag in (first, second))
    one, other = next(ours, None), next(theirs, None)
    while one is not None and other is not None:
        mine, yours = (_stamp(m.data) if header else 0 for m in (one, other))
        if mine == yours:
            yield one, other
        elif found.since is None:
            found.since = one.stamp
        found.unpaired += mine != yours
        if mine <= yours:
            one = next(ours, None)
        if yours <= mine:
            other = next(theirs, None)
    left = found.counts[0] + found.counts[1] - 2 * found.compared - found.unpaired
    found.unpaired += max(left, 0)


def _stamp(data: bytes) -> int:
    """Return the stamp [ns] of a message that begins with a header."""
    seconds, rest = (_LITTLE if data[1] & 1 else _BIG).unpack_from(data, 4)
    return int(seconds * 1_000_000_000 + rest)


def _differences(a: Any, b: Any, tolerance: Tolerance, path: str) -> Iterator[tuple[str, Any, Any]]:
    """Yield path and both values of each field that differs."""
    if hasattr(a, '__dataclass_fields__'):
        for name in a.__dataclass_fields__:
            if name != '__msgtype__':
                inner = f'{path}.{name}' if path else name
                yield from _differences(getattr(a, name), getattr(b, name), tolerance, inner)
    elif not isinstance(a, (str, bytes)) and hasattr(a, '__len__'):
        if len(a) != len(b):
            yield f'length of {path}', len(a), len(b)
        for i, (x, y) in enumerate(zip(a, b, strict=False)):
            yield from _differences(x, y, tolerance, f'{path}[{i}]')
    elif not _equal(a, b, tolerance):
        yield path, a, b


def _equal(a: Any, b: Any, tolerance: Tolerance) -> bool:
    if isinstance(a, (str, bytes, bool)):
        return bool(a == b)
    if a == b or (isnan(a) and isnan(b)):
        return True
    return bool(abs(a - b) <= tolerance.absolute + tolerance.relative * max(abs(a), abs(b)))


def distance(a: Any, b: Any) -> float:
    """Return how far apart two values are; infinite where they are no numbers."""
    try:
        distance = abs(float(a) - float(b))
    except ValueError:
        return inf
    return inf if isnan(distance) else distance
