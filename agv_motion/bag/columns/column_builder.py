"""Columns that grow batch by batch, in memory that is never taken twice."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.columns.repetition import repeats

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import DTypeLike, NDArray

_GROWTH = 1.2
_SMALL, _LARGE, _BLOCK, _ALIGNED = 1 << 16, 1 << 22, 1 << 25, 64
"""[bytes]"""


class Part(NamedTuple):
    """Values of one field in some rows of a batch."""

    rows: NDArray[np.intp] | slice
    counts: int | NDArray[np.int64]
    """values in every row: the same in all, or of each"""
    values: NDArray[Any]
    """one after another; where counts are the same in all rows, of shape (rows, counts), or
    (1, counts) if the values are the same too"""


class ColumnMemory:
    """Hands out memory for columns, to small ones in common blocks.

    In large blocks the operating system has huge pages; 40 columns of 2 MB each take their pages
    five times as fast out of such blocks as one by one.
    """

    def __init__(self) -> None:
        """Begin without memory."""
        self._block: NDArray[np.uint8] = np.empty(0, np.uint8)

    def take(self, dtype: np.dtype[Any], count: int) -> NDArray[Any]:
        """Return an array of ``count`` elements; none if there is no memory for them."""
        size = -(-count * dtype.itemsize // _ALIGNED) * _ALIGNED
        try:
            if not _SMALL < size < _LARGE:
                return np.empty(count, dtype)
            if size > len(self._block):
                self._block = np.empty(_BLOCK, np.uint8)
        except MemoryError:  # the expectation came from a file that exaggerates
            return np.empty(0, dtype)
        taken, self._block = self._block[:size], self._block[size:]
        return taken.view(dtype)[:count]


class Growing:
    """A one-dimensional array that grows at its end.

    Where it owns its memory, that is resized in place (the operating system moves pages, not
    bytes), and pages that nothing was written to cost nothing.
    """

    def __init__(self, array: NDArray[Any]) -> None:
        """Begin with the memory of ``array``, as large as is expected."""
        self._array = array
        self.filled = 0

    def more(self, count: int) -> NDArray[Any]:
        """Return the next ``count`` elements, to be written before the next call."""
        end = self.filled + count
        if end > len(self._array):
            self._resize(max(end, int(len(self._array) * _GROWTH)))
        view = self._array[self.filled : end]
        self.filled = end
        return view

    def finish(self) -> NDArray[Any]:
        """Return what was written."""
        if self.filled < len(self._array):
            self._resize(self.filled)
        return self._array

    def _resize(self, size: int) -> None:
        if self._array.flags.owndata:
            self._array.resize(size, refcheck=False)
        elif size <= len(self._array):
            self._array = self._array[:size]
        else:
            grown = np.empty(size, self._array.dtype)
            grown[: self.filled] = self._array[: self.filled]
            self._array = grown


class ColumnBuilder:
    """Values of one field, row after row; rows of changing length cost an offset each."""

    def __init__(self, memory: ColumnMemory, dtype: DTypeLike, rows: int, limit: int) -> None:
        """Begin.

        Args:
            memory: Where the values go.
            dtype: Of the values.
            rows: How many are expected.
            limit: [bytes] that all values can have at most, as far as known.

        """
        self._memory, self._dtype = memory, np.dtype(dtype)
        self._expected, self._limit = rows, limit // self._dtype.itemsize
        self._same: NDArray[Any] | None = None
        self._values: Growing | None = None
        self._each: int
        """values of every row, once memory was taken for them"""
        self._counts: Growing | None = None
        self._rows = 0

    def put(self, rows: int, parts: Sequence[Part]) -> None:
        """Append a batch of ``rows`` rows, which ``parts`` cover."""
        each = self._alike(parts)
        tables = [_table(part, each) for part in parts] if each >= 0 else []
        if self._values is None:
            if tables and self._repeats(tables):
                self._rows += rows
                return
            self._begin(max(each, 0))
        assert self._values is not None
        if self._counts is None and each == self._each:
            target = self._values.more(rows * each).reshape(rows, each)
            for part, table in zip(parts, tables, strict=True):
                target[part.rows] = table
        else:
            self._put_ragged(rows, parts)
        self._rows += rows

    def finish(self) -> tuple[NDArray[Any], int | NDArray[np.int64]]:
        """Return all values, and how many every row has: the same number, or that of each.

        Where it is the same number, they are of shape (rows, number). A row that all repeat is
        there only once.
        """
        if self._values is None:
            row = np.empty((1, 0), self._dtype) if self._same is None else self._same
            return np.broadcast_to(row, (self._rows, row.shape[1])), row.shape[1]
        values = self._values.finish()
        if self._counts is None:
            return values.reshape(self._rows, self._each), self._each
        return values, self._counts.finish()

    def _repeats(self, tables: Sequence[NDArray[Any]]) -> bool:
        """Return whether all rows are the one that has come so far, bit by bit."""
        raw = tables[0][:1].tobytes()
        if not all(repeats(table, raw) for table in tables):
            return False
        row = tables[0][:1].astype(self._dtype)
        if self._same is None:
            self._same = row
        return row.tobytes() == self._same.tobytes()

    def _begin(self, each: int) -> None:
        """Take memory, for rows of ``each`` values, and write what has been the same so far."""
        self._each = each if self._same is None else self._same.shape[1]
        expected = min(self._expected * self._each, self._limit)
        self._values = Growing(self._memory.take(self._dtype, expected))
        if self._same is not None:
            table = self._values.more(self._rows * self._each)
            table.reshape(self._rows, self._each)[:] = self._same
            self._same = None

    @staticmethod
    def _alike(parts: Sequence[Part]) -> int:
        """Return the number of values that every row has; -1 where they differ."""
        if len(parts) == 1 and isinstance(parts[0].counts, int):
            return parts[0].counts
        found = set()
        for part in parts:
            if isinstance(part.counts, int):
                found.add(part.counts)
            else:
                found.update({int(part.counts.min()), int(part.counts.max())})
        return found.pop() if len(found) == 1 else -1

    def _put_ragged(self, rows: int, parts: Sequence[Part]) -> None:
        assert self._values is not None
        if self._counts is None:
            expected = max(self._expected, self._rows + rows)
            self._counts = Growing(self._memory.take(np.dtype(np.int64), expected))
            self._counts.more(self._rows)[:] = self._each
        counts = self._counts.more(rows)
        for part in parts:
            counts[part.rows] = part.counts
        ends = np.cumsum(counts)
        starts = ends - counts
        target = self._values.more(int(ends[-1]))
        for part in parts:
            begin = starts[part.rows]
            if isinstance(part.counts, int):
                target[begin[:, None] + np.arange(part.counts)] = part.values
            else:
                before = np.cumsum(part.counts) - part.counts
                places = np.repeat(begin - before, part.counts) + np.arange(len(part.values))
                target[places] = part.values


def _table(part: Part, each: int) -> NDArray[Any]:
    """Return the values of a part in a table of ``each`` columns."""
    if isinstance(part.counts, int):
        return part.values
    return part.values.reshape(len(part.counts), each)
