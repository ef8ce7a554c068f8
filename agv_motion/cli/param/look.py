"""`agv param list`, `get` and `describe`: what parameters there are, and what they are."""

from __future__ import annotations

import re
from typing import Annotated, Any

import typer

from agv_motion.cli.graph.completion import names_of_nodes
from agv_motion.cli.graph.discovery import DISCOVERY
from agv_motion.cli.graph.nodes import joined_to, node_names
from agv_motion.cli.graph.options import HiddenNodes, NoDaemon, Node, SimTime, SpinTime, Timeout
from agv_motion.cli.graph.session import joined
from agv_motion.errors import ConfigurationError
from agv_motion.visible import in_line


def list_(
    node_name: Annotated[
        str, typer.Argument(help='Of one node; without: of all.', autocompletion=names_of_nodes)
    ] = '',
    *,
    filter_: Annotated[
        str, typer.Option('--filter', help='Only those that match the regular expression.')
    ] = '',
    include_hidden_nodes: HiddenNodes = False,
    param_prefixes: Annotated[list[str] | None, typer.Option(help='Only those below it.')] = None,
    param_type: Annotated[bool, typer.Option('--param-type', help='The types as well.')] = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,  # noqa: ARG001 - taken as ros2 does, without effect
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """List the parameters of a node, or of all nodes.

    Example: agv param list /wheel_kinematics
    """
    try:
        wanted = re.compile(filter_)
    except re.error as error:
        msg = f"--filter '{filter_}' is no regular expression: {error}"
        raise ConfigurationError(msg) from error
    if node_name:
        with joined_to(node_name, spin_time, hidden=include_hidden_nodes) as (node, full):
            _list(node, full, wanted, param_prefixes or [], types=param_type)
        return
    with joined(spin_time, whole=True) as node:
        for full in dict.fromkeys(node_names(node, hidden=include_hidden_nodes)):
            _list(node, full, wanted, param_prefixes or [], types=param_type, one_of_many=True)


def _list(
    node: Any, full: str, wanted: re.Pattern[str], prefixes: list[str], *,
    types: bool, one_of_many: bool = False,
) -> None:  # fmt: skip
    """Print the names of one node's parameters."""
    from agv_motion.ros.remote_parameters import WORDS, RemoteParameters
    from agv_motion.ros.remote_services import UnansweredError

    remote = RemoteParameters(node, full)
    try:
        names = [name for name in remote.names(prefixes) if wanted.match(name)]
        kinds = [WORDS[one.type] for one in remote.descriptors(names)] if types else []
    except UnansweredError as error:
        if not one_of_many:
            raise
        typer.echo(f'{full}: {error}', err=True)
        return
    if one_of_many and names:
        typer.echo(f'{full}:')
    for i, name in enumerate(names):
        typer.echo(f'  {in_line(name)}' + (f' (type: {kinds[i]})' if types else ''))


def get(
    node_name: Node,
    parameter_name: Annotated[str, typer.Argument(help='Name of the parameter.')],
    *,
    include_hidden_nodes: HiddenNodes = False,
    hide_type: Annotated[bool, typer.Option('--hide-type', help='The value alone.')] = False,
    timeout: Timeout = 1.0,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,  # noqa: ARG001
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """Tell the value of a parameter.

    Example: agv param get /wheel_kinematics wheel_radius
    """
    from agv_motion.ros.parameter_texts import python
    from agv_motion.ros.remote_parameters import WORDS, RemoteParameters

    looked = max(timeout, spin_time)
    with joined_to(node_name, looked, hidden=include_hidden_nodes) as (node, full):
        (value,) = RemoteParameters(node, full).values([parameter_name])
        shown = python(value)
        kind = WORDS[value.type].capitalize().removesuffix(' array')
        plural = 'values are' if isinstance(shown, list) else 'value is'
        if hide_type:
            typer.echo(shown)
        else:
            typer.echo('Parameter not set.' if shown is None else f'{kind} {plural}: {shown}')


def describe(
    node_name: Node,
    parameter_names: Annotated[list[str], typer.Argument(help='Names of the parameters.')],
    *,
    include_hidden_nodes: HiddenNodes = False,
    timeout: Timeout = 1.0,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,  # noqa: ARG001
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """Tell what parameters mean, and what values they may have.

    Example: agv param describe /wheel_kinematics wheel_radius rate
    """
    from agv_motion.ros.remote_parameters import RemoteParameters

    looked = max(timeout, spin_time)
    with joined_to(node_name, looked, hidden=include_hidden_nodes) as (node, full):
        for descriptor in RemoteParameters(node, full).descriptors(parameter_names):
            typer.echo('\n'.join(_described(descriptor)))


def _described(descriptor: Any) -> list[str]:
    """Return the lines that `ros2 param describe` has for a parameter."""
    from agv_motion.ros.remote_parameters import WORDS

    lines = [f'Parameter name: {descriptor.name}', f'  Type: {WORDS[descriptor.type]}']
    if descriptor.description:
        lines.append(f'  Description: {descriptor.description}')
    lines.append('  Constraints:')
    if descriptor.read_only:
        lines.append('    Read only: true')
    for one in [*descriptor.floating_point_range, *descriptor.integer_range][:1]:
        lines += [f'    Min value: {one.from_value}', f'    Max value: {one.to_value}']
        lines += [f'    Step: {one.step}'] if one.step else []
    if descriptor.additional_constraints:
        lines.append(f'    Additional constraints: {descriptor.additional_constraints}')
    return lines
