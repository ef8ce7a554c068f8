"""The terminal: text is shown as it is, square brackets included; a pipe breaks no line.

And nothing of it is obeyed (`agv_motion.visible`): colours and places are our own.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from rich import table
from rich.console import Console

from agv_motion.visible import in_line, visible

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rich.console import ConsoleOptions, RenderableType, RenderResult
    from rich.segment import Segment
    from rich.text import Text

UNBROKEN = 10_000
"""Columns of what is no terminal: who reads it (`grep`, a file) has lines of any length"""


class LineTable(table.Table):
    """Columns without a frame, and rows of one line: no name in a cell begins another.

    The names stand in the first column, and none of them is broken: where a terminal is too narrow
    for them and for the numbers beside, it breaks the line itself, and what is copied is whole.
    """

    def __init__(self, *titles: str, **options: Any) -> None:
        """Begin without rows; options as of `rich`."""
        super().__init__(*titles, **{'box': None, 'pad_edge': False, **options})

    def add_column(self, header: RenderableType = '', *rest: Any, **options: Any) -> None:
        """Add a column; the first is not broken, unless ``no_wrap=False`` says so."""
        super().add_column(header, *rest, **{'no_wrap': not self.columns, **options})

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Draw it, as wide as the longest words need."""
        least = self.__rich_measure__(console, options.update(max_width=UNBROKEN)).minimum
        return super().__rich_console__(
            console, options.update_width(max(options.max_width, least))
        )

    def add_row(self, *cells: RenderableType | None, **style: Any) -> None:
        """Add a row."""
        super().add_row(*(in_line(c) if isinstance(c, str) else c for c in cells), **style)


class _VisibleConsole(Console):
    """Draws no text that a terminal would obey."""

    def render(self, renderable: Any, options: Any = None) -> Iterable[Segment]:
        for segment in super().render(renderable, options):
            yield segment if segment.control else segment._replace(text=visible(segment.text))

    def print(self, *objects: Any, **options: Any) -> None:
        """Print; of a table nothing is cut off."""
        options.setdefault('crop', not any(isinstance(one, LineTable) for one in objects))
        super().print(*objects, **options)

    def render_str(self, text: str, **options: Any) -> Text:
        """Escape before the width is measured."""
        return super().render_str(visible(text), **options)


def terminal(*, stderr: bool = False) -> Console:
    """Return a console that takes no `[text]` for markup: units and names are written so."""
    console = _VisibleConsole(stderr=stderr, markup=False, emoji=False)
    if not console.is_terminal and 'COLUMNS' not in os.environ:
        console.width = UNBROKEN
    return console
