"""The bytes of a file, mapped into memory: they are read when they are looked at."""

from __future__ import annotations

import mmap
from typing import TYPE_CHECKING

from agv_motion.bag.mcap import records
from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from pathlib import Path


def mapped(path: Path, place: Path) -> memoryview:
    """Return the bytes of an MCAP file; they lie at a place, which errors do not name.

    Raises:
        SourceError: It cannot be opened, or is no MCAP file.

    """
    try:
        with place.open('rb') as file:
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


def release(data: memoryview, begin: int, end: int) -> None:
    """Take a part of a file [bytes] out of the memory of this process; it stays readable."""
    source, first, end = data.obj, -(-begin // mmap.PAGESIZE) * mmap.PAGESIZE, min(end, len(data))
    if isinstance(source, mmap.mmap) and hasattr(mmap, 'MADV_DONTNEED') and first < end:
        source.madvise(mmap.MADV_DONTNEED, first, end - first)
