"""The names of the trees that share a zone, on disk: who starts again knows whom to wait for."""

from __future__ import annotations

import json
import os
import tempfile
import zlib
from contextlib import suppress
from pathlib import Path

from agv_motion.errors import ConfigurationError
from agv_motion.motion.traffic.claim import LONGEST_NAME, MOST_HEARD

LARGEST = 1 << 20
"""[bytes] of a file of names"""


class Roster:
    """Names in a file, written whole or not at all, and checked before they are believed."""

    def __init__(self, path: str) -> None:
        """Read the names that are there.

        Args:
            path: Of the file; empty: remember nobody over a restart. It need not exist yet.

        Raises:
            ConfigurationError: It is a folder, cannot be read, or is damaged.

        """
        self._path = Path(path) if path else None
        self.names: list[str] = []
        if self._path is not None and self._path.exists():
            self.names = _read(self._path)

    def add(self, name: str) -> None:
        """Remember ``name``, before anything is told to it.

        Raises:
            ConfigurationError: The disk does not take it; it is remembered until this run ends.

        """
        if self._path is None or name in self.names:
            return
        self.names.append(name)
        try:
            _write(self._path, self.names)
        except OSError as error:
            msg = f"cannot keep the name '{name}' in peers_file {self._path}: {error}"
            raise ConfigurationError(msg) from error


def _read(path: Path) -> list[str]:
    """Return the names in a file.

    Raises:
        ConfigurationError: It cannot be read, or is none.

    """
    remedy = 'name all other trees in traffic.expected, then remove the file'
    try:
        with path.open('rb') as file:
            data = file.read(LARGEST + 1)
        content = json.loads(data)
        names, crc = content['names'], content['crc32']
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        msg = f'peers_file {path} cannot be used: {error!r:.200}; {remedy}'
        raise ConfigurationError(msg) from error
    sound = (
        isinstance(names, list)
        and len(names) <= MOST_HEARD
        and all(isinstance(name, str) and 0 < len(name) <= LONGEST_NAME for name in names)
    )
    if not sound or crc != _crc(names):
        msg = f'peers_file {path} is damaged: its check sum is not that of its names; {remedy}'
        raise ConfigurationError(msg)
    return list(names)


def _write(path: Path, names: list[str]) -> None:
    """Write ``names``; a power cut leaves the old file or the new one, whole.

    Raises:
        OSError: The disk does not take it.

    """
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, new = tempfile.mkstemp(prefix=f'.{path.name}.', dir=path.parent)
    try:
        with os.fdopen(handle, 'w', encoding='utf-8') as file:
            json.dump({'names': names, 'crc32': _crc(names)}, file, indent=1)
            file.flush()
            os.fsync(file.fileno())
        Path(new).replace(path)
    except OSError:
        with suppress(OSError):
            Path(new).unlink()
        raise
    with suppress(OSError):  # some file systems have no folders to synchronise
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


def _crc(names: list[str]) -> int:
    return zlib.crc32(json.dumps(names).encode())
