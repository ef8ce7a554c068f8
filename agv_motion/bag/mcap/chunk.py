"""A chunk of an MCAP file: where it lies, what time it spans, and which indexes it has."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.mcap import records

if TYPE_CHECKING:
    from collections.abc import Mapping

INDEX_HEAD, INDEX_ENTRY = 6, 16
"""[bytes] Channel and size before the entries of a message index, and each of them."""


class Chunk(NamedTuple):
    """A chunk, or a stretch of messages outside chunks, which then is its own content."""

    offset: int
    """[bytes] of its record in the file"""
    length: int
    """[bytes] of the record"""
    start: int
    """[ns] log time of the first message"""
    end: int
    """[ns] log time of the last message"""
    size: int
    """[bytes] of its content, uncompressed"""
    indexes: Mapping[int, int] | None
    """where the message index of each channel lies; None: there is none, walk the content"""
    bare: bool = False
    """a stretch of messages outside chunks"""
    torn: bool = False
    """its end is missing"""
    index_length: int = 0
    """[bytes] of the message indexes that follow it, by the summary"""

    @property
    def indexed_messages(self) -> int:
        """How many messages its indexes tell of, by their length in the summary."""
        heads = len(self.indexes or ()) * (records.PREFIX.size + INDEX_HEAD)
        return (self.index_length - heads) // INDEX_ENTRY if self.indexes else 0

    @property
    def filled(self) -> bool:
        """Whether it has messages, as far as its indexes tell."""
        return self.indexes is None or bool(self.indexes)

    @property
    def unindexed(self) -> bool:
        """Whether only a walk through its content tells what is in it."""
        return self.indexes is None and not self.bare
