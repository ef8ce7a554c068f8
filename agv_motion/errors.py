"""Errors of the package: one base class, one subclass per kind of mistake.

Every message gives the value, what was expected, and what to do about it. A value that somebody
sends may be of any length: messages quote no more than `QUOTED` characters of it.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from typing_extensions import Self

QUOTED = 200
"""Characters after which a quotation ends."""
LONGEST = 1000
"""Characters of a whole message: of a longer one the middle is left out, the remedy stays."""

_LONG_QUOTATION = re.compile(
    rf"(?P<kept>(?<!\w)'[^']{{{QUOTED}}})[^']+(?=')|(?P<list>\[[^\]]{{{QUOTED}}})[^\]]+(?=\])"
)


def shortened(message: str) -> str:
    """Return a message whose quotations ('...', [...]) end after `QUOTED` characters."""
    if len(message) > QUOTED:
        message = _LONG_QUOTATION.sub(_cut, message)
    if len(message) > LONGEST:
        head, tail = message[: LONGEST - 3 * QUOTED // 2], message[-QUOTED:]
        message = f'{head} ... ({len(message) - len(head) - len(tail)} characters) ... {tail}'
    return message


def _cut(found: re.Match[str]) -> str:
    kept = found['kept'] or found['list']
    return f'{kept}... ({len(found[0]) - len(kept)} characters more)'


class AgvMotionError(Exception):
    """Base of every error that this package raises on purpose; its message is `shortened`."""

    def __init__(self, *arguments: object) -> None:
        """Keep the message, its quotations shortened."""
        super().__init__(*(shortened(a) if isinstance(a, str) else a for a in arguments))

    unquoted = ''
    """Where the message may quote a file: the same without a word of it."""
    file = ''
    """the file"""

    @classmethod
    def at(cls, where: tuple[Path | str, int, int], reason: str, unquoted: str) -> Self:
        """Return what is wrong at a place of a file.

        Args:
            where: File, line and column.
            reason: May quote the file: for who can read it anyway.
            unquoted: The same without a word of the file: for who asks over the network.

        """
        error = cls(f'{place(*where)}: {reason}')
        error.unquoted, error.file = f'{place(*where)}: {unquoted}', str(where[0])
        return error


def place(path: Path | str, line: int, column: int) -> str:
    """Return file, line and column, counted from 1 as editors do."""
    return f'{path}, line {line}, column {column}'


class GeometryError(AgvMotionError, ValueError):
    """The described vehicle, zone or path cannot exist: wrong shape, non-finite, out of range."""


class SignalError(AgvMotionError, ValueError):
    """A measured or commanded value is malformed: wrong length or non-finite."""


class ConfigurationError(AgvMotionError, ValueError):
    """A parameter, a file or a combination of them cannot be used as it stands."""


class SourceError(AgvMotionError, OSError):
    """A source of data (file, serial line, bag) cannot be opened or read."""
