"""Messages of one layout, decoded together: their bytes as rows of a matrix."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from agv_motion.bag.cdr import Leaf, Segment, Walk
    from agv_motion.bag.record_parsing import Buffer
    from agv_motion.bag.text_codes import TextCodes

NUMPY = {'bool': 'u1', 'byte': 'i1', 'char': 'u1', 'length': 'u4', 'string': 'u4'}
NUMPY |= {
    f'{kind}{bits}': f'{kind[0]}{bits // 8}' for kind in ('int', 'uint') for bits in (8, 16, 32, 64)
}
NUMPY |= {'float32': 'f4', 'float64': 'f8'}
"""numpy's names of the primitives (``byte`` is signed, as in rosbags), texts and lengths"""
_WORD = 8


class _Span(NamedTuple):
    """Words that tell messages of a layout from others."""

    words: slice
    mask: NDArray[np.uint64]
    expected: NDArray[np.uint64]
    plain: NDArray[np.uint64]
    """what is expected, without the mask"""

    def differ(self, words: NDArray[np.uint64]) -> bool:
        """Return whether any row differs, be it in bytes that are not compared."""
        return bool((words[:, self.words] != self.plain).any())

    def differences(self, words: NDArray[np.uint64]) -> NDArray[np.uint64]:
        return (words[:, self.words] ^ self.expected) & self.mask


class Pattern:
    """What one message says of all that agree with it in every length."""

    def __init__(
        self, walk: Walk, leaves: Sequence[Leaf], data: Buffer, start: int, order: str
    ) -> None:
        """Learn from a message.

        Args:
            walk: Through the message.
            leaves: The wanted ones.
            data: Buffer that holds the message.
            start: [bytes] where its content begins.
            order: '<' little-endian or '>' big-endian.

        """
        self._order = order
        self._segments = {leaf.number: walk.found[leaf.number] for leaf in leaves}
        self._leaves = leaves
        texts = [s for leaf in leaves if leaf.type == 'string' for s in self._segments[leaf.number]]
        spans = [
            (first, last)
            for leaf in leaves
            for first, last in map(_extent, self._segments[leaf.number])
            if leaf.type != 'length' and last > first
        ]
        reach = max([last for _, last in spans], default=0)
        lengths = [
            s[2] for leaf in leaves if leaf.type == 'length' for s in walk.found[leaf.number]
        ]
        reach = min(max([reach, *(position + 4 for position in lengths)]), walk.size)
        guards = [(position, position + 4) for position in walk.guards if position < reach]
        first = min((begin for begin, _ in [*spans, *guards]), default=0)
        self._first = first - first % _WORD
        self._pitch = max(_WORD, (reach - self._first + _WORD - 1) // _WORD * _WORD)
        content = bytes(data[start + self._first : start + reach])
        content = content.ljust(self._pitch, b'\0')
        self._guards = self._spans(content, guards)
        self._texts = self._spans(content, [*guards, *((o, o + n) for o, n, _ in texts)])
        self._content = content
        self._plain = True

    def rows(self, data: Buffer, starts: NDArray[np.int64]) -> NDArray[np.uint64]:
        """Return the bytes of messages, padded to whole words, as a matrix of words."""
        places, room = starts + self._first, len(data) - self._pitch + 1
        short = np.flatnonzero(places >= room)
        if room < 1:
            data, room = bytes(data).ljust(self._pitch + len(data), b'\0'), len(data) + 1
            short = short[:0]
        windows = np.ndarray((room,), np.dtype((np.void, self._pitch)), data, strides=(1,))
        if not len(short):
            rows = windows[places]
        else:
            rows = windows[np.minimum(places, room - 1)]
            for row in short:
                tail = bytes(data[places[row] : places[row] + self._pitch])
                rows[row] = np.void(tail.ljust(self._pitch, b'\0'))
        return rows.view('<u8').reshape(len(starts), -1)

    def agree(self, rows: NDArray[np.uint64]) -> NDArray[np.bool_] | None:
        """Return which rows have this layout; None if all have, and the same texts too."""
        if self._plain and not any(span.differ(rows) for span in self._texts):
            return None
        if not any(span.differences(rows).any() for span in self._texts):
            self._plain = False  # the bytes in between change: they must be masked
            return None
        agree = np.ones(len(rows), bool)
        for span in self._guards:
            agree &= ~span.differences(rows).any(axis=1)
        return agree

    def values(
        self,
        rows: NDArray[np.uint64],
        leaf: Leaf,
        texts: Mapping[int, TextCodes],
        *,
        same_texts: bool,
    ) -> NDArray[Any]:
        """Return the values of a leaf in rows that agree, of shape (rows, values)."""
        segments = self._segments[leaf.number]
        if leaf.type == 'length':
            lengths = np.array([length for length, _, _ in segments], np.uint32)
            return np.broadcast_to(lengths, (len(rows), len(segments)))
        if leaf.type == 'string':
            return self._codes(rows, segments, texts[leaf.number], same_texts=same_texts)
        dtype = np.dtype(self._order + NUMPY[leaf.type])
        parts = [
            np.ndarray((len(rows), n), dtype, rows, at - self._first, (self._pitch, step))
            for at, n, step in segments
        ]
        if len(parts) == 1:
            return parts[0]
        return np.concatenate(parts, axis=1) if parts else np.empty((len(rows), 0), dtype)

    def _codes(
        self,
        rows: NDArray[np.uint64],
        segments: Sequence[Segment],
        texts: TextCodes,
        *,
        same_texts: bool,
    ) -> NDArray[np.uint32]:
        places = [
            (at - self._first, max(at - self._first, at - self._first + size - 1))
            for at, size, _ in segments
        ]
        if same_texts:
            same = np.array([texts.code(self._content[a:b]) for a, b in places], np.uint32)
            return np.broadcast_to(same, (len(rows), len(segments)))
        codes = np.empty((len(rows), len(segments)), np.uint32)
        data = rows.tobytes()
        for column, (a, b) in enumerate(places):
            begins = range(a, a + len(data), self._pitch)
            size = b - a
            codes[:, column] = [texts.code(data[i : i + size]) for i in begins]
        return codes

    def _spans(self, content: bytes, intervals: Sequence[tuple[int, int]]) -> list[_Span]:
        """Return the words that hold the bytes of some intervals."""
        mask = np.zeros(self._pitch, np.uint8)
        for first, last in intervals:
            mask[first - self._first : last - self._first] = 0xFF
        words = mask.view('<u8')
        plain = np.frombuffer(content, '<u8')
        expected = plain & words
        used = np.flatnonzero(words)
        if not len(used):
            return []
        breaks = np.flatnonzero(np.diff(used) > 1) + 1
        return [
            _Span(slice(part[0], part[-1] + 1), words[part], expected[part], plain[part])
            for part in np.split(used, breaks)
        ]


def _extent(segment: Segment) -> tuple[int, int]:
    """Return where a segment begins and ends."""
    offset, count, stride = segment
    return offset, offset + count * stride
