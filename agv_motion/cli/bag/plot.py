"""`agv bag plot`: fields of topics over time, with the words of `rqt_plot`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from agv_motion.cli.bag.options import Bag, Duration, StartOffset, opened, span
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.bag.columns.columns import Columns
    from agv_motion.bag.reader import BagReader

MOST_LINES = 24
"""of one panel"""


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
    from agv_motion.bag.columns.columns import read_topic
    from agv_motion.report.figure import figure

    panels: list[list[tuple[str, Any, Any]]] = []
    with opened(bag) as reader:
        limits = span(reader, start_offset, duration)
        for argument in fields:
            panel: list[tuple[str, Any, Any]] = []
            for name in argument.split(','):
                topic, field = _split(reader, name)
                columns = read_topic(reader, topic, [field] if field else None, *limits)
                time = (columns.stamps - reader.start) * 1e-9
                panel += [(f'{topic} {path}', time, y) for path, y in _lines(columns)]
            if not 0 < len(panel) <= MOST_LINES:
                msg = f'{argument} has {len(panel)} numbers, expected 1 to {MOST_LINES}: be exact'
                raise ConfigurationError(msg)
            panels.append(panel)
        mosaic = [[str(i)] for i in range(len(panels))]
        size = (10.0, 1.5 + 2.5 * len(panels))
        with figure(output, mosaic, figsize=size, sharex=True) as axes:
            for i, panel in enumerate(panels):
                for label, time, values in panel:
                    axes[str(i)].plot(time, values, label=label, linewidth=1.0)
                axes[str(i)].legend(loc='upper right', fontsize='small')
                axes[str(i)].grid(alpha=0.3)
            axes[str(len(panels) - 1)].set_xlabel('time since the start of the bag [s]')
        typer.echo(f'Figure: {output}')


def _split(bag: BagReader, name: str) -> tuple[str, str]:
    """Return the topic at the beginning of a name, and the path of the field after it."""
    fits = [topic for topic in bag.topics if name == topic or name.startswith(f'{topic}/')]
    if not fits:
        msg = f"'{name}' is in no topic of bag {bag.path}; it has {', '.join(sorted(bag.topics))}"
        raise ConfigurationError(msg)
    topic = max(fits, key=len)
    return topic, name[len(topic) :].strip('/').replace('/', '.')


def _lines(columns: Columns) -> Iterator[tuple[str, Any]]:
    """Yield name and values of everything that can be drawn; not of stamps."""
    for path, column in columns.fields.items():
        if not isinstance(column, np.ndarray) or column.dtype.kind not in 'fiub':
            continue
        if 'stamp.' in path:
            continue
        table = column.reshape(len(columns.stamps), -1)
        for i in range(table.shape[1]):
            yield (f'{path}[{i}]' if column.ndim > 1 else path), table[:, i]
