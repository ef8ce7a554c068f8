"""Messages of one topic into columns: alike ones together, the others by a walk through each."""

from __future__ import annotations

from collections import defaultdict
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.bag.cdr.layout import FieldOffsets, Leaf, layout
from agv_motion.bag.cdr.message_type import unfold
from agv_motion.bag.cdr.primitives import NUMPY
from agv_motion.bag.columns.column_builder import ColumnBuilder, ColumnMemory, Growing, Part
from agv_motion.bag.columns.fixed_layout import FixedLayout
from agv_motion.bag.columns.text_codes import TextCodes
from agv_motion.bag.damage import DamagedBagError
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from numpy.typing import NDArray

    from agv_motion.bag.columns.batch import Batch
    from agv_motion.bag.connection import Connection

CACHED = 1 << 22
"""[bytes] of messages that are decoded together."""
FEW = 4
"""Messages that are not worth a fixed layout of their own."""
_MOST_LAYOUTS = 16
"""Layouts that are kept for messages of one size."""
_ORDERS = {0: '>', 1: '<'}


class TopicDecoder:
    """Decodes batch after batch."""

    def __init__(
        self, connection: Connection, fields: Iterable[str] | None, rows: int, limit: int
    ) -> None:
        """Understand the type.

        Args:
            connection: The topic.
            fields: Paths of fields, such as ``pose.position``; None means all.
            rows: Messages that are expected.
            limit: [bytes] that they can have at most.

        Raises:
            ConfigurationError: The type cannot be understood, or a field is not there.

        """
        self.connection = connection
        if connection.encoding != 'cdr':
            msg = (
                f'topic {connection.topic} is encoded in {connection.encoding!r}: only CDR, which '
                'ROS 2 writes, can be read by columns'
            )
            raise ConfigurationError(msg)
        kind = unfold(connection.type, connection.definition, connection.definition_encoding)
        self._layout = layout(kind)
        self.leaves = _wanted(self._layout.leaves, fields, connection)
        self.texts = {leaf.number: TextCodes() for leaf in self.leaves if leaf.type == 'string'}
        memory = ColumnMemory()
        self.builders = {
            leaf.number: ColumnBuilder(
                memory, 'bool' if leaf.type == 'bool' else NUMPY[leaf.type], rows, limit
            )
            for leaf in self.leaves
        }
        self.stamps = Growing(memory.take(np.dtype(np.int64), rows))
        self._layouts: defaultdict[tuple[int, int], list[FixedLayout]] = defaultdict(list)

    def put(self, batch: Batch) -> None:
        """Decode a batch, in parts that fit into the cache of a processor.

        Raises:
            DamagedBagError: A message is not of its type.

        """
        ends = np.cumsum(batch.sizes)
        first = 0
        while first < len(ends):
            begin = int(ends[first - 1]) if first else 0
            last = max(first + 1, int(np.searchsorted(ends, begin + CACHED)))
            self._put(batch.part(slice(first, last)))
            first = last

    def _put(self, batch: Batch) -> None:
        if (batch.forms > max(_ORDERS)).any():
            row = next(i for i, form in enumerate(batch.forms.tolist()) if form not in _ORDERS)
            finding = f'encapsulation {batch.forms[row]:#06x}, expected CDR (0 or 1)'
            raise self._damaged(batch, row, finding)
        parts: dict[int, list[Part]] = {leaf.number: [] for leaf in self.leaves}
        different: list[NDArray[np.intp]] = []
        for form, size, rows in _groups(batch):
            rest = self._alike(batch, (form, size), rows, parts)
            if len(rest):
                different.append(rest)
        if different:
            self._one_by_one(batch, np.sort(np.concatenate(different)), parts)
        for leaf in self.leaves:
            self.builders[leaf.number].put(len(batch.starts), parts[leaf.number])
        self.stamps.more(len(batch.stamps))[:] = batch.stamps

    def _alike(
        self,
        batch: Batch,
        key: tuple[int, int],
        rows: NDArray[np.intp],
        parts: dict[int, list[Part]],
    ) -> NDArray[np.intp]:
        """Decode rows of one size by layouts; return those that are too different."""
        layouts = self._layouts[key]
        for fixed in layouts:
            rows = self._by_layout(batch, fixed, rows, parts)
            if not len(rows):
                return rows
        while len(rows) >= FEW:
            fixed = self._learnt(batch, key, int(rows[0]))
            before = len(rows)
            rows = self._by_layout(batch, fixed, rows, parts)
            if before - len(rows) < FEW:
                break
            if len(layouts) < _MOST_LAYOUTS:
                layouts.append(fixed)
        return rows

    def _learnt(self, batch: Batch, key: tuple[int, int], row: int) -> FixedLayout:
        order = _ORDERS[key[0]]
        walk, start = self._walk(batch, row, order), int(batch.starts[row])
        return FixedLayout(walk, self.leaves, batch.data, start, order)

    def _by_layout(
        self, batch: Batch, fixed: FixedLayout, rows: NDArray[np.intp], parts: dict[int, list[Part]]
    ) -> NDArray[np.intp]:
        """Decode those rows that agree with a layout; return the others."""
        every = len(rows) == len(batch.starts)
        found = fixed.rows(batch.data, batch.starts if every else batch.starts[rows])
        rest, same = rows[:0], fixed.same(found)
        if not same and not (agree := fixed.agree(found)).all():
            rest, rows, every = rows[~agree], rows[agree], False
            if not len(rows):
                return rest
            found = fixed.rows(batch.data, batch.starts[rows])
            same = fixed.same(found)
        for leaf in self.leaves:
            try:
                values = fixed.values(found, leaf, self.texts, same=same)
            except UnicodeDecodeError as error:
                raise self._damaged(
                    batch, int(rows[0]), f'field {leaf.path} is not UTF-8'
                ) from error
            where = slice(None) if every else rows
            parts[leaf.number].append(Part(where, values.shape[1], values))
        return rest

    def _one_by_one(
        self, batch: Batch, rows: NDArray[np.intp], parts: dict[int, list[Part]]
    ) -> None:
        """Walk through each of some rows; then take the values of each field together."""
        forms = batch.forms[rows].tolist()
        for form, order in _ORDERS.items():
            mine = [i for i, one in enumerate(forms) if one == form]
            if not mine:
                continue
            walks = [self._walk(batch, int(rows[i]), order) for i in mine]
            for leaf in self.leaves:
                values, counts = self._gathered(batch, leaf, walks, rows[mine], order)
                parts[leaf.number].append(Part(rows[mine], counts, values))

    def _gathered(
        self,
        batch: Batch,
        leaf: Leaf,
        walks: list[FieldOffsets],
        rows: NDArray[np.intp],
        order: str,
    ) -> tuple[NDArray[Any], NDArray[np.int64]]:
        """Return the values of a leaf in some messages one after another, and their counts."""
        found = [walk.found[leaf.number] for walk in walks]
        begins = batch.starts[rows].tolist()
        if leaf.type in ('length', 'string'):
            counts = np.array([len(segments) for segments in found], np.int64)
            if leaf.type == 'length':
                lengths = [length for segments in found for length, _, _ in segments]
                return np.array(lengths, np.uint32), counts
            places = [
                (begin + at, begin + at + max(size - 1, 0))
                for begin, segments in zip(begins, found, strict=True)
                for at, size, _ in segments
            ]
            code = self.texts[leaf.number].code
            try:
                codes = [code(bytes(batch.data[first:last])) for first, last in places]
            except UnicodeDecodeError as error:
                raise self._damaged(
                    batch, int(rows[0]), f'field {leaf.path} is not UTF-8'
                ) from error
            return np.array(codes, np.uint32), counts
        counts = np.array([sum(n for _, n, _ in segments) for segments in found], np.int64)
        segments = [
            (begin + at, n, step)
            for begin, segments in zip(begins, found, strict=True)
            for at, n, step in segments
        ]
        return _values(batch, segments, np.dtype(order + NUMPY[leaf.type])), counts

    def _walk(self, batch: Batch, row: int, order: str) -> FieldOffsets:
        try:
            start, size = int(batch.starts[row]), int(batch.sizes[row])
            return self._layout.walk(batch.data, start, size, order)
        except ValueError as error:
            raise self._damaged(batch, row, f'at {batch.stamps[row]} ns: {error}') from None

    def _damaged(self, batch: Batch, row: int, finding: str) -> DamagedBagError:
        what = f'a message of {self.connection.topic} that is no {self.connection.type}'
        return DamagedBagError(
            batch.path, batch.origin(row), f'here, {what} ({finding})', 'agv bag check tells more'
        )


