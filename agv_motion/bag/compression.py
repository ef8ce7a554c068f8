"""Compression of chunks, as MCAP names it: '' (none), 'lz4' or 'zstd'."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import lz4.frame
import zstandard

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable

    Buffer = bytes | memoryview

_FAST = 1
"""Level at which zstd keeps up with a full link; higher ones gain little on floats."""
_WIDEST_WINDOW = 1 << 27
"""[bytes] Memory that a zstd frame may ask for; level 19 asks for 8 MiB."""
_PIECE = 1 << 17
_AT_ONCE = 1 << 26
"""[bytes]"""
_of_thread = threading.local()


def compressor(name: str) -> Callable[[bytes], bytes]:
    """Return the function that compresses a chunk.

    Raises:
        ConfigurationError: ``name`` is none of '', 'lz4' and 'zstd'.

    """
    if name == 'zstd':
        return _compress_zstd
    if name == 'lz4':
        return lz4.frame.compress  # type: ignore[no-any-return] # lz4 has no types
    if name == '':
        return bytes
    msg = f"compression {name!r}: choose one of 'zstd', 'lz4', 'none'"
    raise ConfigurationError(msg)


def decompress(name: str, stored: Buffer, size: int) -> Buffer:
    """Return exactly ``size`` bytes; more memory than that is never taken.

    Args:
        name: '', 'lz4' or 'zstd'.
        stored: The compressed bytes.
        size: [bytes] that they must become.

    Raises:
        ValueError: They are damaged, or become something else.

    """
    if name == 'zstd':
        data: Buffer = _zstd(stored, size)
    elif name == 'lz4':
        data = _lz4(stored, size)
    elif name == '':
        data = stored
    else:
        msg = f"compression {name!r}, expected '', 'lz4' or 'zstd'"
        raise ValueError(msg)
    if len(data) != size:
        msg = f'{len(data)} bytes where {size} were announced'
        raise ValueError(msg)
    return data


def decompress_into(name: str, stored: Buffer, target: memoryview) -> None:
    """Fill ``target`` to its end; arguments and errors as of :func:`decompress`."""
    if name != 'zstd':
        target[:] = decompress(name, stored, len(target))
        return
    reader = _zstd_decompressor().stream_reader(stored, read_across_frames=True)
    filled = 0
    try:
        while more := reader.readinto(target[filled:]):
            filled += more  # where more comes than has place, zstd raises
    except zstandard.ZstdError as error:
        msg = f'zstd: {error}'
        raise ValueError(msg) from None
    if filled != len(target):
        msg = f'{filled} bytes where {len(target)} were announced'
        raise ValueError(msg)


def salvage(name: str, stored: Buffer, limit: int) -> bytes:
    """Return what can be decompressed of bytes whose end is missing, at most ``limit`` bytes."""
    if name == '':
        return bytes(stored[:limit])
    try:
        return _zstd_by_piece(stored, limit) if name == 'zstd' else _lz4_by_piece(stored, limit)
    except ValueError:
        return b''


def _compress_zstd(data: bytes) -> bytes:
    """Compress by the compressor of this thread: a new one takes fresh memory for each chunk."""
    found: zstandard.ZstdCompressor | None = getattr(_of_thread, 'zstd_compressor', None)
    if found is None:
        found = zstandard.ZstdCompressor(level=_FAST)
        _of_thread.zstd_compressor = found
    return found.compress(data)


def _zstd_decompressor() -> zstandard.ZstdDecompressor:
    """Return the decompressor of this thread: making one costs as much as a small chunk."""
    found: zstandard.ZstdDecompressor | None = getattr(_of_thread, 'zstd', None)
    if found is None:
        found = zstandard.ZstdDecompressor(max_window_size=_WIDEST_WINDOW)
        _of_thread.zstd = found
    return found


def _zstd(stored: Buffer, size: int) -> bytes:
    try:
        announced = zstandard.get_frame_parameters(stored).content_size
        if announced == size:
            return _zstd_decompressor().decompress(stored, max_output_size=size)
        if announced > size and announced != zstandard.CONTENTSIZE_UNKNOWN:
            msg = f'zstd: a frame of {announced} bytes where {size} were announced'
            raise ValueError(msg)
    except zstandard.ZstdError as error:
        msg = f'zstd: {error}'
        raise ValueError(msg) from None
    return _zstd_by_piece(stored, size + 1)  # several frames, or one that hides its size


def _zstd_by_piece(stored: Buffer, limit: int) -> bytes:
    reader = zstandard.ZstdDecompressor(max_window_size=_WIDEST_WINDOW).stream_reader(
        stored, read_across_frames=True
    )
    pieces, left = [], limit
    while left:
        try:
            piece = reader.read(min(left, _PIECE))
        except zstandard.ZstdError:
            break
        if not piece:
            break
        pieces.append(piece)
        left -= len(piece)
    return b''.join(pieces)


def _lz4(stored: Buffer, size: int) -> bytes:
    if size > _AT_ONCE:
        return _lz4_by_piece(stored, size + 1)  # memory only for what really comes out
    try:
        data: bytes = lz4.frame.LZ4FrameDecompressor().decompress(stored, max_length=size + 1)
    except (RuntimeError, EOFError, MemoryError) as error:
        msg = f'lz4: {error}'
        raise ValueError(msg) from None
    return data


def _lz4_by_piece(stored: Buffer, limit: int) -> bytes:
    """Return what comes out before the first damaged block."""
    frame, pieces, left = lz4.frame.LZ4FrameDecompressor(), [], limit
    data = bytes(stored)
    while left:
        try:
            piece = frame.decompress(data, max_length=min(left, _PIECE))
        except (RuntimeError, EOFError, MemoryError):
            break
        if not piece:
            break
        data = b''
        pieces.append(piece)
        left -= len(piece)
    return b''.join(pieces)


def decompress_message(stored: Buffer, largest: int) -> bytes:
    """Return a message that rosbag2 compressed by itself, with zstd.

    Raises:
        ValueError: It is damaged, or becomes more than ``largest`` bytes.

    """
    data = _zstd_by_piece(stored, largest + 1)
    try:
        announced = zstandard.get_frame_parameters(stored).content_size
    except zstandard.ZstdError as error:
        msg = f'zstd: {error}'
        raise ValueError(msg) from None
    unknown = announced in (zstandard.CONTENTSIZE_UNKNOWN, len(data))
    if not unknown or len(data) > largest:
        msg = f'{len(data)} bytes where {announced} were announced and {largest} are allowed'
        raise ValueError(msg)
    return data
