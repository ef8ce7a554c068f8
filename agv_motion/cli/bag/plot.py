"""`agv bag plot`: fields of topics over time, with the words of `rqt_plot`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.cli.bag.options import Bag, Duration, StartOffset, opened, span

if TYPE_CHECKING:
    from agv_motion.bag.reader import BagReader


def plot(
    bag: Bag,
    fields: Annotated[
        list[str], typer.Argument(help='Such as /odom/pose/pose/position; a panel each.')
    ],
    *,
    output: Annotated[Path, typer.Option('--output', '-o', help='Picture to draw.')] = Path(
        'bag.png'
    ),
    start_offset: StartOffset = 0.0,
    duration: Duration = -1.0,
) -> None:
    """Draw fields over time: a panel for each argument, commas put several into one panel.

    A field stands for all numbers in it. Examples:

    agv bag plot walk /cmd_vel/twist/linear /joints/position -o walk.png

    agv bag plot walk /cmd_vel/twist/linear/x,/odom/twist/twist/linear/x
    """
    from agv_motion.report.fields_figure import draw, read_panel

    with opened(bag) as reader:
        limits = span(reader, start_offset, duration)
        panels = [read_panel(reader, argument, *limits) for argument in fields]
        draw(panels, output, _notes(reader, *limits))
        typer.echo(f'Figure: {output}')


def _notes(bag: BagReader, start: int | None, stop: int | None) -> list[tuple[float, str]]:
    """Return the notes within a span, each with its time since the start of the bag [s]."""
    from agv_motion.bag.notes import notes_of

    first, last = start or bag.start, bag.end + 1 if stop is None else stop
    return [
        ((note.stamp - bag.start) * 1e-9, note.text)
        for note in notes_of(bag.path)
        if first <= note.stamp < last
    ]
