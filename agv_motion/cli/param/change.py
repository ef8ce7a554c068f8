"""`agv param set`, `dump` and `load`: one parameter, and all of a node by a file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from agv_motion.cli.graph.discovery import DISCOVERY
from agv_motion.cli.graph.nodes import joined_to
from agv_motion.cli.graph.options import HiddenNodes, NoDaemon, Node, SimTime, SpinTime, Timeout
from agv_motion.cli.lazy_group import HELP

set_app = typer.Typer()


@set_app.command(context_settings=HELP | {'ignore_unknown_options': True})  # a value may be -1.0
def set_(
    node_name: Node,
    parameter_name: Annotated[str, typer.Argument(help='Name of the parameter.')],
    value: Annotated[str, typer.Argument(help='As in YAML: true, 1, 1.0, text, [1.0, 2.0].')],
    *,
    include_hidden_nodes: HiddenNodes = False,
    timeout: Timeout = 1.0,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,  # noqa: ARG001 - taken as ros2 does, without effect
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """Set a parameter; as of ros2 the exit status is 0 where the node refuses it with a reason.

    Example: agv param set /wheel_kinematics steering_rate 0.2
    """
    from agv_motion.ros.parameter_texts import from_text
    from agv_motion.ros.remote_parameters import RemoteParameters

    looked = max(timeout, spin_time)
    with joined_to(node_name, looked, hidden=include_hidden_nodes) as (node, full):
        (result,) = RemoteParameters(node, full).set({parameter_name: from_text(value)})
        words = 'Set parameter successful', 'Setting parameter failed'
        _tell(result, *words)


def dump(
    node_name: Node,
    *,
    include_hidden_nodes: HiddenNodes = False,
    timeout: Timeout = 1.0,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,  # noqa: ARG001
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """Print all parameters of a node as a file for `--params-file` and `agv param load`.

    Example: agv param dump /wheel_kinematics > wheels.yaml
    """
    from agv_motion.ros.parameter_texts import dump as as_file
    from agv_motion.ros.remote_parameters import RemoteParameters

    looked = max(timeout, spin_time)
    with joined_to(node_name, looked, hidden=include_hidden_nodes) as (node, full):
        remote = RemoteParameters(node, full)
        names = remote.names()
        typer.echo(as_file(full, dict(zip(names, remote.values(names), strict=True))))


def load(
    node_name: Node,
    parameter_file: Annotated[Path, typer.Argument(help='Parameter file.')],
    *,
    include_hidden_nodes: HiddenNodes = False,
    no_use_wildcard: Annotated[
        bool, typer.Option('--no-use-wildcard', help='Leave out what is for all nodes (/**).')
    ] = False,
    timeout: Timeout = 1.0,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,  # noqa: ARG001
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """Set the parameters of a node from a file; of each is told whether the node took it.

    Example: agv param load /wheel_kinematics wheels.yaml
    """
    from agv_motion.ros.parameter_texts import load as from_file
    from agv_motion.ros.remote_parameters import RemoteParameters

    looked = max(timeout, spin_time)
    with joined_to(node_name, looked, hidden=include_hidden_nodes) as (node, full):
        values = from_file(parameter_file, full, wildcard=not no_use_wildcard)
        results = RemoteParameters(node, full).set(values)
        for name, result in zip(values, results, strict=True):
            _tell(result, f'Set parameter {name} successful', f'Set parameter {name} failed')


def _tell(result: Any, successful: str, failed: str) -> None:
    reason = f': {result.reason}' if result.reason else ''
    typer.echo((successful if result.successful else failed) + reason, err=not result.successful)
