"""Which files make a bag, and whether they, or their messages, are compressed as a whole."""

from __future__ import annotations

import re
import shutil
from filecmp import cmp
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any, NamedTuple

import zstandard

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.file_kind import COMPRESSED, SUFFIXES, kind
from agv_motion.bag.metadata import ENTRIES, FILE_NAME, SIZE
from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.files import text, yaml_text

if TYPE_CHECKING:
    from collections.abc import Sequence

_PIECE = 1 << 20
_SPARE = 1 << 28
"""[bytes] Disk left free when a compressed file is unpacked."""
_MOST_NAMED = 5
"""Names that an error tells."""


EXTRAS = 'extras.mcap'
"""What a bag in sqlite3 has besides messages: attachments and named strings."""


class BagFiles(NamedTuple):
    """Files of a bag, in their order."""

    paths: Sequence[Path]
    messages_compressed: bool = False
    """each message is compressed by itself"""
    problems: Sequence[DamagedBagError] = ()
    messages: int = 0
    """that the metadata tells of; 0 where it does not"""


def find(path: Path) -> BagFiles:
    """Return the files of a bag: a folder, or a single file.

    Raises:
        SourceError: There is no bag.

    """
    try:
        if path.is_dir():
            return _in_folder(path)
    except PermissionError as error:
        msg = f'{path} cannot be read: {error.strerror}'
        raise SourceError(msg) from error
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
    target = folder / path.stem if path.suffix in COMPRESSED else folder / path.name
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
        if not file.tell():
            finding = 'the file ends before anything can be unpacked'
            raise DamagedBagError(path, packed.tell(), finding, 'copy or record it again')
    return target


def _in_folder(folder: Path) -> BagFiles:
    described, problems = _described(folder / FILE_NAME), []
    if described is None:
        finding = 'no metadata that can be read'
        problems.append(_problem(folder, finding, 'what lies in the folder is read'))
        described = {}
    named = list(dict.fromkeys(folder / PurePath(str(n)).name for n in _names(described)))
    there = [path for path in named if _is_there(path)]
    unnamed, notes = _unnamed(folder, named, there)
    problems += notes
    lost = len(named) - len(there) > len(unnamed)
    problems += [
        _problem(folder, f'it names {path.name:.200}, which is not there', harmless=not lost)
        for path in named
        if path not in there
    ]
    if named:
        problems += [
            _problem(folder, f'it does not name {path.name:.200}, which lies there', 'it is read')
            for path in unnamed
        ]
    paths = [*there, *unnamed]
    if not paths:
        raise _no_bag(folder)
    if EXTRAS not in (path.name for path in paths) and _is_there(folder / EXTRAS):
        paths.append(folder / EXTRAS)
    return BagFiles(paths, _mode(described) == 'message', problems, _count(described))


def _problem(folder: Path, finding: str, remedy: str = '', *, harmless: bool = True) -> Any:
    """Return what is amiss in the metadata; ``harmless`` where all messages can be read."""
    remedy = remedy or 'bring it back beside the others'
    return DamagedBagError(folder / FILE_NAME, 0, finding, remedy, harmless=harmless)


def _unnamed(
    folder: Path, named: Sequence[Path], there: Sequence[Path]
) -> tuple[list[Path], list[DamagedBagError]]:
    """Return files that belong to the bag though its metadata does not name them, and notes.

    A recording that was killed leaves such a file; so does who renames files. Copies, and files of
    another format than the named ones, are left out.
    """
    kinds = {_bare(path).suffix for path in there}
    chosen: list[Path] = []
    notes: list[DamagedBagError] = []
    for path in sorted(folder.iterdir(), key=_number):
        if path in named or _bare(path).suffix not in SUFFIXES or not _is_there(path):
            continue
        if path.name == EXTRAS and kinds == {'.db3'}:
            continue
        known = [*there, *chosen]
        copy = next((other for other in known if _is_copy(path, other)), None)
        if copy is not None:
            finding = f'{path.name:.200} is a copy of {copy.name:.200}'
            notes.append(_problem(folder, finding, 'it is read once'))
        elif kinds and _bare(path).suffix not in kinds:
            finding = f'it does not name {path.name:.200}, which is of another format'
            notes.append(_problem(folder, finding, f'agv bag info {path} looks into it'))
        else:
            chosen.append(path)
    return chosen, notes


def _is_copy(path: Path, other: Path) -> bool:
    """Return whether two files hold the same: byte by byte, or one is the other compressed."""
    if path != other and _bare(path) == _bare(other):
        return True
    same = path.stat().st_size == other.stat().st_size > 0
    return same and cmp(path, other, shallow=False)


def _bare(path: Path) -> Path:
    """Return the name of a file without the suffix of its compression."""
    return path.with_suffix('') if path.suffix in COMPRESSED else path


def _no_bag(folder: Path) -> SourceError:
    """Return an error that tells what lies in a folder in place of a bag."""
    inner = sorted(p.parent for p in folder.glob(f'*/{FILE_NAME}'))
    if inner:
        names = ', '.join(str(path) for path in inner[:_MOST_NAMED])
        return SourceError(f'{folder} is no bag, but has bags in it: give one of them, as {names}')
    others = sorted(p for p in folder.iterdir() if p.is_file() and p.name != FILE_NAME)
    known = next(filter(None, map(_known, others)), '')
    return SourceError(f'{folder} is no bag: it has no .mcap and no .db3 file{known}')


def _known(path: Path) -> str:
    """Return what a file is, if that is known, as the end of an error."""
    try:
        return f'; {path} is {kind(path)}: give it'
    except SourceError as error:
        return '' if ' is no bag in ' in str(error) else f'; {error}'


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


def _count(described: dict[str, Any]) -> int:
    count = described.get('message_count')
    return count if isinstance(count, int) else 0


def _mode(described: dict[str, Any]) -> str:
    return str(described.get('compression_mode') or '').lower()


def _number(path: Path) -> tuple[str, int, str]:
    """Return what sorts the files of a split bag: bag_2 before bag_10."""
    match = re.search(r'(.*?)(\d+)\.', path.name)
    return (match[1], int(match[2]), path.name) if match else (path.name, 0, '')
