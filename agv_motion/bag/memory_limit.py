"""How much memory one piece of a bag may take on this machine."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

_SHARE = 4
_MOST, _LEAST = 1 << 32, 1 << 28
"""[bytes]"""
_CONTAINER = (
    Path('/sys/fs/cgroup/memory.max'),
    Path('/sys/fs/cgroup/memory/memory.limit_in_bytes'),
)
"""Where Linux tells what a container may take."""


def largest() -> int:
    """Return the size [bytes] that a chunk or message may have: a quarter of the memory, or 4 GiB.

    A hostile file may announce anything; an honest one of that size can be read.
    """
    have = _MOST * _SHARE
    with suppress(ValueError, OSError, AttributeError):
        have = min(have, os.sysconf('SC_PHYS_PAGES') * os.sysconf('SC_PAGE_SIZE'))
    for path in _CONTAINER:
        with suppress(ValueError, OSError):
            have = min(have, int(path.read_text(encoding='utf-8')))
    return max(have // _SHARE, _LEAST)
