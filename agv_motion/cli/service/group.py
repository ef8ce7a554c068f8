"""`agv service`: the words, options and output of `ros2 service`, for a machine without it."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from agv_motion.cli.graph.completion import service_names
from agv_motion.cli.graph.discovery import DISCOVERY
from agv_motion.cli.graph.options import HiddenServices, NoDaemon, SimTime, SpinTime
from agv_motion.cli.graph.session import joined, services
from agv_motion.cli.lazy_group import lazy_group
from agv_motion.errors import ConfigurationError
from agv_motion.ros.suggestion import meant

Service = Annotated[
    str,
    typer.Argument(
        help="Name of the service, such as '/sequence/start'.", autocompletion=service_names
    ),
]
Count = Annotated[bool, typer.Option('-c', '--count-services', help='Only their number.')]

app = typer.Typer(
    cls=lazy_group({'call': 'service.call:call'}),
    no_args_is_help=True,
    help='Services of running nodes, with the words and the output of `ros2 service`.',
)


@app.command(name='list')
def list_(
    *,
    show_types: Annotated[bool, typer.Option('-t', '--show-types', help='Show the types.')] = False,
    count_services: Count = False,
    include_hidden_services: HiddenServices = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
    no_daemon: NoDaemon = False,  # noqa: ARG001 - taken as ros2 does, without effect
) -> None:
    """List the services of the graph.

    Example: agv service list -t
    """
    with joined(spin_time, use_sim_time=use_sim_time, whole=True) as node:
        found = services(node, hidden=include_hidden_services)
        if count_services:
            typer.echo(len(found))
            return
        for name, types in found.items():
            typer.echo(f'{name} [{", ".join(types)}]' if show_types else name)


@app.command(name='type')
def type_(
    service_name: Service,
    *,
    include_hidden_services: HiddenServices = False,
    spin_time: SpinTime = DISCOVERY,
) -> None:
    """Tell the type of a service.

    Example: agv service type /sequence/start
    """
    with joined(spin_time) as node:
        for one in _types(node, service_name, hidden=include_hidden_services):
            typer.echo(one)


@app.command()
def info(
    service_name: Service,
    *,
    include_hidden_services: HiddenServices = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """Tell the type of a service, and how many offer and use it.

    Example: agv service info /sequence/start
    """
    with joined(spin_time, use_sim_time=use_sim_time, whole=True) as node:
        types = _types(node, service_name, hidden=include_hidden_services)
        typer.echo(f'Type: {types[0] if len(types) == 1 else types}')
        typer.echo(f'Clients count: {node.count_clients(service_name)}')
        typer.echo(f'Services count: {node.count_services(service_name)}')


@app.command()
def find(
    service_type: Annotated[str, typer.Argument(help="Such as 'std_srvs/srv/Trigger'.")],
    *,
    count_services: Count = False,
    include_hidden_services: HiddenServices = False,
    spin_time: SpinTime = DISCOVERY,
) -> None:
    """List the services of a type.

    Example: agv service find std_srvs/srv/Trigger
    """
    with joined(spin_time, whole=True) as node:
        found = services(node, hidden=include_hidden_services).items()
        names = [name for name, types in found if service_type in types]
        for line in [len(names)] if count_services else names:
            typer.echo(line)


def _types(node: Any, name: str, *, hidden: bool) -> list[str]:
    """Return the types of a service that must be there."""
    found = services(node, hidden=hidden)
    if name not in found:
        msg = f"Unknown service '{name}'{meant(name, list(found))}"
        raise ConfigurationError(msg)
    return found[name]
