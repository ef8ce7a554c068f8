"""What a reprocessed bag was made of, kept beside it: so a rerun knows what is done already.

Two results with the same fingerprint are the same: it is of the files of the source, of all
parameters, of the nodes, and of the code of this package.
"""

from __future__ import annotations

import hashlib
import json
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import agv_motion
from agv_motion.errors import AgvMotionError
from agv_motion.files import json_text
from agv_motion.files.unfinished import replacing

if TYPE_CHECKING:
    from collections.abc import Iterator

FILE_NAME = 'reprocessed.json'


def fingerprint(source: Path, made_by: Any) -> str:
    """Return the SHA-256, in hexadecimal digits, of all that a result depends on.

    Args:
        source: The bag.
        made_by: Nodes, parameters, names: whatever `repr` tells whole.

    """
    files = [(str(name), *_size_and_time(path)) for name, path in _files(source)]
    return hashlib.sha256(repr((files, made_by, _code())).encode()).hexdigest()


def note(target: Path, source: Path, digest: str) -> None:
    """Write into a finished bag what it was made of."""
    content = {'source': str(source), 'fingerprint': digest}
    with replacing(target / FILE_NAME) as made:
        made.write_text(json.dumps(content, indent=1) + '\n', 'utf-8')


def is_made(target: Path, digest: str) -> bool:
    """Return whether ``target`` is a whole result with this fingerprint."""
    try:
        content = json_text.load(target / FILE_NAME, 'the note').value
    except (AgvMotionError, OSError):
        return False
    return isinstance(content, dict) and content.get('fingerprint') == digest


def _files(source: Path) -> Iterator[tuple[Path, Path]]:
    if source.is_dir():
        yield from sorted((p.relative_to(source), p) for p in source.rglob('*') if p.is_file())
    else:
        yield Path(source.name), source


def _size_and_time(path: Path) -> tuple[int, int]:
    found = path.stat()
    return found.st_size, found.st_mtime_ns


@cache
def _code() -> str:
    """Return the SHA-256 of the code of this package."""
    digest = hashlib.sha256()
    folder = Path(agv_motion.__file__).parent
    for path in sorted(folder.rglob('*.py')):
        digest.update(str(path.relative_to(folder)).encode() + b'\0' + path.read_bytes())
    return digest.hexdigest()
