"""`agv node`: the words, options and output of `ros2 node`, for a machine without it."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from agv_motion.cli.graph.discovery import DISCOVERY
from agv_motion.cli.graph.nodes import absolute, node_names
from agv_motion.cli.graph.options import NoDaemon, Node, SimTime, SpinTime
from agv_motion.cli.graph.session import joined
from agv_motion.errors import ConfigurationError
from agv_motion.ros.suggestion import meant

app = typer.Typer(
    no_args_is_help=True,
    help='Nodes of the graph, with the words and the output of `ros2 node`; see agv nodes too.',
)


@app.command(name='list')
def list_(
    *,
    all_: Annotated[bool, typer.Option('-a', '--all', help='Hidden ones as well.')] = False,
    count_nodes: Annotated[bool, typer.Option('-c', '--count-nodes', help='Count.')] = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
    no_daemon: NoDaemon = False,  # noqa: ARG001 - taken as ros2 does, without effect
) -> None:
    """List the nodes of the graph."""
    with joined(spin_time, use_sim_time=use_sim_time, whole=True) as node:
        found = node_names(node, hidden=all_)
        if len(set(found)) < len(found) and not count_nodes:
            typer.echo(
                'WARNING: Be aware that there are nodes in the graph that share an exact name, '
                'which can have unintended side effects.',
                err=True,
            )
        for line in [len(found)] if count_nodes else found:
            typer.echo(line)


@app.command()
def info(
    node_name: Node,
    *,
    include_hidden: Annotated[
        bool, typer.Option('--include-hidden', help='Hidden topics and services as well.')
    ] = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """Tell the topics, services and actions of a node.

    Example: agv node info /wheel_kinematics
    """
    full = absolute(node_name)
    with joined(spin_time, use_sim_time=use_sim_time, whole=True) as node:
        there = node_names(node, hidden=include_hidden)
        if full not in there:
            msg = f"Unable to find node '{node_name}'{meant(full, there)}"
            raise ConfigurationError(msg)
        if there.count(full) > 1:
            typer.echo(
                f'There are {there.count(full)} nodes in the graph with the exact name '
                f'"{full}". You are seeing information about only one of them.',
                err=True,
            )
        typer.echo(full)
        for title, names in _of(node, full).items():
            typer.echo(f'  {title}:')
            shown = [one for one in names if include_hidden or not _hidden(one[0])]
            for name, types in shown:
                typer.echo(f'    {name}: {", ".join(types)}')
            if not shown:
                typer.echo()  # as ros2 does


def _of(node: Any, full: str) -> dict[str, list[tuple[str, list[str]]]]:
    """Return names and types of what a node has opened, by their title."""
    from rclpy import action

    space, _, name = full.rpartition('/')
    whose = name, space or '/'
    return {
        'Subscribers': node.get_subscriber_names_and_types_by_node(*whose),
        'Publishers': node.get_publisher_names_and_types_by_node(*whose),
        'Service Servers': node.get_service_names_and_types_by_node(*whose),
        'Service Clients': node.get_client_names_and_types_by_node(*whose),
        'Action Servers': action.get_action_server_names_and_types_by_node(node, *whose),
        'Action Clients': action.get_action_client_names_and_types_by_node(node, *whose),
    }


def _hidden(name: str) -> bool:
    return any(part.startswith('_') for part in name.split('/'))
