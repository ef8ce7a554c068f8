"""Cut every file of the MCAP conformance suite off at every byte: is all saved that lies whole?

    python launch_scripts/trials/trial_recovery.py [ARCHIVE] [EVERY]

mcap_conformance.tar.gz (else that in the folder
AGV_MOTION_DATA), all its files or every so-manieth. Ends with status 1 where a message, attachment
or metadata are lost, or where nobody is told of it.
test/bag/mcap/test_conformance.py is the short form.
"""

from __future__ import annotations

import os
import sys
import tarfile
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.bag.editing.recovery import Recovery
from agv_motion.bag.mcap import records
from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.bag.metadata import Topic

SUITE = 'mcap_conformance.tar.gz'
MEMORY = Path('/dev/shm')  # noqa: S108 - files that are truncated a thousand times each
BEGIN = len(records.MAGIC)
CHUNK_HEAD = 8 + 8 + 8 + 4 + 4 + 8
"""[bytes] before the content of a chunk that is not compressed, as none of the suite is"""
Kept = tuple[object, ...]


def archive() -> Path | None:
    """Return the suite, where it is beside the repository or in AGV_MOTION_DATA."""
    root = Path(__file__).resolve().parents[2]
    folders = [os.environ.get('AGV_MOTION_DATA'), root.parent / 'shared' / 'data']
    return next((Path(f) / SUITE for f in folders if f and (Path(f) / SUITE).exists()), None)


def unpacked(packed: Path, folder: Path) -> list[Path]:
    """Unpack the suite; return its files."""
    with tarfile.open(packed) as tar:
        tar.extractall(folder, filter='data')
    return sorted(folder.rglob('*.mcap'))


def whole(data: bytes, position: int = BEGIN) -> list[Kept]:
    """Return what lies whole in the bytes: messages, and the names of other things."""
    found: list[Kept] = []
    while position + records.PREFIX.size <= len(data):
        opcode, length = records.PREFIX.unpack_from(data, position)
        head, body, position = position, position + 9, position + 9 + length
        if opcode == records.CHUNK:
            found += whole(data[: min(position, len(data))], body + CHUNK_HEAD)
        elif position > len(data) or opcode == records.DATA_END:
            break
        elif opcode == records.MESSAGE:
            _, _, _, sequence, stamp, publish = records.MESSAGE_HEAD.unpack_from(data, head)
            content = data[head + records.MESSAGE_HEAD.size : position]
            found.append((stamp, publish, sequence, content))
        elif opcode in {records.ATTACHMENT, records.METADATA}:
            at = body + 16 * (opcode == records.ATTACHMENT)
            size = int.from_bytes(data[at : at + 4], 'little')
            found.append((opcode, data[at + 4 : at + 4 + size].decode()))
    return found


class Collected:
    """Takes what is saved, in place of a bag."""

    def __init__(self) -> None:
        """Begin with nothing."""
        self.kept: list[Kept] = []
        self._topics = 0

    def add(self, _: Topic) -> int:
        """Return a handle."""
        self._topics += 1
        return self._topics

    def write(self, _: int, stamp: int, data: bytes, publish: int, sequence: int) -> None:
        """Take a message."""
        self.kept.append((stamp, publish, sequence, bytes(data)))

    def keep(self, extra: records.Attachment | records.Metadata) -> None:
        """Take something else."""
        attached = isinstance(extra, records.Attachment)
        self.kept.append((records.ATTACHMENT if attached else records.METADATA, extra.name))


def lost(file: Path, data: bytes) -> str:
    """Return what does not hold of the first bytes of ``data``, which are in a file."""
    size = file.stat().st_size
    target = Collected()
    recovery = Recovery(target)  # type: ignore[arg-type] # it has what is needed of a BagWriter
    try:
        recovery.save(file)
    except SourceError as error:
        recovery.problems.append(error)
    expected = sorted(whole(data[:size]), key=str) if size > BEGIN else []
    if sorted(target.kept, key=str) != expected:
        return f'{len(target.kept)} saved, {len(expected)} lie whole'
    quiet = all(getattr(problem, 'harmless', False) for problem in recovery.problems)
    if quiet and not recovery.missing and expected != sorted(whole(data), key=str):
        return 'nothing is told of what is lost'
    return ''


def cut_off(file: Path, sizes: Iterator[int] | range) -> Iterator[tuple[int, str]]:
    """Yield the sizes, falling, at which something does not hold of a file; it is cut off so."""
    data = file.read_bytes()
    for size in sizes:
        os.truncate(file, size)
        finding = lost(file, data)
        if finding:
            yield size, finding


def main(words: list[str]) -> int:
    """Cut and save, print what does not hold, and return the status."""
    packed = Path(words[0]) if words else archive()
    if packed is None:
        sys.stderr.write(f'{SUITE} is not here: name it, or set AGV_MOTION_DATA to its folder\n')
        return 1
    begun, tried, failed = time.monotonic(), 0, 0
    parent = MEMORY if MEMORY.is_dir() else None
    with tempfile.TemporaryDirectory(dir=parent) as name:
        files = unpacked(packed, Path(name))[:: int(words[1]) if words[1:] else 1]
        for number, file in enumerate(files):
            size = file.stat().st_size
            found = list(cut_off(file, range(size, -1, -1)))
            tried, failed = tried + size + 1, failed + len(found)
            for at, finding in found[:3]:
                print(f'{file.name} cut off at {at}: {finding} ({len(found)} places)', flush=True)
            if number % 50 == 49:
                print(f'{number + 1} files, {time.monotonic() - begun:.0f} s', flush=True)
    print(
        f'{len(files)} files cut off at {tried} places in {time.monotonic() - begun:.0f} s: '
        f'at {failed} of them something was lost'
    )
    return int(failed > 0)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
