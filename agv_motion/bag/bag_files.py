"""Which files make a bag, and whether they, or their messages, are compressed as a whole."""

from __future__ import annotations

import re
import shutil
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any, NamedTuple

import zstandard

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.metadata import ENTRIES, FILE_NAME, SIZE
from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.files import text, yaml_text

if TYPE_CHECKING:
    from collections.abc import Sequence

SUFFIXES = ('.mcap', '.db3')
COMPRESSED = '.zstd'
_PIECE = 1 << 20
_SPARE = 1 << 28
"""[bytes] Disk left free when a compressed file is unpacked."""


class BagFiles(NamedTuple):
    """Files of a bag, in their order."""

    paths: Sequence[Path]
    messages_compressed: bool = False
    """each message is compressed by itself"""
    problems: Sequence[DamagedBagError] = ()

    @property
    def files_compressed(self) -> bool:
        """Whether the files are compressed as a whole."""
        return any(path.suffix == COMPRESSED for path in self.paths)


def find(path: Path) -> BagFiles:
    """Return the files of a bag: a folder, or a single file.

    Raises:
        SourceError: There is no bag.

    """
    if path.is_dir():
        return _in_folder(path)
    if not path.exists():
        msg = f'bag {path} does not exist: give the folder of a bag, or its .mcap or .db3 file'
        raise SourceError(msg)
    described = _described(path.parent / FILE_NAME) or {}
    names = [PurePath(str(name)).name for name in _names(described)]
    return BagFiles([path], path.name in names and _mode(described) == 'message')


def unpack_file(path: Path, folder: Path) -> Path:
    """Write a file that is compressed as a whole into ``folder``, unpacked; return it.

    Raises:
        DamagedBagError: It is damaged, or would fill the disk.

    """
    target = folder / path.stem
    unpacker = zstandard.ZstdDecompressor(max_window_size=1 << 27)
    with path.open('rb') as packed, target.open('wb') as file:
        try:
            for piece in unpacker.read_to_iter(packed, write_size=_PIECE):
                if shutil.disk_usage(folder).free < _SPARE:
                    finding = f'it unpacks to more than {file.tell()} bytes, which fill {folder}'
                    raise DamagedBagError(
                        path, packed.tell(), finding, 'set TMPDIR to a larger disk'
                    )
                file.write(piece)
        except zstandard.ZstdError as error:
            raise DamagedBagError(path, packed.tell(), f'zstd: {error}') from None
    return target


def _in_folder(folder: Path) -> BagFiles:
    described = _described(folder / FILE_NAME)
    problems = []
    if described is None:
        problems.append(DamagedBagError(folder / FILE_NAME, 0, 'no metadata that can be read'))
    named = [folder / PurePath(str(name)).name for name in _names(described or {})]
    problems += [
        DamagedBagError(folder / FILE_NAME, 0, f'it names {path.name:.200}, which is not there')
        for path in named
        if not _is_there(path)
    ]
    paths = [path for path in named if _is_there(path)] or sorted(
        (p for p in folder.iterdir() if p.name.removesuffix(COMPRESSED).endswith(SUFFIXES)),
        key=_number,
    )
    if not paths:
        msg = f'{folder} is no bag: it has no .mcap and no .db3 file'
        raise SourceError(msg)
    return BagFiles(paths, _mode(described or {}) == 'message', problems)


def _is_there(path: Path) -> bool:
    """Return whether there is a file of a name that may be none: too long, or with a NUL."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def _described(path: Path) -> dict[str, Any] | None:
    """Return what the metadata says; None where there is none that can be read."""
    try:
        content = text.read(path, limit=SIZE)
        entries = yaml_text.plain(content, path, ENTRIES)['rosbag2_bagfile_information']
    except (ConfigurationError, KeyError, TypeError):
        return None
    return entries if isinstance(entries, dict) else None


def _names(described: dict[str, Any]) -> list[Any]:
    names = described.get('relative_file_paths')
    return names if isinstance(names, list) else []


def _mode(described: dict[str, Any]) -> str:
    return str(described.get('compression_mode') or '').lower()


def _number(path: Path) -> tuple[str, int]:
    """Return what sorts the files of a split bag: bag_2 before bag_10."""
    match = re.search(r'(.*?)(\d+)\.', path.name)
    return (match[1], int(match[2])) if match else (path.name, 0)
