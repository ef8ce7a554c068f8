"""Rows that cannot be read: each costs itself alone, and is told with its line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from pathlib import Path

MOST_TOLD = 3
"""Rows that are told one by one; the others are counted."""


class LeftOut:
    """What was left out of one file, and why."""

    def __init__(self, path: Path) -> None:
        """Start without any."""
        self._path = path
        self._faults: list[tuple[int, int, str, str]] = []

    def add(self, line: int, column: int, reason: str, unquoted: str = '') -> None:
        """Note a row."""
        self._faults.append((line, column, reason, unquoted or reason))

    def error(self) -> SourceError:
        """Return what is wrong with the first row, or that there is none."""
        if not self._faults:
            msg = f'{self._path} has no row with a time: give at least one'
            return SourceError(msg)
        line, column, reason, unquoted = min(self._faults)
        return SourceError.at((self._path, line, column), reason, unquoted)

    def told(self) -> str:
        """Return how many there are, and the first few lines, without a word of the file."""
        if not self._faults:
            return ''
        faults = sorted(self._faults)
        first = '; '.join(f'line {line}: {why}' for line, _, _, why in faults[:MOST_TOLD])
        more = f'; and {left} more' if (left := len(faults) - MOST_TOLD) > 0 else ''
        return f'rows of {self._path} left out: {len(faults)} ({first}{more})'
