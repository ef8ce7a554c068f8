"""One MCAP file, mapped into memory: what it holds, its chunks, and its messages in time order."""

from __future__ import annotations

import mmap
from collections import OrderedDict
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag import connection as connections
from agv_motion.bag import mcap_scan, mcap_summary, records
from agv_motion.bag import record_parsing as parsing
from agv_motion.bag.chunk import Chunk, content, heads, message_offsets
from agv_motion.bag.connection import Connection, Message
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.time_order import Run, in_time_order
from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.bag.record_parsing import Buffer

CACHE = 1 << 28
"""[bytes] Chunks that overlap in time are kept unpacked up to this size, then unpacked again."""
_ENTRY = 16


class Entries(NamedTuple):
    """Where some messages of a chunk lie."""

    stamps: NDArray[np.uint64]
    """[ns] log time of each"""
    offsets: NDArray[Any]
    """[bytes] of each in the content of the chunk"""


class McapFile:
    """Reads a file with or without index, whole or torn."""

    def __init__(self, path: Path, *, validate: bool = True, scan: bool = False) -> None:
        """Map the file and find out what is in it.

        Args:
            path: The file.
            validate: Compare chunks with their CRC, where the file has one.
            scan: Walk through the file even if it has a summary.

        Raises:
            SourceError: It cannot be opened, or is no MCAP file.

        """
        self.path = path
        self._validate = validate
        self._data = _mapped(path)
        self._cache: OrderedDict[int, Buffer] = OrderedDict()
        found, problems = None, []
        if not scan:
            try:
                found = mcap_summary.read(self._data, path)
            except DamagedBagError as error:
                problems.append(error)
        self._summary = found or mcap_scan.scan(self._data, path)
        self.problems = [*problems, *self._summary.problems]
        """what is amiss in the file, though it can be read"""
        self.indexed = self._summary.indexed
        """whether the summary at its end was there to be used"""
        self.statistics = self._summary.statistics
        self.chunks = self._summary.chunks
        self.channels: Mapping[int, Connection] = {
            number: connections.from_channel(channel, self._summary.schemas)
            for number, channel in self._summary.channels.items()
        }

    @property
    def span(self) -> tuple[int, int] | None:
        """Log time of the first and the last message [ns]; None without messages."""
        filled = [chunk for chunk in self.chunks if self._filled(chunk)]
        if not filled:
            return None
        return min(chunk.start for chunk in filled), max(chunk.end for chunk in filled)

    def counts(self) -> dict[int, int]:
        """Return the number of messages of each channel."""
        if self.statistics is not None and self.statistics.channel_messages:
            return dict(self.statistics.channel_messages)
        counts = dict.fromkeys(self.channels, 0)
        for chunk in self.chunks:
            for channel, entries in self.entries(chunk).items():
                counts[channel] = counts.get(channel, 0) + len(entries.stamps)
        return counts

    def entries(self, chunk: Chunk) -> dict[int, Entries]:
        """Return where the messages of each channel lie in a chunk.

        Raises:
            DamagedBagError: The index or the chunk is damaged.

        """
        if chunk.indexes is not None:
            return {channel: self._indexed(channel, at) for channel, at in chunk.indexes.items()}
        unpacked = self.content(chunk)
        offsets = message_offsets(unpacked)
        found = self.heads(chunk, unpacked, offsets)
        channels = found['channel']
        entries = {}
        for channel in np.unique(channels):
            mine = channels == channel
            entries[int(channel)] = Entries(found['stamp'][mine], offsets[mine])
        return entries

    def content(self, chunk: Chunk) -> Buffer:
        """Return the uncompressed content of a chunk.

        Raises:
            DamagedBagError: It is damaged.

        """
        unpacked = self._cache.get(chunk.offset)
        if unpacked is None:
            unpacked = content(self._data, chunk, self.path, validate=self._validate)
            self._cache[chunk.offset] = unpacked
            kept = sum(map(len, self._cache.values()))
            while kept > CACHE and len(self._cache) > 1:
                kept -= len(self._cache.popitem(last=False)[1])
        return unpacked

    def heads(self, chunk: Chunk, unpacked: Buffer, offsets: NDArray[Any]) -> NDArray[Any]:
        """Return what stands before the messages at ``offsets`` of a chunk's content.

        Raises:
            DamagedBagError: There is no message at one of them.

        """
        try:
            return heads(unpacked, offsets)
        except ValueError as error:
            raise DamagedBagError(self.path, chunk.offset, f'in this chunk, {error}') from None

    def messages(self, channels: Collection[int], start: int, stop: int) -> Iterator[Message]:
        """Yield messages in the order of their log time.

        Args:
            channels: Their ids.
            start: [ns] first log time.
            stop: [ns] log time before which to stop.

        Raises:
            DamagedBagError: What comes next is damaged.

        """
        chunks = sorted((c for c in self.chunks if self._filled(c)), key=lambda c: c.start)
        wanted = frozenset(channels)
        opened = (
            (chunk.start, chunk.offset, self._opener(chunk, wanted, start, stop))
            for chunk in chunks
            if chunk.end >= start and chunk.start < stop
        )
        return in_time_order(opened)

    def close(self) -> None:
        """Let go of the file; messages already read stay valid."""
        self._cache.clear()
        self._data = memoryview(b'')

    def _opener(
        self, chunk: Chunk, wanted: frozenset[int], start: int, stop: int
    ) -> Callable[[], Run | None]:
        """Return what opens a chunk when its time has come."""

        def opened() -> Run | None:
            found = [e for channel, e in self.entries(chunk).items() if channel in wanted]
            if not found:
                return None
            stamps = np.concatenate([e.stamps for e in found])
            offsets = np.concatenate([e.offsets for e in found])
            inside = (stamps >= start) & (stamps < np.uint64(min(stop, 2**64 - 1)))
            stamps, offsets = stamps[inside], offsets[inside]
            order = np.lexsort((offsets, stamps))
            self._described(chunk, self.heads(chunk, self.content(chunk), offsets))
            places = offsets[order].tolist()
            return Run(stamps[order].tolist(), lambda a, b: self._messages(chunk, places[a:b]))

        return opened

    def _messages(self, chunk: Chunk, offsets: list[int]) -> Iterator[Message]:
        unpacked = memoryview(self.content(chunk))
        unpack, size, prefix = records.MESSAGE_HEAD.unpack_from, records.MESSAGE_HEAD.size, 9
        channels = self.channels
        for offset in offsets:
            _, length, channel, sequence, stamp, publish = unpack(unpacked, offset)
            data = bytes(unpacked[offset + size : offset + prefix + length])
            yield Message(channels[channel], stamp, data, publish, sequence)

    def _described(self, chunk: Chunk, found: NDArray[Any]) -> None:
        for channel in np.unique(found['channel']):
            if int(channel) not in self.channels:
                finding = f'in this chunk, a message of channel {channel}, which is not described'
                raise DamagedBagError(self.path, chunk.offset, finding)

    def _indexed(self, channel: int, at: int) -> Entries:
        size = records.PREFIX.size
        if at + size > len(self._data):
            finding = f'a message index at byte {at} of a file of {len(self._data)}'
            raise DamagedBagError(self.path, at, finding)
        opcode, length = records.PREFIX.unpack_from(self._data, at)
        end = at + size + length
        if opcode != records.MESSAGE_INDEX or end > len(self._data):
            raise DamagedBagError(self.path, at, 'no message index where the summary says')
        found, pairs = parsing.message_index(
            parsing.Body(self._data[at + size : end], self.path, at + size)
        )
        if found != channel or len(pairs) % _ENTRY:
            finding = f'a message index of channel {found} with {len(pairs)} bytes'
            raise DamagedBagError(self.path, at, f'{finding}, expected channel {channel}')
        table = np.frombuffer(pairs, '<u8').reshape(-1, 2)
        return Entries(table[:, 0], table[:, 1])

    def _filled(self, chunk: Chunk) -> bool:
        return chunk.indexes is None or bool(chunk.indexes)


def _mapped(path: Path) -> memoryview:
    """Return the bytes of an MCAP file.

    Raises:
        SourceError: It cannot be opened, or is no MCAP file.

    """
    try:
        with path.open('rb') as file:
            data = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
    except OSError as error:
        msg = f'{path} cannot be read: {error.strerror}'
        raise SourceError(msg) from error
    except ValueError:
        msg = f'{path} is empty: nothing was written before the recording ended'
        raise SourceError(msg) from None
    if data[: len(records.MAGIC)] != records.MAGIC:
        msg = f'{path} is no MCAP file: it begins with {bytes(data[:8])!r}'
        raise SourceError(msg)
    return data
