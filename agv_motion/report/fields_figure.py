"""Fields of a bag over time, in panels."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.columns.columns import read_topic
from agv_motion.bag.columns.field_name import topic_and_field
from agv_motion.errors import ConfigurationError
from agv_motion.report import style
from agv_motion.report.figure import figure

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.bag.columns.columns import Columns
    from agv_motion.bag.reader import BagReader

MOST_LINES = 24
"""of one panel"""

_LONGEST_NOTE = 40
"""characters of a note that are drawn"""
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
        ConfigurationError: A field is not there, or it is no number, or there are too many.

    """
    panel: list[FieldLine] = []
    for name in names.split(','):
        topic, field = topic_and_field(bag, name)
        columns = read_topic(bag, topic, [field] if field else None, start, stop)
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
                axes[str(i)].plot(
                    *style.thinned(line.time, line.values), label=line.label, color=colour,
                    ls=dash, lw=1.0,
                )  # fmt: skip
            axes[str(i)].legend(loc='lower left', bbox_to_anchor=(0.0, 1.0), ncols=2)
            axes[str(i)].grid()
        for time, words in notes:
            for panel_axes in axes.values():
                panel_axes.axvline(time, color=style.OTHERS[1], lw=0.8, ls=':')
            place = (time, 1.0)
            axes['0'].annotate(
                words[:_LONGEST_NOTE], place, xycoords=('data', 'axes fraction'), rotation=90,
                va='top', ha='right', fontsize='small',
            )  # fmt: skip
        axes[str(len(panels) - 1)].set_xlabel('time since the start of the bag [s]')


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
