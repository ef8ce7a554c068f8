"""`agv reprocess`: the nodes of a vehicle over recorded bags, as fast as it goes."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.cli.bag.many import Scheduler, Workers, jobs, outcomes_under_bar
from agv_motion.cli.bag.options import tell
from agv_motion.cli.recording.storage_options import Compression
from agv_motion.cli.terminal import LineTable, terminal
from agv_motion.errors import ConfigurationError
from agv_motion.visible import indented

if TYPE_CHECKING:
    from agv_motion.reprocess.one_bag import Plan, ReprocessOutcome

NODES = ('granier_probe', 'motion_generator', 'arbiter', 'wheel_kinematics')
DEFAULT = ','.join(NODES)
CONFIG = 'tree.yaml'
"""of nodes of this package, if none is given"""


def reprocess(
    bags: Annotated[
        list[Path], typer.Argument(metavar='IN... OUT', help='Bags, or folders of them; results.')
    ],
    *,
    config: Annotated[
        str | None, typer.Option('-c', '--config', help='Parameters: a path, or one of config/.')
    ] = None,
    nodes: Annotated[
        str, typer.Option('-n', '--nodes', help=f'By commas; else, without --node, {DEFAULT}.')
    ] = '',
    node: Annotated[
        list[str] | None, typer.Option(help='Any node of yours: package.module:Class; repeatable.')
    ] = None,
    namespace: Annotated[
        str, typer.Option('--namespace', help='Of the robot, such as oak for /oak/cmd_vel.')
    ] = '',
    remap: Annotated[
        list[str] | None,
        typer.Option('-m', '--remap', help='Name in the node:=name in the bag; one per option.'),
    ] = None,
    compression: Compression = 'zstd',
    workers: Workers = 1,
    scheduler: Scheduler = '',
) -> None:
    """Let the nodes decide again on what was recorded: without middleware, the same to the bit.

    Nodes hear from the bag what no other node says; everything that they say goes into a new bag,
    stamped with the time of the recording. A result appears only when it is whole, and a rerun of
    the same makes only what is not there yet. Examples:
    agv reprocess demo_output/bag before
    agv reprocess demo_output/bag after --config tuned.yaml
    agv bag diff before after
    agv reprocess recordings/2015 results/2015 --workers 8
    agv reprocess walk again --nodes wheel_kinematics
    agv reprocess walk tracked --node my_robot.tracker:Tracker --config tracker.yaml

    A node of yours must keep to publishers, subscriptions, timers and parameters; what would not be
    the same again (services, threads, the clock on the wall, spinning) is refused, with its line.

    The arbiter is left out of what was recorded without one. Where there was one, what
    motion_generator says goes to cmd_vel/agent as it did then, that of ghost_trajectory to
    cmd_vel/page, of route_follower to cmd_vel/route, of sequence to cmd_vel/sequence.
    """
    *sources, target = bags
    if not sources:
        msg = f'give at least one bag and where to write: agv reprocess {target} RESULT'
        raise ConfigurationError(msg)
    foreign = tuple(node or ())
    chosen = _chosen(nodes, foreign)
    pairs = tuple(_pair(one) for one in remap or ())
    file = (CONFIG if chosen else '') if config is None else config
    plan = _plan(file, chosen, pairs, compression, '/' + namespace.strip('/'))
    plan = plan._replace(foreign=foreign)
    found = sorted(
        outcomes_under_bar('Reprocessing', jobs(sources, target), plan, workers, scheduler)
    )
    _tell(found)
    if any(one.failure or one.lossy for one in found):
        raise typer.Exit(1)


def _chosen(nodes: str, foreign: tuple[str, ...]) -> tuple[str, ...]:
    """Return which nodes of this package to run, once those of others are known to be there.

    Raises:
        ConfigurationError: There is none at all.

    """
    if foreign:
        from agv_motion.reprocess.foreign.source import files_of

        sys.path.append(str(Path.cwd()))
        for target in foreign:
            files_of(target)
    chosen = tuple(name.strip() for name in nodes.split(',') if name.strip())
    if nodes and not chosen:
        msg = f'--nodes {nodes!r}: give at least one node; the default is {DEFAULT}'
        raise ConfigurationError(msg)
    return chosen or (() if foreign else NODES)


def _plan(
    config: str, nodes: tuple[str, ...], pairs: tuple[tuple[str, str], ...], codec: str, robot: str
) -> Plan:
    """Return what is to be done with each bag; tell whom the parameter file does not know.

    Raises:
        ConfigurationError: There is no such node, or no such file.

    """
    from agv_motion.reprocess.one_bag import Plan
    from agv_motion.reprocess.recorded import node_class, parameters

    for name in nodes:
        node_class(name)
        if not parameters(config, name, robot) and config:
            typer.echo(f'note: {config} has nothing for {name}, which takes its defaults', err=True)
    return Plan(config, nodes, pairs, codec, robot)


def _pair(remap: str) -> tuple[str, str]:
    """Return both names of a remapping."""
    name, mark, other = remap.partition(':=')
    if not (name and mark and other):
        msg = f"remap '{remap}': give NAME:=OTHER, such as pose:=fix"
        raise ConfigurationError(msg)
    return name, other


def _tell(found: list[ReprocessOutcome]) -> None:
    """Print what came of each bag, then what the nodes warned of."""
    table = LineTable()
    for title in ('bag', 'in', 'out', 'of time', 'took'):
        table.add_column(title, justify='left' if title == 'bag' else 'right')
    for one in found:
        tell(one.problems)
        if one.failure:
            typer.echo(f'error: {one.source}: {indented(one.failure)}', err=True)
            continue
        if one.made_before:
            table.add_row(one.source, '', 'there already', '', '')
            continue
        table.add_row(
            one.source, str(one.messages_in), str(one.messages_out), f'{one.seconds:.0f} s',
            f'{one.took:.1f} s',
        )  # fmt: skip
    if table.row_count:
        terminal().print(table)
    if any(one.simulated for one in found):
        typer.echo('note: the time is that of /clock in the bag')
    for missing in sorted({topic for one in found for topic in one.missing}):
        typer.echo(
            f'note: {missing} is not in the bag; if it has another name there, remap with -m'
        )
    _tell_complaints(found)


def _tell_complaints(found: list[ReprocessOutcome]) -> None:
    complaints: dict[str, int] = {}
    for one in found:
        for text, count in one.complaints.items():
            complaints[text] = complaints.get(text, 0) + count
    for text, count in sorted(complaints.items(), key=lambda item: -item[1])[:MOST_COMPLAINTS]:
        typer.echo(f'warning: {text}' + (f' ({count} times)' if count > 1 else ''))


MOST_COMPLAINTS = 10
"""that are told"""
