"""What a file is, by its first bytes: names do not tell."""

from __future__ import annotations

from stat import S_ISREG
from typing import TYPE_CHECKING

from agv_motion.bag.mcap.records import MAGIC
from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from pathlib import Path

MCAP, SQLITE, ZSTD = 'mcap', 'sqlite3', 'zstd'
SUFFIXES = {'.mcap': MCAP, '.db3': SQLITE}
"""What a file is called, where its first bytes are damaged."""
COMPRESSED = ('.zstd', '.zst')
"""Suffixes of files that are compressed as a whole."""
_KNOWN = {MAGIC: MCAP, b'SQLite format 3\0': SQLITE, b'\x28\xb5\x2f\xfd': ZSTD}
_FOREIGN = {
    b'#ROSBAG V': 'a bag of ROS 1: rosbags-convert --src {path} --dst FOLDER makes one of ROS 2',
    b'version https://git-lfs': 'a pointer of git-lfs in place of the bag: git lfs pull fetches it',
    b'\x1f\x8b': 'compressed by gzip: gunzip -k {path}, then read the result',
    b'BZh': 'compressed by bzip2: bunzip2 -k {path}, then read the result',
    b'\xfd7zXZ\0': 'compressed by xz: unxz -k {path}, then read the result',
    b'\x04"M\x18': 'compressed by lz4: lz4 -d {path}, then read the result',
    b'PK\x03\x04': 'a zip archive: unpack it, then read the bag in it',
    b'7z\xbc\xaf\x27\x1c': 'a 7z archive: unpack it, then read the bag in it',
    b'rosbag2_bagfile_information': 'the description of a bag: give the folder that it lies in',
}
_TAR, _TAR_AT = b'ustar', 257


def kind(path: Path) -> str:
    """Return what a file is: ``mcap``, ``sqlite3``, or ``zstd`` of one of them.

    Raises:
        SourceError: It cannot be read, or is something else.

    """
    begin = _beginning(path)
    for magic, found in _KNOWN.items():
        if begin.startswith(magic):
            return found
    for magic, what in _FOREIGN.items():
        if begin.startswith(magic):
            msg = f'{path} is {what.format(path=path)}'
            raise SourceError(msg)
    if begin[_TAR_AT:].startswith(_TAR):
        msg = f'{path} is a tar archive: unpack it, then read the bag in it'
        raise SourceError(msg)
    if path.suffix not in SUFFIXES:
        msg = f'{path} is no bag in MCAP or sqlite3: it begins with {begin[:16]!r}'
        raise SourceError(msg)
    return SUFFIXES[path.suffix]


def _beginning(path: Path) -> bytes:
    try:
        if S_ISREG(path.stat().st_mode):
            with path.open('rb') as file:
                return file.read(_TAR_AT + len(_TAR))
    except OSError as error:
        msg = f'{path} cannot be read: {error.strerror}'
        raise SourceError(msg) from error
    msg = f'{path} is no file, but a pipe or a device: give a bag'  # one may wait for ever
    raise SourceError(msg)
