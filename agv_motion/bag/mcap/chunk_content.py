"""What is in the chunks of an MCAP file: their content unpacked, and where its messages lie."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from agv_motion.bag.compression import decompress, decompress_into, salvage
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import record_parsing as parsing
from agv_motion.bag.mcap import records
from agv_motion.bag.mcap.checksum import crc32
from agv_motion.bag.mcap.message_heads import HEAD
from agv_motion.bag.memory_limit import largest

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.bag.mcap.chunk import Chunk
    from agv_motion.bag.mcap.record_parsing import Buffer

LARGEST = largest()
"""[bytes] Content of a chunk, uncompressed."""
RATIOS = {'': 1, 'lz4': 256, 'zstd': 1 << 16}
"""By how much a chunk can shrink at most, by its compression; who announces more lies."""


def content(
    data: memoryview,
    chunk: Chunk,
    path: Path,
    *,
    validate: bool,
    target: memoryview | None = None,
) -> Buffer:
    """Return the uncompressed content of a chunk; of a torn one, what can be saved.

    Args:
        data: The whole file.
        chunk: Which.
        path: The file, for errors.
        validate: Compare with the CRC, where the file has one.
        target: Write it here, if it has room for ``chunk.size`` bytes.

    Raises:
        DamagedBagError: It is damaged, or larger than ``LARGEST``.

    """
    end = chunk.offset + chunk.length
    if chunk.bare:
        return data[chunk.offset : end]
    head, stored = stored_content(data, chunk, path)
    if chunk.torn:
        return salvage(head.compression, stored, head.size)
    try:
        if target is None or head.size != chunk.size:
            unpacked = decompress(head.compression, stored, head.size)
        else:
            unpacked = target[: head.size]
            decompress_into(head.compression, stored, unpacked)
    except ValueError as error:
        raise DamagedBagError(path, chunk.offset, f'a chunk that is damaged ({error})') from None
    if validate and head.crc and crc32(unpacked) != head.crc:
        finding = f'a chunk with CRC {crc32(unpacked):08x}, expected {head.crc:08x}'
        raise DamagedBagError(path, chunk.offset, finding)
    return unpacked


def stored_content(
    data: memoryview, chunk: Chunk, path: Path
) -> tuple[parsing.ChunkHead, memoryview]:
    """Return what stands before the content of a chunk, and the content as it is stored.

    Raises:
        DamagedBagError: It cannot be as large as it says, or ends elsewhere.

    """
    end = chunk.offset + chunk.length
    body = chunk.offset + records.PREFIX.size
    head = parsing.chunk_head(parsing.Body(data[body:end], path, body), body)
    ratio = RATIOS.get(head.compression)
    if ratio is None:
        finding = f"a chunk compressed by {head.compression[:50]!r}, expected '', 'lz4' or 'zstd'"
        raise DamagedBagError(path, chunk.offset, finding)
    if head.size > min(LARGEST, head.stored * ratio):
        finding = (
            f'a chunk of {head.size} bytes out of {head.stored}, expected at most {LARGEST}, '
            f'and {ratio} times as many as are stored'
        )
        remedy = 'a machine with more memory may read it' if head.size > LARGEST else ''
        if not chunk.torn or remedy:
            raise DamagedBagError(path, chunk.offset, finding, remedy)
    if head.content + head.stored != end and not chunk.torn:
        finding = f'a chunk that ends at byte {head.content + head.stored}, expected {end}'
        raise DamagedBagError(path, chunk.offset, finding)
    return head, data[head.content : head.content + head.stored]


def message_offsets(unpacked: Buffer) -> NDArray[np.int64]:
    """Return where the whole messages of a chunk's content lie, by walking through it."""
    shortest = HEAD.itemsize - records.PREFIX.size
    return np.fromiter(
        (
            body - records.PREFIX.size
            for opcode, body, end in parsing.walk(unpacked, 0, len(unpacked))
            if opcode == records.MESSAGE and end - body >= shortest
        ),
        np.int64,
    )
