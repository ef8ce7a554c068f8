"""Chunks that overlap in time, kept unpacked for a while: their messages are read in turns."""

from __future__ import annotations

from collections import OrderedDict
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.bag.mcap.chunk import Chunk
    from agv_motion.bag.mcap.record_parsing import Buffer

CACHE = 1 << 27
"""[bytes] up to which contents are kept; beyond, the oldest is unpacked again when it is wanted"""


class ChunkCache:
    """The contents of some chunks."""

    def __init__(self) -> None:
        """Keep none yet."""
        self._kept: OrderedDict[int, Buffer] = OrderedDict()
        self._size = 0

    def content(self, chunk: Chunk, unpack: Callable[[Chunk], Buffer]) -> Buffer:
        """Return the content of a chunk, which ``unpack`` makes where it is not kept."""
        unpacked = self._kept.get(chunk.offset)
        if unpacked is None:
            unpacked = unpack(chunk)
            self._kept[chunk.offset] = unpacked
            self._size += len(unpacked)
            while self._size > CACHE and len(self._kept) > 1:
                self._size -= len(self._kept.popitem(last=False)[1])
        return unpacked

    def forget(self, chunk: Chunk) -> None:
        """Keep the content of a chunk no more: what comes next is unpacked into its memory."""
        self._size -= len(self._kept.pop(chunk.offset, b''))

    def clear(self) -> None:
        """Keep none any more."""
        self._kept.clear()
        self._size = 0
