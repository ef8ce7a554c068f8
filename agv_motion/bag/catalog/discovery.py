"""Which bags lie in a folder and in those below it, and whether one has changed."""

from __future__ import annotations

import os
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.bag.metadata import FILE_NAME

if TYPE_CHECKING:
    from collections.abc import Iterator

ENDINGS = ('.mcap', '.db3', '.mcap.zstd', '.db3.zstd')


def bags_below(folder: Path) -> Iterator[Path]:
    """Yield all bags: folders with a description, and single files elsewhere.

    Hidden folders are passed over, and links that lead back to a folder that was looked at.
    """
    seen: set[str] = set()
    for place, folders, files in os.walk(folder, followlinks=True):
        real = os.path.realpath(place)
        if real in seen:
            folders.clear()
            continue
        seen.add(real)
        here = Path(place)
        if FILE_NAME in files:
            folders.clear()
            yield here
            continue
        folders[:] = sorted(name for name in folders if not name.startswith('.'))
        for name in sorted(files):
            if name.endswith(ENDINGS) and not name.startswith('.'):
                yield here / name


def signature(bag: Path) -> str:
    """Return what changes when a bag does: names, sizes and times of its files.

    Raises:
        OSError: It is gone.

    """
    files = sorted(bag.iterdir()) if bag.is_dir() else [bag]
    told = [(p.name, s.st_size, s.st_mtime_ns) for p in files for s in [p.stat()]]
    return sha256(repr(told).encode()).hexdigest()


def size(bag: Path) -> int:
    """Return the size of its files [bytes]."""
    files = bag.iterdir() if bag.is_dir() else [bag]
    return sum(path.stat().st_size for path in files if path.is_file())
