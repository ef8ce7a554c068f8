"""What is wrong with a bag: damage, stamps that go back, silences, wrong rates, NaN, new types."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.bag.cdr.definitions import begins_with_header
from agv_motion.bag.checks.silences import regular, silences
from agv_motion.bag.checks.stamps import stamps
from agv_motion.bag.columns.column import Ragged
from agv_motion.bag.columns.columns import read_topic
from agv_motion.bag.completeness import completeness
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from numpy.typing import NDArray

    from agv_motion.bag.columns.column import Column
    from agv_motion.bag.columns.columns import Columns
    from agv_motion.bag.reader import BagReader

_SLICE = 1 << 28
"""[bytes] of messages that are looked through at a time"""
_SHARED = ('DiagnosticArray', 'TFMessage', 'Log')
_PARTS = 10
_FEWEST = 200
"""messages whose rate is worth being judged part by part"""


class Limits(NamedTuple):
    """What counts as wrong."""

    rates: Mapping[str, float] = {}
    """[Hz] that topics should have"""
    tolerance: float = 0.1
    """share by which a rate may be off"""
    gap: float = 5.0
    """number of usual intervals after which no message is a silence"""


_USUAL = Limits()


class Finding(NamedTuple):
    """Something that is wrong."""

    severity: str
    """``error``, or ``warning`` for what may well be meant"""
    where: str
    """a topic, or a file"""
    text: str


def check(
    bag: BagReader, limits: Limits = _USUAL, progress: Callable[[str], None] = lambda _: None
) -> Iterator[Finding]:
    """Yield all findings, file by file, then topic by topic.

    Args:
        bag: The bag, opened to validate CRCs.
        limits: What counts as wrong.
        progress: Is told what is being looked at.

    Raises:
        ConfigurationError: A topic in ``limits`` is not in the bag.

    """
    bag.require(limits.rates)
    for problem in bag.problems:
        severity = 'warning' if getattr(problem, 'harmless', False) else 'error'
        yield Finding(severity, str(getattr(problem, 'path', bag.path)), str(problem))
    yield from _incomplete(bag)
    sound = True
    for file in bag.files:
        progress(file.path.name)
        for text in file.damage():
            sound = False
            yield Finding('error', file.path.name, text)
    for topic in sorted(bag.topics):
        progress(topic)
        yield from _type(bag, topic)
        try:
            yield from _times(topic, stamps(bag, [topic])[topic], limits)
            encoding = bag.topics[topic].encoding
            if sound and encoding == 'cdr':
                yield from _values(bag, topic)
            elif sound:
                text = f'its messages are encoded in {encoding!r}: values were not looked at'
                yield Finding('warning', topic, text)
        except AgvMotionError as error:
            yield Finding('error', topic, str(error))
    if not sound:
        text = 'values were not looked at, as the file is damaged: agv bag recover, then check'
        yield Finding('warning', str(bag.path), text)


def _incomplete(bag: BagReader) -> Iterator[Finding]:
    """Yield the topics of which the recorder missed something."""
    for topic, one in sorted(completeness(bag).items()):
        if one.missing:
            yield Finding('warning', topic, f'its recording is {one}')


def _type(bag: BagReader, topic: str) -> Iterator[Finding]:
    """Yield a change of the type of a topic."""
    found = {(c.type, c.definition) for c in bag.connections if c.topic == topic}
    if len(found) > 1:
        names = sorted(kind for kind, _ in found)
        what = ' and '.join(names) if len(set(names)) > 1 else f'{names[0]}, defined differently'
        yield Finding('error', topic, f'its type changed: {what}')
    elif not bag.topics[topic].definition and bag.topics[topic].encoding == 'cdr':
        yield Finding('warning', topic, f'the bag has no definition of {bag.topics[topic].type}')


def _times(topic: str, times: NDArray[np.int64], limits: Limits) -> Iterator[Finding]:
    """Yield what is wrong with the log times of a topic."""
    yield from _back('warning', topic, 'log time', times)
    ordered = np.sort(times)
    length = (float(ordered[-1]) - float(ordered[0])) * 1e-9 if len(ordered) else 0.0
    rate = (len(ordered) - 1) / length if length else 0.0
    expected = limits.rates.get(topic)
    if expected is not None and abs(rate - expected) > limits.tolerance * expected:
        text = f'{rate:.3f} Hz, expected {expected:g} Hz within {limits.tolerance:.0%}'
        yield Finding('error', topic, text)
    if not regular(ordered):
        return
    start = int(ordered[0])
    for silence in silences(ordered, limits.gap):
        after, lasts = (silence.after - start) * 1e-9, silence.length * 1e-9
        text = (
            f'silent for {lasts:.3f} s after {after:.3f} s, usual are {silence.usual / 1e9:.3f} s'
        )
        yield Finding('warning', topic, f'{text} (about {silence.missing} messages missing)')
    if expected is None and len(ordered) >= _FEWEST:
        yield from _wandering(topic, ordered, limits.tolerance)


def _wandering(topic: str, ordered: NDArray[np.int64], tolerance: float) -> Iterator[Finding]:
    """Yield a rate that is not the same in all tenths of the recording."""
    steps = [float(np.median(np.diff(part))) for part in np.array_split(ordered, _PARTS)]
    slow, fast = max(steps), min(steps)
    if slow > (1.0 + 2.0 * tolerance) * fast:
        text = f'its rate changes from {1e9 / slow:.3f} to {1e9 / fast:.3f} Hz'
        yield Finding('warning', topic, text)


def _back(severity: str, topic: str, what: str, times: NDArray[np.int64]) -> Iterator[Finding]:
    """Yield stamps that are earlier than the one before."""
    back = np.flatnonzero(times[1:] < times[:-1])
    if len(back):
        first = int(back[0])
        step = int(times[first]) - int(times[first + 1])
        text = (
            f'{what} goes back {len(back)} times, first by {step * 1e-9:.9f} s at message '
            f'{first + 1} ({times[first]} ns, then {times[first + 1]} ns)'
        )
        yield Finding(severity, topic, text)


def _values(bag: BagReader, topic: str) -> Iterator[Finding]:
    """Yield NaN, and stamps in headers that go back; bounded in memory."""
    size = sum(file.unpacked_size for file in bag.files)
    parts, length = size // _SLICE + 1, bag.end + 1 - bag.start
    edges = [bag.start + length * i // parts for i in range(parts + 1)]
    nan: dict[str, tuple[int, int]] = {}
    stamped = begins_with_header(bag.topics[topic].definition)
    headers: list[NDArray[np.int64]] = []
    for start, stop in zip(edges[:-1], [*edges[1:-1], None], strict=True):
        columns = read_topic(bag, topic, None, start, stop)
        for field, (count, first) in _nan(columns).items():
            known = nan.get(field, (0, first))
            nan[field] = known[0] + count, known[1]
        if stamped:
            headers.append(columns.nanoseconds('header.stamp'))
    if headers:
        times = np.concatenate(headers)
        if (times[1:] < times[:-1]).any():
            severity = 'warning' if _several_publishers(bag, topic) else 'error'
            yield from _back(severity, topic, 'header.stamp', times)
    for field, (count, first) in nan.items():
        when = (first - bag.start) * 1e-9
        yield Finding('error', topic, f'{field} is NaN in {count} messages, first at {when:.3f} s')


def _several_publishers(bag: BagReader, topic: str) -> bool:
    """Return whether stamps may go back because several publishers send on a topic.

    The bag tells their number, or each of them numbers its messages from 1 on. Diagnostics,
    transforms and logs have many by their nature.
    """
    one, *others = (c for c in bag.connections if c.topic == topic)
    if others or len(one.qos) > 1 or one.type.rpartition('/')[2] in _SHARED:
        return True
    numbers = [message.sequence for message in bag.messages([topic])]
    return any(numbers) and any(b <= a for a, b in pairwise(numbers))


def _nan(columns: Columns) -> dict[str, tuple[int, int]]:
    """Return for each field with NaN how many messages have it, and when the first came [ns]."""
    found = {}
    for field, column in columns.fields.items():
        rows = _rows_with_nan(column)
        if len(rows):
            found[field] = len(rows), int(columns.stamps[rows[0]])
    return found


def _rows_with_nan(column: Column) -> NDArray[np.intp]:
    if isinstance(column, Ragged):
        inner = _rows_with_nan(column.values)
        return np.unique(np.searchsorted(column.offsets, inner, side='right') - 1)
    if not isinstance(column, np.ndarray) or column.dtype.kind != 'f':
        return np.empty(0, np.intp)
    return np.flatnonzero(np.isnan(column).any(axis=tuple(range(1, column.ndim))))
