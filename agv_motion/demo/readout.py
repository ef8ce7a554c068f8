"""What stands beside the map of a demo: numbers of one width, a line each, in the room there is.

A column must not jump from picture to picture, and no number is shown as `-0.00`.
"""

from __future__ import annotations

from math import atan2, cos, pi, sin
from typing import TYPE_CHECKING

from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.planar import Pose

LABEL = 6
"""Characters of the word before each number"""

NOT_YET = 'not yet'
"""What stands where nothing has come"""

DOING = 30
"""Characters of what a robot does, before the bar"""


def number(value: float, width: int, digits: int, *, sign: bool = False) -> str:
    """Return a number of a width; what rounds to zero has no minus."""
    rounded = round(value, digits) + 0.0
    return f'{rounded:{"+" if sign and rounded else " " if sign else ""}{width}.{digits}f}'


def pace(factor: float) -> str:
    """Return how many times faster than life a demo runs, in words of one width."""
    return f'{factor:5.1f} times real time' if factor >= 0.05 else 'starting'.ljust(21)


def pose_text(pose: Pose) -> str:
    """Return where a robot stands, and its heading in (-180, 180] degrees."""
    heading = number(_half_turn(pose.theta) * 180.0 / pi, 4, 0)
    return f'{number(pose.x, 6, 2)} {number(pose.y, 6, 2)} m {heading}°'


def _half_turn(angle: float) -> float:
    return atan2(sin(angle), cos(angle))


def bar(share: float, doing: str, width: int) -> Table:
    """Return in one line what is done of the whole, in words and as a bar."""
    table = Table.grid(padding=(0, 1))
    table.add_column(width=DOING, no_wrap=True, overflow='ellipsis')
    table.add_column(width=max(width - DOING - 7, 4))
    table.add_column(width=5, no_wrap=True)
    done = min(max(share, 0.0), 1.0)
    table.add_row(Text(doing), ProgressBar(total=1.0, completed=done), f'{100 * done:3.0f} %')
    return table


def lines(rows: Sequence[tuple[str, str]], width: int, tall: int = 1) -> Table:
    """Return rows of a word and what it is now.

    Args:
        rows: Words and values; a value that is too long goes on below, or is cut at the end.
        width: Of all [characters].
        tall: Lines that a long value may take.

    """
    table = Table.grid(padding=(0, 1))
    table.add_column(width=LABEL, no_wrap=True)
    table.add_column(width=width - LABEL - 1, no_wrap=True, overflow='ellipsis')
    for name, value in rows:
        shown = _wrapped(value, width - LABEL - 1, tall)
        for i, line in enumerate(shown):
            table.add_row(name if not i else '', Text(line))
    return table


def paragraphs(values: Sequence[str], width: int, tall: int) -> list[Table]:
    """Return several sentences, each over the whole ``width``, in ``tall`` lines together.

    Each has as many lines as it takes; where there are too few, the longest is cut at its end.
    """
    heights = [len(_wrapped(value, width, tall)) for value in values]
    while sum(heights) > max(tall, len(values)):
        heights[heights.index(max(heights))] -= 1
    made = []
    for value, height in zip(values, heights, strict=True):
        table = Table.grid()
        table.add_column(width=width, no_wrap=True, overflow='ellipsis')
        for line in _wrapped(value, width, height):
            table.add_row(Text(line))
        made.append(table)
    return made


def _wrapped(value: str, width: int, tall: int) -> list[str]:
    """Return a value in lines, as many as it takes but no more than ``tall``."""
    if len(value) <= width:
        return [value]
    kept: list[str] = ['']
    for word in value.split(' '):
        if kept[-1] and len(kept[-1]) + 1 + len(word) > width and len(kept) < tall:
            kept.append(word)
        else:
            kept[-1] += f' {word}' if kept[-1] else word
    return kept
