"""`agv nodes` and `agv run`: which nodes there are, and starting one."""

from __future__ import annotations

import importlib
import sys
from typing import Annotated, Any

import typer

from agv_motion.cli.graph.completion import one_of
from agv_motion.cli.graph.discovery import DISCOVERY
from agv_motion.cli.graph.options import SpinTime
from agv_motion.cli.graph.session import joined, spin
from agv_motion.cli.lazy_group import HELP
from agv_motion.nodes.catalogue import available, require_node
from agv_motion.ros.stop import end_at_once

app = typer.Typer(help='Which nodes are on the graph, and in which state.')
run_app = typer.Typer()

ANSWER_TIME = 1.0
"""[s] How long a node may take to tell its state."""


@app.callback(invoke_without_command=True)
def nodes(
    spin_time: SpinTime = DISCOVERY,
) -> None:
    """List the nodes of the graph; of lifecycle nodes, the state too."""
    with joined(spin_time, whole=True) as node:
        found = sorted(
            f'{namespace.rstrip("/")}/{name}'
            for name, namespace in node.get_node_names_and_namespaces()
            if not name.startswith('_')
        )
        states = _states(node, found)
        for name in found:
            typer.echo(f'{name} [{states[name]}]' if name in states else name)


def _states(node: Any, names: list[str]) -> dict[str, str]:
    """Ask every lifecycle node for its state, all at once."""
    import time

    from lifecycle_msgs.srv import GetState

    services = {name for name, _ in node.get_service_names_and_types()}
    lifecycle = [name for name in names if f'{name}/get_state' in services]
    clients = {name: node.create_client(GetState, f'{name}/get_state') for name in lifecycle}
    end = time.monotonic() + ANSWER_TIME
    spin(
        node,
        lambda: all(c.service_is_ready() for c in clients.values()) or time.monotonic() > end,
    )
    futures = {name: client.call_async(GetState.Request()) for name, client in clients.items()}
    spin(node, lambda: all(f.done() for f in futures.values()) or time.monotonic() > end)
    return {
        name: future.result().current_state.label if future.done() else 'no answer'
        for name, future in futures.items()
    }


@run_app.command(context_settings=HELP | {'allow_extra_args': True, 'ignore_unknown_options': True})
def run(
    context: typer.Context,
    node: Annotated[
        str,
        typer.Argument(
            help='Name of the node, such as wheel_kinematics.', autocompletion=one_of(available)
        ),
    ] = '',
) -> None:
    """Run a node of this package, as `ros2 run agv_motion NODE` does.

    Without a name, lists them. Example:
    agv run wheel_kinematics --ros-args -p wheel_radius:=0.2 -r cmd_vel:=/other
    """
    if not node:
        typer.echo('\n'.join(available()))
        return
    require_node(node)
    end_at_once()  # until the node's `run` takes over
    sys.argv = [node, *context.args]
    importlib.import_module(f'agv_motion.nodes.{node}').main()
