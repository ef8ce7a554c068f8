"""The terminal: text is shown as it is, square brackets included; a pipe breaks no line.

And nothing of it is obeyed (`agv_motion.cli.visible`): colours and places are our own.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from rich import table
from rich.console import Console

from agv_motion.cli.visible import in_line, visible

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rich.console import RenderableType
    from rich.segment import Segment
    from rich.text import Text

UNBROKEN = 10_000
"""Columns of what is no terminal: who reads it (`grep`, a file) has lines of any length"""


class LineTable(table.Table):
    """Columns without a frame, and rows of one line: no name in a cell begins another."""

    def __init__(self, *titles: str, **options: Any) -> None:
        """Begin without rows; options as of `rich`."""
        super().__init__(*titles, **{'box': None, 'pad_edge': False, **options})

    def add_row(self, *cells: RenderableType | None, **style: Any) -> None:
        """Add a row."""
        super().add_row(*(in_line(c) if isinstance(c, str) else c for c in cells), **style)


class _VisibleConsole(Console):
    """Draws no text that a terminal would obey."""

    def render(self, renderable: Any, options: Any = None) -> Iterable[Segment]:
        for segment in super().render(renderable, options):
            yield segment if segment.control else segment._replace(text=visible(segment.text))

    def render_str(self, text: str, **options: Any) -> Text:
        """Escape before the width is measured."""
        return super().render_str(visible(text), **options)


def terminal(*, stderr: bool = False) -> Console:
    """Return a console that takes no `[text]` for markup: units and names are written so."""
    console = _VisibleConsole(stderr=stderr, markup=False, emoji=False)
    if not console.is_terminal and 'COLUMNS' not in os.environ:
        console.width = UNBROKEN
    return console
