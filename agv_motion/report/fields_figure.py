"""Fields of a bag over time, in panels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.columns.columns import read_topic
from agv_motion.bag.columns.field_name import topic_and_field
from agv_motion.errors import ConfigurationError
from agv_motion.report import style, wording
from agv_motion.report.figure import figure

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from agv_motion.bag.columns.columns import Columns
    from agv_motion.bag.reader import BagReader

MOST_LINES = 24
"""of one panel"""

MOST_NAMED = 8
"""Lines of a panel that are named at their ends; more have a legend beside it."""

_LONGEST_TITLE = 100
DASHES = ('-', '--', '-.', ':')
"""Of a line, by how often its colour was there before in its panel."""


class FieldLine(NamedTuple):
    """The numbers of one field."""

    label: str
    time: NDArray[np.floating[Any]]
    """(n,) since the start of the bag [s]"""
    values: Any
    """(n,)"""


def read_panel(
    bag: BagReader, names: str, start: int | None = None, stop: int | None = None
) -> list[FieldLine]:
    """Return all numbers in some fields.

    Args:
        bag: Open.
        names: Such as ``/cmd_vel/twist/linear``; several with commas between them.
        start: First log time [ns]; None: the whole bag.
        stop: Log time before which to stop [ns].

    Raises:
        ConfigurationError: A field is not there, it is no number, there are too many, or no
            message has one.

    """
    panel: list[FieldLine] = []
    for name in names.split(','):
        topic, field = topic_and_field(bag, name)
        columns = read_topic(bag, topic, [field] if field else None, start, stop)
        if not len(columns.stamps):
            msg = f'bag {bag.path} has no message on {topic} in this time: nothing to draw'
            raise ConfigurationError(msg)
        time = (columns.stamps - bag.start) * 1e-9
        panel += [FieldLine(f'{topic} {path}', time, y) for path, y in _lines(columns)]
    if not 0 < len(panel) <= MOST_LINES:
        msg = f'{names} has {len(panel)} numbers, expected 1 to {MOST_LINES}: be exact'
        raise ConfigurationError(msg)
    return panel


def draw(
    panels: Sequence[Sequence[FieldLine]], path: Path, notes: Sequence[tuple[float, str]] = ()
) -> None:
    """Draw panels one below the other.

    Args:
        panels: What is in each.
        path: Picture to draw.
        notes: Words that stand at a time since the start of the bag [s], in the first panel.

    Raises:
        ConfigurationError: matplotlib is not installed, or does not know the kind of picture.
        SourceError: The file cannot be written.

    """
    mosaic = [[str(i)] for i in range(len(panels))]
    size = (style.WIDTH, 1.5 + 2.5 * len(panels))
    with figure(path, mosaic, figsize=size, sharex=True) as axes:
        for i, panel in enumerate(panels):
            for k, line in enumerate(panel):
                colour, dash = style.LINES[k % len(style.LINES)], DASHES[k // len(style.LINES)]
                _draw_line(axes[str(i)], line, colour, dash, named=len(panel) <= MOST_NAMED)
            _name(axes[str(i)], panel)
            axes[str(i)].grid()
        for time, words in notes:
            said = wording.clipped(words, wording.LONGEST_NOTE)
            style.event(axes['0'], time, said, also=[axes[str(i)] for i in range(1, len(panels))])
        axes[str(len(panels) - 1)].set_xlabel('time since the start of the bag [s]')


def _draw_line(axes: Axes, line: FieldLine, colour: str, dash: str, *, named: bool) -> None:
    """Draw a field, and name it at its end where there is room for that."""
    field = line.label.partition(' ')[2]
    axes.plot(
        *style.thinned(line.time, line.values), label=field, color=colour, ls=dash, lw=1.0,
        marker='.' if len(line.time) == 1 else '',
    )  # fmt: skip
    told = np.flatnonzero(np.isfinite(np.asarray(line.values, dtype=float)))
    if named and len(told):
        style.line_label(axes, float(line.values[told[-1]]), field, colour)


def _name(axes: Axes, panel: Sequence[FieldLine]) -> None:
    """Name the topics of a panel over it, and its fields beside it where they are many."""
    topics = dict.fromkeys(line.label.partition(' ')[0] for line in panel)
    axes.set_title(wording.clipped(', '.join(topics), _LONGEST_TITLE))
    if len(panel) > MOST_NAMED:
        axes.legend(loc='center left', bbox_to_anchor=(1.0, 0.5), ncols=2)


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
