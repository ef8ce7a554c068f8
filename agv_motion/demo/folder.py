"""The folder of a demo's results: an earlier run's may be replaced, anybody else's never.

What a run wrote is known by the marker that it leaves: the names, and when it ended. Whatever
stands at one of the names without being in the marker, lies beside the files of the bag, or was
changed after the run is somebody's own, and the demo refuses before it touches anything.
"""

from __future__ import annotations

import fcntl
import json
import os
import time
from contextlib import contextmanager
from math import inf
from stat import S_ISREG
from typing import TYPE_CHECKING, TextIO

from agv_motion.bag.metadata import FILE_NAME, UNFINISHED
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

MARKER = '.agv_demo'
BAG = 'bag'
BAG_FILES = ('*.mcap', FILE_NAME, UNFINISHED)
NEVER = 0.0
SLACK = 2.0
"""[s] by which the times of some file systems are coarse"""


@contextmanager
def results(folder: Path, figure: str) -> Iterator[Path]:
    """Yield the path of the new bag, in a folder that is this run's alone until the end.

    Args:
        folder: Of the results; made where it is missing.
        figure: Name of the picture that the run will draw in it.

    Raises:
        ConfigurationError: Another demo is writing there, the folder cannot be written, or what
            stands in the place of the bag or the picture was not left by a demo.

    """
    names = BAG, figure
    with _locked(folder) as marker:
        written = _read(marker)
        for name in names:
            _require_own(folder, name, written)
        _remove_bag(folder / BAG)
        _note(marker, written | dict.fromkeys(names))
        try:
            yield folder / BAG
        finally:
            _note(marker, written | dict.fromkeys(names, time.time()))


@contextmanager
def _locked(folder: Path) -> Iterator[TextIO]:
    """Yield the marker of a folder, made where it is missing and locked until the end."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        there = os.open(folder / MARKER, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
        marker = os.fdopen(there, 'r+', encoding='utf-8')
    except OSError as error:
        msg = f"--output '{folder}' cannot be written ({error.strerror}): choose another"
        raise ConfigurationError(msg) from error
    with marker:
        try:
            fcntl.flock(marker, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            msg = f"another demo is writing to '{folder}': wait for it, or choose another --output"
            raise ConfigurationError(msg) from error
        yield marker


def _read(marker: TextIO) -> dict[str, float | None]:
    """Return when each name was last written [s]; None where the run did not live to say so."""
    marker.seek(0)
    try:
        found = json.loads(marker.read() or '{}')
    except ValueError:
        return {}
    return found if isinstance(found, dict) else {}


def _note(marker: TextIO, written: dict[str, float | None]) -> None:
    """Write over the marker in one piece, so that whoever kills this leaves the old or the new."""
    content = json.dumps(written).encode()
    os.pwrite(marker.fileno(), content.ljust(os.fstat(marker.fileno()).st_size), 0)


def _require_own(folder: Path, name: str, written: dict[str, float | None]) -> None:
    """Raise unless nothing stands at a name but what a demo left there."""
    path = folder / name
    if not os.path.lexists(path):
        return
    ended = written.get(name, NEVER)
    last = inf if ended is None else ended + SLACK
    if name == BAG and path.is_dir() and not path.is_symlink():
        alien = [
            file
            for file in sorted(path.iterdir())
            if not any(file.match(pattern) for pattern in BAG_FILES) or _changed(file, last)
        ]
    else:
        alien = [path] if name == BAG or _changed(path, last) else []
    if alien:
        msg = f"'{alien[0]}' was not left by a demo: move it away, or choose another --output"
        raise ConfigurationError(msg)


def _changed(file: Path, last: float) -> bool:
    """Return whether this is no plain file, or one written after ``last`` [s]."""
    status = file.lstat()
    return not S_ISREG(status.st_mode) or status.st_mtime > last


def _remove_bag(bag: Path) -> None:
    """Remove the files of an earlier bag by name, and its folder, which is then empty."""
    if bag.exists():
        for pattern in BAG_FILES:
            for file in bag.glob(pattern):
                file.unlink()
        bag.rmdir()
