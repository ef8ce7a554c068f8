"""Groups whose commands are imported when they are asked for: `agv bag info` loads no figures."""

from __future__ import annotations

from collections.abc import Iterator, MutableMapping
from importlib import import_module
from typing import Any

import typer
from rich.markup import escape
from typer.core import TyperGroup


class _Commands(MutableMapping[str, Any]):
    """Commands by name: some are there, of the others only the place is known so far."""

    def __init__(self, there: dict[str, Any], places: dict[str, str]) -> None:
        self.there = there
        self._places = places

    def __getitem__(self, name: str) -> Any:
        if name not in self.there:
            module, _, attribute = self._places[name].partition(':')
            found = getattr(import_module(f'agv_motion.cli.{module}'), attribute)
            self[name] = _command(found, name)
        return self.there[name]

    def __setitem__(self, name: str, command: Any) -> None:
        self.there[name] = command

    def __delitem__(self, name: str) -> None:
        self.there.pop(name, None)
        self._places.pop(name, None)

    def __iter__(self) -> Iterator[str]:
        return iter(self._places | self.there)

    def __len__(self) -> int:
        return len(self._places | self.there)


def _command(found: Any, name: str) -> Any:
    """Return the command of a function, or of an app of `typer`."""
    app = found
    if not isinstance(found, typer.Typer):
        app = typer.Typer()
        app.command(context_settings=HELP)(found)
    app._add_completion = False  # noqa: SLF001 - only the whole program offers that
    command: Any = typer.main.get_command(app)
    command.name = name
    _escape_help(command)
    return command


def _escape_help(command: Any) -> None:
    """Let the help of a command and of its own ones show square brackets, of units, as they are."""
    commands = getattr(command, 'commands', {})
    own = commands.there if isinstance(commands, _Commands) else commands
    for one in (command, *own.values()):
        one.help = escape(one.help) if one.help else one.help
        for parameter in one.params:
            if getattr(parameter, 'help', None):
                parameter.help = escape(parameter.help)


HELP = {'help_option_names': ['-h', '--help']}
"""How every command takes the question for help."""


def lazy_group(places: dict[str, str]) -> type[TyperGroup]:
    """Return a class of groups, for ``typer.Typer(cls=...)``, with these commands.

    Args:
        places: Of each name where its function, or its ``Typer``, is: ``'room.module:attribute'``
            in `agv_motion.cli`. They are listed in this order, before those that the group has
            itself.

    """

    class LazyGroup(TyperGroup):
        def __init__(self, *, commands: Any = None, **settings: Any) -> None:
            super().__init__(**settings)
            self.commands = _Commands(dict(commands or {}), dict(places))

        def list_commands(self, ctx: Any) -> list[str]:  # noqa: ARG002 - typer's signature
            return list(self.commands)

    return LazyGroup
