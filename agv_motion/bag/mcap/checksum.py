"""CRC-32 as MCAP uses it, by Intel's library where that is installed: three times as fast."""

from __future__ import annotations

try:
    from isal.isal_zlib import crc32
except ImportError:  # no wheel for this processor
    from zlib import crc32

__all__ = ['crc32']