def _wanted(
    leaves: Iterable[Leaf], fields: Iterable[str] | None, connection: Connection
) -> list[Leaf]:
    """Return the leaves of the wanted fields, with the lengths of the sequences around them."""
    every = list(leaves)
    if fields is None:
        return every
    numbers: set[int] = set()
    for field in fields:
        found = [
            leaf for leaf in every
            if leaf.path == field or leaf.path.startswith(f'{field}.')
        ]  # fmt: skip
        if not found:
            paths = sorted({leaf.path for leaf in every})
            close = get_close_matches(field, paths)
            hint = f"did you mean '{close[0]}'?" if close else f'it has {", ".join(paths)}'
            msg = f"{connection.type} on {connection.topic} has no field '{field}'; {hint}"
            raise ConfigurationError(msg)
        for leaf in found:
            numbers.update((leaf.number, *leaf.lengths))
    return [leaf for leaf in every if leaf.number in numbers]


def _groups(batch: Batch) -> Iterator[tuple[int, int, NDArray[np.intp]]]:
    """Yield form, size and rows of messages of the same form and size."""
    keys = batch.sizes * 2 + batch.forms
    if (keys == keys[0]).all():
        yield int(batch.forms[0]), int(batch.sizes[0]), np.arange(len(keys))
        return
    order = np.argsort(keys, kind='stable')
    ordered = keys[order]
    for rows in np.split(order, np.flatnonzero(np.diff(ordered)) + 1):
        yield int(batch.forms[rows[0]]), int(batch.sizes[rows[0]]), rows


def _values(
    batch: Batch, segments: list[tuple[int, int, int]], dtype: np.dtype[Any]
) -> NDArray[Any]:
    """Return numbers that lie anywhere in the data of a batch, one after another."""
    if not segments:
        return np.empty(0, dtype)
    room = len(batch.data) - dtype.itemsize + 1
    if all(count == 1 for _, count, _ in segments):
        places = np.array([at for at, _, _ in segments], np.intp)
        return np.ndarray((room,), dtype, batch.data, strides=(1,))[places]
    values, filled = np.empty(sum(count for _, count, _ in segments), dtype), 0
    for at, count, step in segments:
        part = np.ndarray((count,), dtype, batch.data, at, (step,))
        values[filled : filled + count] = part
        filled += count
    return values
