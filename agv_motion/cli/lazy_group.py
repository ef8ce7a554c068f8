"""Groups whose commands are imported when they are asked for: `agv bag info` loads no figures."""

from __future__ import annotations

import re
from collections.abc import Iterator, MutableMapping
from importlib import import_module
from math import isfinite
from typing import TYPE_CHECKING, Any

import typer
from rich.markup import escape
from typer.core import TyperGroup

if TYPE_CHECKING:
    from collections.abc import Callable


LARGEST = 1e15
"""Number that a command takes; more seconds than that overflow where they become nanoseconds."""


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
    _prepare(command)
    return command


def _prepare(command: Any) -> None:
    """Let a command and its own ones show help that fills any width, and square brackets of units.

    And let none take a number that is not finite, or hardly so: each comparison with NaN is false,
    so that it passes every range, and a limit of time that is NaN never comes.
    """
    commands = getattr(command, 'commands', {})
    own = commands.there if isinstance(commands, _Commands) else commands
    for one in (command, *own.values()):
        one.help = escape(flowing(one.help)) if one.help else one.help
        for parameter in one.params:
            if getattr(parameter, 'help', None):
                parameter.help = escape(parameter.help)
            parameter.callback = _finite(parameter.callback)


def flowing(text: str) -> str:
    """Return the help of a command with the lines of each paragraph joined, for any width.

    Examples keep a line each, one below the other; so does what is indented.
    """
    joined = re.sub(r'(?<=\S)\n(?!\s|agv )', ' ', text)
    return re.sub(r'\n\n(?=agv )', '\n', joined)


def _finite(then: Callable[..., Any] | None) -> Callable[..., Any]:
    """Return a callback of a parameter that refuses NaN, infinity and more than ``LARGEST``."""

    def check(context: Any, parameter: Any, value: Any) -> Any:
        for one in value if isinstance(value, (list, tuple)) else (value,):
            if isinstance(one, float) and value != parameter.default and not abs(one) <= LARGEST:
                what = f'larger than {LARGEST:g}' if isfinite(one) else 'no finite number'
                msg = f'{one} is {what}'
                raise typer.BadParameter(msg, ctx=context, param=parameter)
        return then(context, parameter, value) if then else value

    return check


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

        def resolve_command(self, ctx: Any, args: list[str]) -> Any:
            found = super().resolve_command(ctx, args)
            for parameter in self.params if not ctx.resilient_parsing else ():
                source = ctx.get_parameter_source(parameter.name)
                if source is not None and source.name == 'COMMANDLINE':
                    msg = (
                        f'it stands before {found[0]!r} and would count for nothing: give it after'
                    )
                    raise typer.BadParameter(msg, ctx=ctx, param=parameter)
            return found

    return LazyGroup
