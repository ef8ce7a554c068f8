"""One MCAP file as a storage: messages in time order, by columns, or as far as they are whole."""

from __future__ import annotations

from typing import TYPE_CHECKING, final

import numpy as np

from agv_motion.bag.columns.message_batches import of_messages
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import record_parsing, records, scan
from agv_motion.bag.mcap.batches import read_mcap
from agv_motion.bag.mcap.channels import connections
from agv_motion.bag.mcap.chunk_content import message_offsets
from agv_motion.bag.mcap.chunked_file import ChunkedFile
from agv_motion.bag.mcap.mapped import mapped
from agv_motion.bag.mcap.runs import runs
from agv_motion.bag.mcap.time_order import in_time_order

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.bag.columns.batch import Batch
    from agv_motion.bag.connection import Message
    from agv_motion.bag.mcap.chunk import Chunk


@final
class McapFile(ChunkedFile):
    """Reads the messages of a file with or without index, whole or torn."""

    def __init__(self, path: Path, *, validate: bool = True, unpacked: Path | None = None) -> None:
        """Map the file and find out what is in it.

        Args:
            path: The file.
            validate: Compare chunks with their CRC, where the file has one.
            unpacked: Where it lies unpacked, if it is compressed as a whole; bytes are its.

        Raises:
            SourceError: It cannot be opened, or is no MCAP file.

        """
        data = mapped(path, unpacked or path)
        found = scan.look(data, path)
        super().__init__(path, data, found, connections(found), validate=validate)

    def messages(self, channels: Collection[int], start: int, stop: int) -> Iterator[Message]:
        """Yield messages in the order of their log time.

        Args:
            channels: Their ids.
            start: [ns] first log time.
            stop: [ns] log time before which to stop.

        Raises:
            DamagedBagError: What comes next is damaged.

        """
        return in_time_order(runs(self, frozenset(channels), range(start, stop)))

    def batches(
        self,
        channels: Collection[int],
        start: int,
        stop: int,
        put: Callable[[Batch], None],
        *,
        compressed: bool = False,
    ) -> None:
        """Hand over messages many at a time, as they lie in the file; see :class:`Storage`.

        Raises:
            DamagedBagError: A chunk, or a message, is damaged.

        """
        if not compressed:
            read_mcap(self, channels, start, stop, put)
            return
        for batch in of_messages(self, channels, start, stop, compressed=True):
            put(batch)

    def log_times(self, channels: Collection[int]) -> Iterator[tuple[int, NDArray[np.int64]]]:
        """Yield ids with some of their log times [ns]; a file with an index is not unpacked.

        Raises:
            DamagedBagError: A chunk or its index is damaged.

        """
        for chunk in self.chunks:
            for channel, entries in self.entries(chunk).items():
                if channel in channels:
                    yield channel, entries.stamps.astype(np.int64)

    def pieces(self) -> Iterator[tuple[float, Iterator[Message]]]:
        """Yield the messages of each chunk as they lie in it, and which share of the file is done.

        Each iterator raises a DamagedBagError where its chunk is damaged; the others go on.
        """
        for number, chunk in enumerate(self.chunks):
            yield number / len(self.chunks), self.walk(chunk)

    def walk(self, chunk: Chunk) -> Iterator[Message]:
        """Yield the whole messages of a chunk as they lie in it, whatever its index says.

        Raises:
            DamagedBagError: It is damaged, or has messages of channels that nothing describes.

        """
        unpacked = self.unpacked(chunk)
        offsets = message_offsets(unpacked)
        found = self.heads(chunk, unpacked, offsets)
        known = np.isin(found['channel'], list(self.channels))
        yield from self.messages_at(unpacked, offsets[known].tolist())
        self.require_described(chunk, found)
        self.release_chunk(chunk)

    def extras(self) -> Iterator[records.Attachment | records.Metadata | DamagedBagError]:
        """Yield the attachments and named strings that are whole, and what is wrong with others."""
        for opcode, at, end in self._between_chunks():
            body = record_parsing.Body(self.data[at:end], self.path, at)
            try:
                if opcode == records.ATTACHMENT:
                    yield record_parsing.attachment(body)
                elif opcode == records.METADATA:
                    yield record_parsing.metadata(body)
            except DamagedBagError as error:
                yield error

    def _between_chunks(self) -> Iterator[tuple[int, int, int]]:
        """Yield opcode, body and end of the records before the end of the data.

        What the summary tells of, chunks and their indexes, is passed over: a large file has many.
        """
        known = [c for c in self.chunks if self.indexed and not c.bare]
        begins = [len(records.MAGIC), *(c.offset + c.length + c.index_length for c in known)]
        ends = [*(c.offset for c in known), len(self.data)]
        for begin, end in zip(begins, ends, strict=True):
            for record in record_parsing.walk(self.data, begin, end):
                yield record
                if record[0] == records.DATA_END:
                    return

    def as_chunks(self) -> ChunkedFile:
        """Return the file as chunks that can be copied whole."""
        return self

    def damage(self) -> Iterator[str]:
        """Yield what is wrong with chunks, their CRCs and the totals; reads the whole file."""
        counted = [self._count(chunk) for chunk in self.chunks]
        seen = sum(count for count in counted if isinstance(count, int))
        yield from (str(count) for count in counted if not isinstance(count, int))
        unlike = self._unlike_crc()
        if unlike and str(unlike) not in map(str, self.problems):
            yield str(unlike)
        if self.statistics is not None and self.statistics.messages != seen:
            yield f'{seen} messages, but its statistics tell of {self.statistics.messages}'

    def _count(self, chunk: Chunk) -> int | DamagedBagError:
        """Return how many messages a chunk has, or what is wrong with it."""
        try:
            content = self.unpacked(chunk)
            return sum(len(entries.stamps) for entries in self.entries(chunk, content).values())
        except DamagedBagError as error:
            return error
        finally:
            self.release_chunk(chunk)

    def _unlike_crc(self) -> DamagedBagError | None:
        """Return what is wrong where the data do not match the CRC at their end."""
        for opcode, at, _ in self._between_chunks():
            if opcode == records.DATA_END:
                return scan.unlike_crc(self.data, self.path, at - records.PREFIX.size)
        return None

    def require_whole(self) -> None:
        """Compare all bytes with the CRC at the end of the data, where the file has one.

        Raises:
            DamagedBagError: One of them is wrong.

        """
        wrong = self._unlike_crc()
        if wrong is not None:
            raise wrong
