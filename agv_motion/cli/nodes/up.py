"""`agv up`: all nodes of a robot, as its launch file starts them, without the launch package."""

from __future__ import annotations

import os
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
import yaml

from agv_motion.cli.graph.completion import one_of
from agv_motion.cli.lazy_group import HELP
from agv_motion.errors import ConfigurationError
from agv_motion.ros.graph_arguments import checked, is_true, started, typed
from agv_motion.ros.parameter_arguments import VALUES
from agv_motion.ros.robot_graphs import ROBOTS, SIM_TIME, GraphNode, RobotGraph
from agv_motion.ros.suggestion import meant

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

app = typer.Typer()

FORMAT = 'RCUTILS_CONSOLE_OUTPUT_FORMAT'
"""Variable of the environment that tells nodes how to log"""

Words = Annotated[
    list[str] | None,
    typer.Argument(help='Arguments of the launch file: --namespace oak, or namespace:=oak.'),
]


@app.command(context_settings=HELP | {'ignore_unknown_options': True})
def up(
    robot: Annotated[
        str,
        typer.Argument(help=f'One of {", ".join(ROBOTS)}.', autocompletion=one_of(lambda: ROBOTS)),
    ],
    words: Words = None,
    *,
    show_args: Annotated[
        bool, typer.Option('--show-args', '-s', help='Tell which arguments there are.')
    ] = False,
) -> None:
    """Start all nodes of a robot, until Ctrl-C ends them with their wheels at rest.

    The same graph and the same arguments as of the launch files, without the launch package.
    Each line is printed after the name of its node. Examples:
    agv up tree --namespace oak --time-factor 10.0
    agv up differential namespace:=hare simulate:=false use_sim_time:=false
    """
    if robot not in ROBOTS:
        msg = f"no robot '{robot}'{meant(robot, list(ROBOTS))}; there are {', '.join(ROBOTS)}"
        raise ConfigurationError(msg)
    graph = ROBOTS[robot]
    if show_args:
        for one in graph.arguments:
            typer.echo(f"'{one.name}': {one.text} (default: '{one.default}')")
        return
    given = arguments(graph, words or [])
    from agv_motion.ros.process_group import ProcessGroup
    from agv_motion.ros.stop import Stop

    stop = Stop()
    with tempfile.TemporaryDirectory(prefix='agv_up_') as folder:
        commands = {node.name: command(node, given, Path(folder)) for node in started(graph, given)}
        respawn = is_true('respawn', given['respawn'])
        group = ProcessGroup(commands, teller(), respawn=respawn)
        group.run(lambda: stop.requested)
    if group.failed:
        raise typer.Exit(1)


def teller() -> Callable[[str], None]:
    """Return what prints a line of a node.

    On a terminal that is its message, and its severity where that is more than a word of good news:
    the name stands before it already. What is piped has name and time as ROS gives them.
    """
    if not sys.stdout.isatty() or FORMAT in os.environ:
        return typer.echo
    os.environ[FORMAT] = '{severity}: {message}'
    return lambda line: typer.echo(line.replace('] INFO: ', '] ', 1))


def arguments(graph: RobotGraph, words: Sequence[str]) -> dict[str, str]:
    """Return the value of each argument of a robot.

    Args:
        graph: Of the robot.
        words: As typed: ``--name value``, ``--name=value`` or ``name:=value``.

    Raises:
        ConfigurationError: There is no such argument, one has no value or an impossible one, or
            the file cannot be read.

    """
    values = {one.name: one.default for one in graph.arguments}
    for name, value in _pairs(words):
        if name not in values:
            msg = f"no argument '{name}'{meant(name, list(values))}; there are {', '.join(values)}"
            raise ConfigurationError(msg)
        values[name] = value
    values = checked(graph, values)
    changed = {one.name for one in graph.arguments if values[one.name] != one.default}
    for node in started(graph, values):
        _require_possible(node, values, changed)
    return values


def _require_possible(node: GraphNode, given: Mapping[str, str], changed: set[str]) -> None:
    """Raise unless a node can have the values that were given for it: else it alone would end."""
    from agv_motion.nodes.catalogue import parameters_of

    own = {
        name: typed(name, text.format(**given), kind)
        for name, text, kind in node.values
        if name != SIM_TIME[0] and any(f'{{{one}}}' in text for one in changed)
    }
    if own:
        replace(parameters_of(node.name)(), **own)


def _pairs(words: Sequence[str]) -> Iterator[tuple[str, str]]:
    rest = iter(words)
    for word in rest:
        mark = '=' if word.startswith('--') else ':='
        name, found, value = word.partition(mark)
        following = next(rest, None) if not found and word.startswith('--') else value
        if following is None or (not found and not word.startswith('--')):
            msg = f"'{word}': write --name value, or name:=value"
            raise ConfigurationError(msg)
        yield name.removeprefix('--').replace('-', '_'), following


def command(node: GraphNode, given: Mapping[str, str], folder: Path) -> list[str]:
    """Return the words that start a node; its own parameters come into a file in ``folder``."""
    space = f'/{given["namespace"]}' if given['namespace'] else '/'
    values = {name: typed(name, text.format(**given), kind) for name, text, kind in node.values}
    own = folder / f'{node.name}.yaml'
    full = f'{space.rstrip("/")}/{node.name}'
    own.write_text(yaml.safe_dump({full: {VALUES: values}}), encoding='utf-8')
    rules = {'__node': node.name, '__ns': space} | {
        source: target.format(**given) for source, target in node.remappings
    }
    remappings = [w for source, target in rules.items() for w in ('-r', f'{source}:={target}')]
    files = [w for path in (given['config'], str(own)) for w in ('--params-file', path)]
    program = [sys.executable, '-m', f'agv_motion.nodes.{node.name}']
    return [*program, '--ros-args', *remappings, *files]
