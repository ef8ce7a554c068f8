"""What the page keeps over a restart: users, sessions, marks, saved parameters, alerts.

One SQLite database in the state folder, readable by its owner alone. It is opened by the server and
by `agv dashboard user`, at the same time if need be. Nothing here deletes what a person wrote.
"""

from __future__ import annotations

import os
import sqlite3
import threading
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

VERSION = 1
FILE = 'dashboard.sqlite3'
PATIENCE = 5.0
"""[s] that one waits while another writes"""

SCHEMA = """
CREATE TABLE secrets (name TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE users (name TEXT PRIMARY KEY, role TEXT NOT NULL, hash TEXT NOT NULL,
    created REAL NOT NULL);
CREATE TABLE sessions (digest TEXT PRIMARY KEY, user TEXT NOT NULL, created REAL NOT NULL,
    expires REAL NOT NULL);
CREATE TABLE marks (id INTEGER PRIMARY KEY, at REAL NOT NULL, text TEXT NOT NULL,
    by TEXT NOT NULL);
CREATE TABLE parameters (id INTEGER PRIMARY KEY, robot TEXT NOT NULL, at REAL NOT NULL,
    by TEXT NOT NULL, comment TEXT NOT NULL, content TEXT NOT NULL);
CREATE TABLE alerts (id TEXT PRIMARY KEY, robot TEXT NOT NULL, raised REAL NOT NULL,
    content TEXT NOT NULL);
CREATE TABLE platforms (robot TEXT PRIMARY KEY, content TEXT NOT NULL);
CREATE TABLE rests (robot TEXT PRIMARY KEY, until REAL NOT NULL, by TEXT NOT NULL);
"""


def state_folder(given: str = '') -> Path:
    """Return where the state is kept: as given, or by XDG in the home of the user."""
    if given:
        return Path(given).expanduser()
    base = os.environ.get('XDG_STATE_HOME', '')
    root = Path(base) if base.startswith('/') else Path.home() / '.local' / 'state'
    return root / 'agv_motion'


class Store:
    """The database; usable from any thread."""

    def __init__(self, folder: Path) -> None:
        """Open it, made where it is missing.

        Raises:
            ConfigurationError: The folder cannot be written, or the file is none of ours, damaged,
                or of a newer version; nothing of it is changed then.

        """
        self.path = folder / FILE
        self._lock = threading.RLock()
        try:
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            os.close(os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o600))
        except OSError as error:
            msg = f'{self.path} cannot be written ({error.strerror}): give another state_folder'
            raise ConfigurationError(msg) from error
        self._database = sqlite3.connect(
            self.path, timeout=PATIENCE, isolation_level=None, check_same_thread=False
        )
        try:
            self._prepare()
        except sqlite3.Error as error:
            self._database.close()
            msg = (
                f'{self.path} cannot be used ({error}): move it away, and users and marks begin '
                'anew, or bring back a copy'
            )
            raise ConfigurationError(msg) from error
        except ConfigurationError:
            self._database.close()
            raise

    def _prepare(self) -> None:
        """Make the tables where there are none.

        Raises:
            ConfigurationError: They are of another version.

        """
        run = self._database.execute
        run('PRAGMA journal_mode = WAL')
        run('PRAGMA synchronous = FULL')
        with self.transaction():
            version = run('PRAGMA user_version').fetchone()[0]
            if version == 0 and not run('SELECT 1 FROM sqlite_master').fetchone():
                for statement in SCHEMA.split(';'):
                    run(statement)
                run(f'PRAGMA user_version = {VERSION}')
            elif version != VERSION:
                msg = (
                    f'{self.path} has version {version}, expected {VERSION}: it is of another '
                    'release, or none of ours; give another state_folder'
                )
                raise ConfigurationError(msg)

    @contextmanager
    def transaction(self) -> Iterator[None]:
        """Let several statements count together or not at all."""
        with self._lock:
            self._database.execute('BEGIN IMMEDIATE')
            try:
                yield
            except BaseException:
                self._database.execute('ROLLBACK')
                raise
            self._database.execute('COMMIT')

    def rows(self, statement: str, values: Sequence[Any] = ()) -> list[tuple[Any, ...]]:
        """Return the rows that a statement finds."""
        with self._lock:
            return self._database.execute(statement, values).fetchall()

    def change(self, statement: str, values: Sequence[Any] = ()) -> int:
        """Run a statement; return the number of rows that it changed, or the id of a new one."""
        with self._lock:
            cursor = self._database.execute(statement, values)
            inserted = statement.startswith('INSERT')
            return int((cursor.lastrowid if inserted else cursor.rowcount) or 0)

    def secret(self, name: str, make: str) -> str:
        """Return a secret of this installation; ``make`` is it where there was none."""
        self.change('INSERT OR IGNORE INTO secrets VALUES (?, ?)', (name, make))
        return str(self.rows('SELECT value FROM secrets WHERE name = ?', (name,))[0][0])

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._database.close()
