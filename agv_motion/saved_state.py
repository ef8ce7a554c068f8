"""What a node has learnt, kept over a restart: written whole or not at all, checked when read.

A file begins with one line that holds the SHA-256 digest of all that follows it, so that no
flipped bit passes for what was learnt. A file without that line is of an older version, or foreign:
what reads its content decides. What cannot be used is set aside under a name of its own, never
deleted, and told; the node starts without it.
"""

from __future__ import annotations

import errno
import hashlib
import os
import secrets
import stat
from contextlib import suppress
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable

FIRST_LINE = b'agv_motion state 1 sha256 '
"""Before the digest in hexadecimal digits and the end of the line."""

LARGEST = 256 * 1024 * 1024
"""[bytes] A file beyond this is none of ours: the largest memory of places has 96 MB."""

ABANDONED = 3600.0
"""[s] after which an unfinished file is nobody's any more"""

_PREFIX = '.state-'
"""of the names of unfinished files"""

ONLY_NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC


def save(path: str | Path, content: bytes) -> None:
    """Write ``content``; a power cut or a full disk leaves the old file or the new one, whole.

    The new file is written beside the old one under a name that nobody can foretell, and then takes
    its place and its permissions. A symbolic link at ``path`` is replaced, not followed.

    Raises:
        OSError: The disk does not take it: full, read-only, or ``path`` is a folder.

    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    new = path.with_name(_PREFIX + secrets.token_hex(16))
    descriptor = os.open(new, ONLY_NEW, 0o666)
    try:
        with os.fdopen(descriptor, 'wb') as file:
            with suppress(FileNotFoundError):
                before = os.lstat(path).st_mode
                if stat.S_ISREG(before):
                    os.fchmod(file.fileno(), before & 0o777)
            file.write(FIRST_LINE + hashlib.sha256(content).hexdigest().encode() + b'\n')
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
            _sweep(path.parent, os.fstat(file.fileno()).st_mtime)
        new.replace(path)
    except BaseException:
        with suppress(OSError):
            new.unlink()
        raise
    with suppress(OSError):  # some file systems have no folders to synchronise
        folder = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


def _sweep(folder: Path, now: float) -> None:
    """Delete what saves that were killed have left, and no file that may still be written.

    Args:
        folder: Where they saved.
        now: Time by which its file system stamps [s].

    """
    for left in folder.glob(_PREFIX + '[0-9a-f]' * 32):
        with suppress(OSError):  # gone meanwhile
            found = os.lstat(left)
            if stat.S_ISREG(found.st_mode) and now - found.st_mtime > ABANDONED:
                left.unlink()


def load(path: str | Path, largest: int = LARGEST) -> bytes | None:
    """Return what was saved at ``path``; None where nothing was.

    Raises:
        ConfigurationError: It is no regular file, or is larger than ``largest`` [bytes], or its
            digest is not that of its content.
        OSError: It cannot be read, or is a symbolic link.

    """
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except FileNotFoundError:
        return None
    with os.fdopen(descriptor, 'rb') as file:
        found = os.fstat(descriptor)
        if not stat.S_ISREG(found.st_mode) or found.st_size > largest:
            msg = f'it has {found.st_size} bytes and may have {largest}, or is no regular file'
            raise ConfigurationError(msg)
        content = file.read(found.st_size)
    if not content.startswith(FIRST_LINE):
        return content
    digest, end, content = content.removeprefix(FIRST_LINE).partition(b'\n')
    if not end or digest != hashlib.sha256(content).hexdigest().encode():
        msg = 'it is damaged: its content is not what was written'
        raise ConfigurationError(msg)
    return content


def restore(path: str | Path, take: Callable[[bytes], None], largest: int = LARGEST) -> str:
    """Give what was saved at ``path`` to ``take``; return what is worth telling, empty if nothing.

    Args:
        path: Of the file; there may be none.
        take: Takes up the content whole, or raises a ValueError (OSError, RecursionError) and
            takes up nothing; then the file is set aside.
        largest: Size of a file beyond which it is not read [bytes].

    Raises:
        ConfigurationError: ``path`` is no place for a file: a folder, a link, a device.

    """
    path = Path(path)
    check_place(path)
    try:
        content = load(path, largest)
        if content is not None:
            take(content)
    except (OSError, ValueError, RecursionError) as error:
        reason = str(getattr(error, 'unquoted', '') or error)
        return f'{path} cannot be used: {reason:.200}; {set_aside(path)}'
    return ''


def check_place(path: str | Path) -> None:
    """Raise a ConfigurationError where ``path`` can hold no state."""
    try:
        mode = os.lstat(path).st_mode
    except OSError as error:
        if error.errno in {errno.ELOOP, errno.ENAMETOOLONG}:
            msg = f"'{path!s:.200}' is no path of a file: {error.strerror}"
            raise ConfigurationError(msg) from error
        return
    except ValueError as error:
        msg = f'{str(path)!r:.200} is no path of a file: {error}'
        raise ConfigurationError(msg) from error
    if stat.S_ISDIR(mode):
        msg = f"'{path}' is a folder: give a file in it"
    elif stat.S_ISLNK(mode):
        msg = f"'{path}' is a symbolic link: give the file itself"
    elif not stat.S_ISREG(mode):
        msg = f"'{path}' is no regular file: give another"
    else:
        return
    raise ConfigurationError(msg)


def not_kept(what: str, path: str | Path, error: Exception) -> str:
    """Return in words that ``what`` could not be saved, why, and what helps."""
    reason = getattr(error, 'strerror', None) or str(error) or 'the disk is slow'
    remedy = 'see that it can be written, or give another file'
    return f'cannot keep {what} in {path} ({reason}): {remedy}'


def set_aside(path: str | Path, suffix: str = '.unusable') -> str:
    """Rename ``path`` to a free name with ``suffix``; return in words what came of it.

    Nothing that was set aside before is overwritten.
    """
    path = Path(path)
    for number in count(1):
        aside = path.with_name(path.name + suffix + (f'.{number}' if number > 1 else ''))
        try:
            os.close(os.open(aside, ONLY_NEW, 0o600))  # so that nobody else takes the name
            path.replace(aside)
        except FileExistsError:
            continue
        except OSError as error:
            return f'it could not be set aside ({error.strerror or error})'
        return f'set aside as {aside.name}'
    raise AssertionError  # the numbers do not end
