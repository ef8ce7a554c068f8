"""The terminal: text is shown as it is, square brackets included."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.markup import escape

if TYPE_CHECKING:
    from collections.abc import Iterator


def terminal(*, stderr: bool = False) -> Console:
    """Return a console that takes no `[text]` for markup: units and names are written so."""
    return Console(stderr=stderr, markup=False, emoji=False)


def escape_help(command: Any) -> None:
    """Let the help of a command, its options and all below it show square brackets as they are.

    Args:
        command: As typer builds it (``typer.main.get_command``).

    """
    for one in _below(command):
        one.help = escape(one.help) if one.help else one.help
        for parameter in one.params:
            if getattr(parameter, 'help', None):
                parameter.help = escape(parameter.help)


def _below(command: Any) -> Iterator[Any]:
    yield command
    for one in getattr(command, 'commands', {}).values():
        yield from _below(one)
