"""A folder, or a file, that is written beside its place, and takes it only when it is whole.

Whatever ends the writer (an error, a signal, kill -9, a power cut), at the place is what was there
before or everything. What a killed writer leaves is hidden, named after the place, and swept away
by the next one; a folder in which somebody still writes is known by its lock.
"""

from __future__ import annotations

import errno
import fcntl
import os
import secrets
import shutil
import stat
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Iterator

_LONGEST_NAME = 200
"""[bytes] of the name of a place in that of the hidden folder; most file systems allow 255"""


@contextmanager
def beside(target: Path) -> Iterator[Path]:
    """Yield where to make the folder that becomes ``target`` at the end of the block.

    After an error in the block nothing is left.

    Raises:
        SourceError: There is something at ``target`` already, or its disk takes nothing.

    """
    require_free(target)
    with told(target):
        target.parent.mkdir(parents=True, exist_ok=True)
    with hidden_folder(target) as folder:
        made = folder / target.name
        yield made
        require_free(target)
        with told(target):
            _settle(made)
            made.rename(target)
            _sync(target.parent)


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield where to write the file that takes the place of ``path`` at the end of the block.

    The new file keeps the permissions of the old one, and the suffix while it is written. The file
    behind a symbolic link is replaced, not the link. What is no plain file, such as a pipe, cannot
    be replaced: it is yielded itself.

    Raises:
        SourceError: The disk takes nothing: it is full or read-only, or ``path`` is a folder.

    """
    place = Path(os.path.realpath(path))
    before = place.stat() if place.exists() else None
    if before is not None and not stat.S_ISREG(before.st_mode):
        with told(path):
            yield place
        return
    with hidden_folder(place) as folder, told(path):
        made = folder / place.name
        yield made
        if before is not None:
            made.chmod(stat.S_IMODE(before.st_mode))
        _sync(made)  # or a power cut may leave the new name with nothing behind it
        made.replace(place)
        _sync(place.parent)


@contextmanager
def told(path: Path) -> Iterator[None]:
    """Turn what the disk refuses into a SourceError that names the place."""
    try:
        yield
    except SourceError:
        raise
    except OSError as error:
        msg = f'{path} cannot be written ({error.strerror or error}): choose another place'
        raise SourceError(msg) from error


@contextmanager
def hidden_folder(target: Path) -> Iterator[Path]:
    """Yield a new hidden folder beside ``target``, for this process alone; nothing of it stays.

    Raises:
        SourceError: The disk takes nothing.

    """
    with told(target):
        sweep(target)
        folder, lock = _locked_folder(target)
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        os.close(lock)


def require_free(target: Path) -> None:
    """Raise a SourceError where there is something at ``target``."""
    if os.path.lexists(target):
        msg = f'{target} cannot be written (File exists): choose a new folder'
        raise SourceError(msg)


def sweep(target: Path) -> None:
    """Delete what killed writers of ``target`` have left, and nothing that is in use."""
    for left in target.parent.iterdir() if target.parent.is_dir() else ():
        if not left.name.startswith(_prefix(target)) or left.is_symlink():
            continue
        with suppress(OSError):  # in use, or gone meanwhile
            lock = os.open(left, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(left, ignore_errors=True)
            finally:
                os.close(lock)


def _settle(folder: Path) -> None:
    """Wait until the disk has a folder and all that is in it: no power cut leaves empty files."""
    for place, _, files in os.walk(folder):
        for name in files:
            _sync(Path(place, name))
        _sync(Path(place))


def _sync(path: Path) -> None:
    """Wait until the disk has a file, or the names in a folder.

    Raises:
        OSError: The disk failed to take it.

    """
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    except OSError as error:
        if error.errno != errno.EINVAL:  # a file system that cannot wait for folders
            raise
    finally:
        os.close(descriptor)


def _prefix(target: Path) -> str:
    name = os.fsdecode(os.fsencode(target.name)[:_LONGEST_NAME])
    return f'.{name}.unfinished-'


def _locked_folder(target: Path) -> tuple[Path, int]:
    """Return a new folder beside ``target``, and a descriptor that holds its lock."""
    while True:
        folder = target.with_name(_prefix(target) + secrets.token_hex(8))
        folder.mkdir()
        lock = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        with suppress(OSError):  # a file system without locks: then nobody can sweep it either
            fcntl.flock(lock, fcntl.LOCK_EX)
        if folder.exists():  # a sweep may have come between
            return folder, lock
        os.close(lock)
