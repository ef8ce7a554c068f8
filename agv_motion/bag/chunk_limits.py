"""How much goes into a chunk of a bag."""

from __future__ import annotations

from math import inf, isfinite
from typing import NamedTuple

from agv_motion.errors import ConfigurationError


class ChunkLimits(NamedTuple):
    """A chunk that has as much, or spans as much, is written."""

    size: int
    """[bytes] uncompressed"""
    span: float
    """[ns] of log time"""


def chunk_limits(chunk_size: int, chunk_duration: float) -> ChunkLimits:
    """Return limits in bytes and seconds.

    Raises:
        ConfigurationError: One is not positive.

    """
    if not (chunk_size >= 1 and chunk_duration > 0.0):
        msg = (
            f'chunk_size {chunk_size} and chunk_duration {chunk_duration}: '
            'both must be positive; 1 MiB and 1 s suit most'
        )
        raise ConfigurationError(msg)
    span = int(chunk_duration * 1e9) if isfinite(chunk_duration) else inf
    return ChunkLimits(chunk_size, span)
