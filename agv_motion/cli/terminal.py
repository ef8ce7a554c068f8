"""The terminal: text is shown as it is, square brackets included; a pipe breaks no line."""

from __future__ import annotations

import os

from rich.console import Console

UNBROKEN = 10_000
"""Columns of what is no terminal: who reads it (`grep`, a file) has lines of any length"""


def terminal(*, stderr: bool = False) -> Console:
    """Return a console that takes no `[text]` for markup: units and names are written so."""
    console = Console(stderr=stderr, markup=False, emoji=False)
    if not console.is_terminal and 'COLUMNS' not in os.environ:
        console.width = UNBROKEN
    return console
