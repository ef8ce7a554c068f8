"""A folder that is written beside its place, and takes it only when it is whole.

Whatever ends the writer (an error, a signal, kill -9, a power cut), at the place is nothing or
everything. What a killed writer leaves is hidden, named after the place, and swept away by the next
one; a folder in which somebody still writes is known by its lock.
"""

from __future__ import annotations

import fcntl
import os
import secrets
import shutil
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@contextmanager
def beside(target: Path) -> Iterator[Path]:
    """Yield where to make the folder that becomes ``target`` at the end of the block.

    After an error in the block nothing is left.

    Raises:
        SourceError: There is something at ``target`` already, or its disk takes nothing.

    """
    require_free(target)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        sweep(target)
        folder, lock = _locked_folder(target)
    except OSError as error:
        msg = f'{target} cannot be written ({error.strerror}): choose another place'
        raise SourceError(msg) from error
    try:
        made = folder / target.name
        yield made
        require_free(target)
        try:
            made.rename(target)
        except OSError as error:
            msg = f'{target} cannot be written ({error.strerror}): choose another place'
            raise SourceError(msg) from error
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


def _prefix(target: Path) -> str:
    return f'.{target.name}.unfinished-'


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
