"""A sqlite3 file with what its last writer left beside it, without touching the folder.

A recording that was killed leaves rows in a write-ahead log (``-wal``), or a journal by which a
half-written transaction is to be undone. sqlite3 would do both in place; the bag of a user stays as
it is, so it is done on a copy.
"""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from typing import TYPE_CHECKING

from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from pathlib import Path

_BESIDE = ('-wal', '-journal')


def set_aside(path: Path, folder: Path) -> Path:
    """Return a file in ``folder`` with all that was written: a link, or a copy where logs lie.

    Raises:
        SourceError: The disk has no room for a copy.
        sqlite3.DatabaseError: The file cannot be read.

    """
    aside = folder / 'aside.db3'
    logs = [(end, path.with_name(path.name + end)) for end in _BESIDE]
    filled = [(end, log) for end, log in logs if log.is_file() and log.stat().st_size]
    if not filled:
        aside.symlink_to(path.absolute())  # which is gone when the reader is closed
        return aside
    size = path.stat().st_size + sum(log.stat().st_size for _, log in filled)
    if 2 * size > shutil.disk_usage(folder).free:
        msg = f'{path} and its log need {2 * size} bytes in {folder}: set TMPDIR to a larger disk'
        raise SourceError(msg)
    shutil.copyfile(path, aside)
    for end, log in filled:
        shutil.copyfile(log, aside.with_name(aside.name + end))
    with closing(sqlite3.connect(aside)) as database:
        database.execute('select count(*) from sqlite_master').fetchall()
        database.execute('pragma journal_mode = delete').fetchall()
    return aside
