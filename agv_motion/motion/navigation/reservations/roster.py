"""The names of the trees that share a zone, on disk: who starts again knows whom to wait for."""

from __future__ import annotations

import json
from pathlib import Path

from agv_motion import saved_state
from agv_motion.errors import ConfigurationError
from agv_motion.motion.navigation.reservations.reservation import LONGEST_NAME, MOST_RECEIVED

LARGEST = 1 << 20
"""[bytes] of a file of names"""


class Roster:
    """Names in a file, a JSON list; a person may write one to begin with."""

    def __init__(self, path: str) -> None:
        """Read the names that are there; what cannot be used is set aside.

        Args:
            path: Of the file; empty: remember nobody over a restart. It need not exist yet.

        Raises:
            ConfigurationError: It is a folder, a link or a device.

        """
        self._path = Path(path) if path else None
        self.names: list[str] = []
        self.complaint = ''
        """What was wrong with the file, in words; empty if nothing."""
        if self._path is not None:
            complaint = saved_state.restore(self._path, self._take, LARGEST)
            self.complaint = f'peers_file {complaint}' if complaint else ''

    def _take(self, content: bytes) -> None:
        """Take up the names in a file.

        Raises:
            ConfigurationError: It is no list of names.

        """
        names = json.loads(content)
        if not (
            isinstance(names, list)
            and len(names) <= MOST_RECEIVED
            and all(isinstance(name, str) and 0 < len(name) <= LONGEST_NAME for name in names)
        ):
            msg = f'it is no list of at most {MOST_RECEIVED} names of trees'
            raise ConfigurationError(msg)
        self.names = names

    def add(self, name: str) -> None:
        """Remember ``name``, before anything is told to it.

        Raises:
            ConfigurationError: The disk does not take it; it is remembered until this run ends.

        """
        if name in self.names:
            return
        self.names.append(name)
        if self._path is None:
            return
        try:
            saved_state.save(self._path, json.dumps(self.names[:MOST_RECEIVED]).encode())
        except OSError as error:
            msg = saved_state.not_kept(f"the name '{name}'", self._path, error)
            raise ConfigurationError(msg) from error
