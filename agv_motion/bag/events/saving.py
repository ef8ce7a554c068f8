"""An event out of a recording: a small bag of its own, from files that are whole or torn."""

from __future__ import annotations

from contextlib import ExitStack, suppress
from typing import TYPE_CHECKING

from agv_motion.bag.editing.edit import Edit, edit
from agv_motion.bag.editing.recovery import Recovery
from agv_motion.bag.metadata import FILE_NAME, UNFINISHED
from agv_motion.bag.notes import NAME as NOTES
from agv_motion.bag.notes import Note, add_notes, carry, one_line
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import SourceError
from agv_motion.files.unfinished import beside, hidden_folder, told

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from agv_motion.bag.events.event import Event


def save(event: Event, files: Sequence[Path], recording: Path, folder: Path) -> Path:
    """Make the bag of an event; it appears when it is whole.

    Args:
        event: What happened.
        files: Of the recording, whole, in the order of time.
        recording: Its folder, in which its notes are.
        folder: In which the bag goes.

    Returns:
        The new bag.

    Raises:
        SourceError: A file is damaged, or the disk takes no more.

    """
    target = _free(folder, event.folder_name())
    span = event.begin, event.end + 1
    with ExitStack() as stack:
        bags = [stack.enter_context(BagReader(path)) for path in files]
        with beside(target) as made, told(target):
            edit(bags, made, Edit(spans=(span,), latched=True, record=event.record()))
            carry([recording], made, [span])
            add_notes(made / NOTES, [Note(m.stamp, _noted(m.reason)) for m in event.moments])
    return target


def save_torn(event: Event, files: Sequence[Path], folder: Path) -> Path | None:
    """Make the bag of an event whose recorder was killed; None where nothing of its time is there.

    Args:
        event: What happened.
        files: Of the recording, the last one torn.
        folder: In which the bag goes.

    Raises:
        SourceError: A file cannot be read at all, or the disk takes no more.

    """
    wanted = [path for path in files if _overlaps(path, event)]
    if not wanted:
        return None
    with hidden_folder(folder / 'saving') as room:
        whole = [_whole(path, room / str(number)) for number, path in enumerate(wanted)]
        return save(event, whole, wanted[0].parent, folder)


def recording_files(recording: Path) -> list[Path]:
    """Return the files of a recording in the order in which they were written."""

    def number(path: Path) -> int:
        last = path.stem.rpartition('_')[2]
        return int(last) if last.isdecimal() else -1

    return sorted(recording.glob('*.mcap'), key=number)


def delete_recording(recording: Path) -> None:
    """Delete the files that a recorder has written; whatever else lies there stays."""
    others = (recording / name for name in (FILE_NAME, UNFINISHED, NOTES))
    for path in (*recording_files(recording), *others):
        with suppress(OSError):
            path.unlink(missing_ok=True)
    with suppress(OSError):
        recording.rmdir()


def last_stamp(files: Sequence[Path]) -> int:
    """Return the last log time [ns] of files, torn or not; 0 without messages."""
    latest = 0
    for path in files:
        with suppress(SourceError), BagReader(path) as bag:
            latest = max(latest, bag.end)
    return latest


def _noted(reason: str) -> str:
    """Return a reason as a note can hold it: a trigger may be longer, a journal may hold none."""
    return one_line(reason) or 'marked'


def _overlaps(path: Path, event: Event) -> bool:
    try:
        with BagReader(path) as bag:
            return bool(bag.message_count) and bag.start <= event.end and bag.end >= event.begin
    except SourceError:  # nothing was written into it yet
        return False


def _whole(path: Path, place: Path) -> Path:
    """Return a file that is whole: itself, or a new one with what could be read of it."""
    with BagReader(path) as bag:
        if not bag.lossy:
            return path
    with BagWriter(place) as writer:
        Recovery(writer).save(path)
    return recording_files(place)[0]


def _free(folder: Path, name: str) -> Path:
    """Return where a bag of this name can go, which may end in another number."""
    target, number = folder / name, 1
    while target.exists() or target.is_symlink():
        number += 1
        target = folder / f'{name}_{number}'
    return target
