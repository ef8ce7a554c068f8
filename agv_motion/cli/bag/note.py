"""`agv bag note`: a few words at a moment of a bag."""

from __future__ import annotations

import time
from typing import Annotated

import typer

from agv_motion.cli.bag.options import Bag, moment
from agv_motion.errors import ConfigurationError


def note(
    bag: Bag,
    text: Annotated[str, typer.Argument(help='The words, such as "rain began".')],
    *,
    at: Annotated[
        str,
        typer.Option(help="When: '14:32' (UTC), '14:32+02:00', 90 [s after the start]; or now."),
    ] = '',
) -> None:
    """Note something at a moment of a bag; also while it is being recorded.

    The data are not touched: notes stand in notes.jsonl in the folder of the bag, one line each.
    agv bag info, echo and plot show them, the page too, and every command that makes a bag out of
    this one carries them along. Without --at the note is about now. Examples:

    agv bag note walk "rain began" --at 14:32

    agv bag note walk "kicked by a child" --at 93.5

    agv bag note recording "sun is out"
    """
    from agv_motion.bag.editing.moments import moment as stamp_of
    from agv_motion.bag.notes import Note, add_note
    from agv_motion.bag.reader import BagReader

    with BagReader(bag) as reader:
        start, end = reader.start, reader.end
        going_on = any(not file.indexed for file in reader.files)
    now = time.time_ns()
    stamp = stamp_of(at, start, end) if at else now
    last = max(end, now) if going_on and not at else end
    if not start <= stamp <= last:
        where = f'{moment(stamp)} is not in the bag, which reaches from {moment(start)} to '
        msg = f'{where}{moment(end)}: give --at, as in 14:32+02:00 for another zone'
        raise ConfigurationError(msg)
    add_note(bag, Note(stamp, text))
    typer.echo(f'{bag}: noted at {moment(stamp)}, {(stamp - start) * 1e-9:.3f} s after the start')
