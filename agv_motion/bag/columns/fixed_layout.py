"""Messages of one layout, decoded together: their bytes as rows of a matrix."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.cdr.primitives import LENGTH, NUMPY
from agv_motion.bag.columns.repetition import repeats

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from numpy.typing import DTypeLike, NDArray

    from agv_motion.bag.cdr.layout import FieldOffsets, Leaf
    from agv_motion.bag.columns.text_codes import TextCodes
    from agv_motion.bag.mcap.record_parsing import Buffer

_GAPS = (32, 8, 0)
"""[bytes] Between lengths and texts may lie what seldom changes: names nobody wants, padding."""


class LayoutRows(NamedTuple):
    """Bytes of messages at equal distances; places in a row count from its first wanted byte."""

    data: Buffer | NDArray[Any]
    first: int
    """[bytes] where the first row begins"""
    stride: int
    """[bytes] from one row to the next"""
    number: int

    def values(self, dtype: DTypeLike, at: int, count: int = 1, step: int = 1) -> NDArray[Any]:
        """Return ``count`` values of every row, the first at ``at``, ``step`` bytes apart."""
        shape, strides = (self.number, count), (self.stride, step)
        return np.ndarray(shape, dtype, self.data, self.first + at, strides)


class FixedLayout:
    """What one message says of all that agree with it in every length."""

    def __init__(
        self, walk: FieldOffsets, leaves: Sequence[Leaf], data: Buffer, start: int, order: str
    ) -> None:
        """Learn from a message.

        Args:
            walk: Through the message.
            leaves: The wanted ones.
            data: Buffer that holds the message.
            start: [bytes] where its content begins.
            order: '<' little-endian or '>' big-endian.

        """
        self._dtypes = {leaf.number: np.dtype(order + NUMPY[leaf.type]) for leaf in leaves}
        found = {leaf: walk.found[leaf.number] for leaf in leaves}
        lengths = {leaf: found.pop(leaf) for leaf in leaves if leaf.type == 'length'}
        wanted = [(at, at + n * step) for segments in found.values() for at, n, step in segments]
        wanted += [(at, at + LENGTH.size) for segments in lengths.values() for _, _, at in segments]
        reach = min(max((last for _, last in wanted), default=0), walk.size)
        guards = [at for at in walk.guards if at < reach]
        first = min([reach, *guards, *(begin for begin, _ in wanted)])
        self._first, self._size = first, max(reach - first, 1)
        self._content = bytes(data[start + first : start + reach])
        self._places = {
            leaf.number: [(at - first, n, step) for at, n, step in segments]
            for leaf, segments in found.items()
        }
        self._constant = {
            leaf.number: np.array([[length for length, _, _ in segments]], np.uint32)
            for leaf, segments in lengths.items()
        }
        """rows that are the same in all messages"""
        self._guards = [(at - first, self._bytes(at - first, LENGTH.size)) for at in guards]
        texts = [p for leaf in found if leaf.type == 'string' for p in self._places[leaf.number]]
        told = [(at, len(length)) for at, length in self._guards]
        told += [(at, size) for at, size, _ in texts]
        self._told = [self._together(told, gap) for gap in _GAPS]
        """what all messages with the same lengths and texts have in common, the last of these
        exactly; the others compare fewer and longer parts, as long as what is between agrees"""

    def rows(self, data: Buffer, starts: NDArray[np.int64]) -> LayoutRows:
        """Return messages as rows: as they lie if they lie equally far apart, else gathered."""
        first, count, size = int(starts[0]) + self._first, len(starts), self._size
        stride = int(starts[1] - starts[0]) if count > 1 else size
        if stride >= size and (starts[1:] - starts[:-1] == stride).all():
            return LayoutRows(data, first, stride, count)
        raw, room = np.dtype((np.void, size)), len(data) - size + 1
        windows = np.ndarray((room,), raw, data, strides=(1,))
        return LayoutRows(windows[starts + self._first], 0, size, count)

    def same(self, rows: LayoutRows) -> bool:
        """Return whether all rows have this layout, and the same texts too."""
        for i, told in enumerate(self._told):
            if all(repeats(rows.values('u1', at, len(part)), part) for at, part in told):
                del self._told[:i]
                return True
        return False

    def agree(self, rows: LayoutRows) -> NDArray[np.bool_]:
        """Return which rows have this layout."""
        agree = np.ones(rows.number, bool)
        for at, length in self._guards:
            agree &= rows.values('<u4', at)[:, 0] == int.from_bytes(length, 'little')
        return agree

    def values(
        self, rows: LayoutRows, leaf: Leaf, texts: Mapping[int, TextCodes], *, same: bool
    ) -> NDArray[Any]:
        """Return the values of a leaf in rows that agree.

        Args:
            rows: The messages.
            leaf: The field.
            texts: Codes of the texts, by the number of their leaf.
            same: All rows have the texts of this layout.

        Returns:
            Of shape (rows, values), or (1, values) if they are the same in all rows.

        """
        number = leaf.number
        if leaf.type == 'length':
            return self._constant[number]
        if leaf.type == 'string':
            return self._codes(rows, number, texts[number].code, same=same)
        dtype = self._dtypes[number]
        places = self._places[number]
        if len(places) == 1:
            return rows.values(dtype, *places[0])
        parts = [rows.values(dtype, *place) for place in places]
        return np.concatenate(parts, axis=1) if parts else np.empty((rows.number, 0), dtype)

    def _codes(
        self, rows: LayoutRows, number: int, code: Callable[[bytes], int], *, same: bool
    ) -> NDArray[np.uint32]:
        places = [(at, max(size - 1, 0)) for at, size, _ in self._places[number]]  # no final zero
        if same:
            if number not in self._constant:
                codes = [code(self._bytes(*place)) for place in places]
                self._constant[number] = np.array([codes], np.uint32)
            return self._constant[number]
        found = np.empty((rows.number, len(places)), np.uint32)
        for column, (at, size) in enumerate(places):
            data = rows.values('u1', at, size).tobytes()
            parts = [data[i : i + size] for i in range(0, len(data), size)] if size else [b'']
            found[:, column] = [code(part) for part in parts]
        return found

    def _bytes(self, at: int, size: int) -> bytes:
        return self._content[at : at + size]

    def _together(self, places: Iterable[tuple[int, int]], gap: int) -> list[tuple[int, bytes]]:
        """Return place and bytes of places, those together that lie at most ``gap`` apart."""
        together: list[list[int]] = []
        for at, size in sorted(places):
            if together and at <= together[-1][1] + gap:
                together[-1][1] = max(at + size, together[-1][1])
            else:
                together.append([at, at + size])
        return [(first, self._bytes(first, last - first)) for first, last in together]
