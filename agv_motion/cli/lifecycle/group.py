"""`agv lifecycle`: the words, options and output of `ros2 lifecycle`, for a machine without it."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from agv_motion.cli.graph.completion import names_of_nodes
from agv_motion.cli.graph.discovery import DISCOVERY
from agv_motion.cli.graph.nodes import joined_to, lifecycle_nodes
from agv_motion.cli.graph.options import HiddenNodes, NoDaemon, Node, SimTime, SpinTime
from agv_motion.cli.graph.session import joined
from agv_motion.errors import ConfigurationError
from agv_motion.ros.suggestion import meant

app = typer.Typer(
    no_args_is_help=True,
    help='States of nodes with a lifecycle, with the words and the output of `ros2 lifecycle`.',
)


@app.command()
def nodes(
    *,
    all_: Annotated[bool, typer.Option('-a', '--all', help='Hidden ones as well.')] = False,
    count_nodes: Annotated[bool, typer.Option('-c', '--count-nodes', help='Count.')] = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
    no_daemon: NoDaemon = False,  # noqa: ARG001 - taken as ros2 does, without effect
) -> None:
    """List the nodes that have a lifecycle."""
    with joined(spin_time, use_sim_time=use_sim_time, whole=True) as node:
        found = lifecycle_nodes(node, hidden=all_)
        for line in [len(found)] if count_nodes else found:
            typer.echo(line)


@app.command()
def get(
    node_name: Annotated[
        str, typer.Argument(help='Of one node; without: of all.', autocompletion=names_of_nodes)
    ] = '',
    *,
    include_hidden_nodes: HiddenNodes = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """Tell the state of a node, or of all.

    Example: agv lifecycle get /wheel_kinematics
    """
    from agv_motion.ros.remote_lifecycle import states

    hidden = include_hidden_nodes
    if node_name:
        with joined_to(node_name, spin_time, hidden=hidden, lifecycle=True) as (node, full):
            state = states(node, [full])[full]
            if isinstance(state, Exception):
                raise state
            typer.echo(f'{state.label} [{state.id}]')
        return
    with joined(spin_time, use_sim_time=use_sim_time, whole=True) as node:
        for full, state in states(node, lifecycle_nodes(node, hidden=hidden)).items():
            wrong = isinstance(state, Exception)
            typer.echo(f'{full}: {state}' if wrong else f'{full}: {state.label} [{state.id}]',
                       err=wrong)  # fmt: skip


@app.command(name='list')
def list_(
    node_name: Node,
    *,
    include_hidden_nodes: HiddenNodes = False,
    all_: Annotated[bool, typer.Option('-a', '--all', help='From every state.')] = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,  # noqa: ARG001
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """List the transitions that start from the state of a node.

    Example: agv lifecycle list /wheel_kinematics
    """
    from agv_motion.ros.remote_lifecycle import transitions

    hidden = include_hidden_nodes
    with joined_to(node_name, spin_time, hidden=hidden, lifecycle=True) as (node, full):
        for one in transitions(node, full, every=all_):
            typer.echo(
                f'- {one.transition.label} [{one.transition.id}]\n'
                f'\tStart: {one.start_state.label}\n\tGoal: {one.goal_state.label}'
            )


@app.command(name='set')
def set_(
    node_name: Node,
    transition: Annotated[str, typer.Argument(help='Name or number, such as deactivate.')],
    *,
    include_hidden_nodes: HiddenNodes = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,  # noqa: ARG001
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """Let a node change its state; as of ros2 the exit status is 0 where the change fails.

    Example: agv lifecycle set /wheel_kinematics deactivate
    """
    from agv_motion.ros.remote_lifecycle import change, transitions

    hidden = include_hidden_nodes
    with joined_to(node_name, spin_time, hidden=hidden, lifecycle=True) as (node, full):
        there = [one.transition for one in transitions(node, full)]
        successful = change(node, full, _chosen(transition, there))
        word = 'successful' if successful else 'failed'
        typer.echo(f'Transitioning {word}', err=not successful)


def _chosen(wanted: str, there: list[Any]) -> Any:
    """Return the transition of this name, or of this number."""
    for one in there:
        if one.label == wanted:
            return one
    for one in there:
        if str(one.id) == wanted:
            return one
    listed = ''.join(f'\n- {one.label} [{one.id}]' for one in there)
    close = meant(wanted, [one.label for one in there]).removeprefix('; ')
    msg = f'Unknown transition requested, available ones are:{listed}' + (close and f'\n{close}')
    raise ConfigurationError(msg)
