"""The terminal: text is shown as it is, square brackets included."""

from __future__ import annotations

from rich.console import Console


def terminal(*, stderr: bool = False) -> Console:
    """Return a console that takes no `[text]` for markup: units and names are written so."""
    return Console(stderr=stderr, markup=False, emoji=False)
