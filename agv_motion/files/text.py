"""The text of a file: a regular one, of a bounded size, in UTF-8."""

from __future__ import annotations

import codecs
import os
import stat
from typing import TYPE_CHECKING, TypeVar

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.errors import AgvMotionError

    E = TypeVar('E', bound=AgvMotionError)

LIMIT = 1 << 20
"""[bytes] of a file that a person writes; no zone, route or sequence comes near it"""


def read(path: Path, what: str = 'the file', limit: int = LIMIT) -> str:
    """Return the text of a file, its lines ended by line feeds.

    Args:
        path: The file; a device or a pipe, which might never end, is refused.
        what: It is, for the error: ``the route``.
        limit: Size from which on it is refused [bytes].

    Raises:
        ConfigurationError: It cannot be read, is too large, or is no UTF-8.

    """
    return _decoded(path, read_bytes(path, what, limit))


def read_bytes(path: Path, what: str = 'the file', limit: int = LIMIT, begin: int = 0) -> bytes:
    """Return the content of a file from byte ``begin`` on; else as :func:`read`."""
    try:
        # without waiting for the other end of a pipe
        with os.fdopen(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), 'rb') as file:
            regular = stat.S_ISREG(os.fstat(file.fileno()).st_mode)
            if regular and begin:
                file.seek(begin)
            data = file.read(limit + 1) if regular else b''
    except (OSError, ValueError) as error:  # ValueError: a NUL in the path
        reason = getattr(error, 'strerror', None) or error
        msg = f"cannot read {what} '{path}': {reason}"
        raise ConfigurationError(msg) from error
    if not regular:
        msg = f"cannot read {what} '{path}': it is a device or a pipe; give a file"
        raise ConfigurationError(msg)
    if len(data) > limit:
        msg = f"cannot read {what} '{path}': it is larger than {limit} bytes; is it the right file?"
        raise ConfigurationError(msg)
    return data


def as_kind(error: AgvMotionError, kind: type[E]) -> E:
    """Return an error as one of another class."""
    other = kind(str(error))
    other.unquoted, other.file = error.unquoted, error.file
    return other


def _decoded(path: Path, data: bytes) -> str:
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        reason = 'it is UTF-16: save it as UTF-8'
        raise ConfigurationError.at((path, 1, 1), reason, reason)
    data = data.removeprefix(codecs.BOM_UTF8)
    try:
        text = data.decode()
    except UnicodeDecodeError as error:
        lines = data[: error.start].split(b'\n')
        where = path, len(lines), len(lines[-1].decode(errors='replace')) + 1
        reason = 'no UTF-8: save the file as UTF-8'
        finding = f'byte 0x{data[error.start]:02x} is {reason}'
        raise ConfigurationError.at(where, finding, reason) from error
    return text.replace('\r\n', '\n').replace('\r', '\n')
