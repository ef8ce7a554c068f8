"""Compression of chunks, as MCAP names it: '' (none), 'lz4' or 'zstd'."""

from __future__ import annotations

from typing import TYPE_CHECKING

import lz4.frame
import zstandard

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable

_FAST = 1
"""Level at which zstd keeps up with a full link; higher ones gain little on floats."""


def compressor(name: str) -> Callable[[bytes], bytes]:
    """Return the function that compresses a chunk.

    Raises:
        ConfigurationError: ``name`` is none of '', 'lz4' and 'zstd'.

    """
    if name == 'zstd':
        return zstandard.ZstdCompressor(level=_FAST).compress
    if name == 'lz4':
        return lz4.frame.compress  # type: ignore[no-any-return] # lz4 has no types
    if name == '':
        return bytes
    msg = f"compression {name!r}: choose one of 'zstd', 'lz4', 'none'"
    raise ConfigurationError(msg)
