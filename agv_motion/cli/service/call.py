"""`agv service call`: ask a service, and print its answer."""

from __future__ import annotations

import sys
import time
from typing import Annotated, Any

import typer

from agv_motion.cli.graph.completion import service_names
from agv_motion.cli.graph.discovery import DISCOVERY, settle
from agv_motion.cli.graph.session import full_name, interface_class, joined, services, spin
from agv_motion.cli.topic.message_text import fill
from agv_motion.errors import ConfigurationError
from agv_motion.files import yaml_text
from agv_motion.ros.suggestion import meant


def call(
    service_name: Annotated[
        str, typer.Argument(help="Such as '/sequence/start'.", autocompletion=service_names)
    ],
    service_type: Annotated[str, typer.Argument(help="Such as 'std_srvs/srv/Trigger'.")],
    values: Annotated[str, typer.Argument(help="YAML, such as '{data: true}'.")] = '{}',
    *,
    stdin: Annotated[bool, typer.Option('--stdin', help='Read them from standard input.')] = False,
    rate: Annotated[float, typer.Option('-r', '--rate', min=0.0, help='Again, in Hz.')] = 0.0,
    timeout: Annotated[
        float, typer.Option(min=0.0, help='Seconds to wait for the service, and for each answer.')
    ] = 10.0,
) -> None:
    """Call a service.

    Example: agv service call /sequence/start std_srvs/srv/Trigger
    """
    kind = interface_class(service_type, 'srv')
    if not hasattr(kind, 'Request'):
        msg = 'The passed type is not a service'
        raise ConfigurationError(msg)
    request = kind.Request()
    content = yaml_text.plain(sys.stdin.read() if stdin else values, 'the request')
    fill(request, content or {})
    with joined(0.0) as node:
        _await(node, full_name(node, service_name), timeout)
        while True:
            asked = time.monotonic()
            typer.echo(f'requester: making request: {request!r}\n')
            typer.echo(f'response:\n{_answer(node, kind, service_name, request, timeout)!r}\n')
            if not rate:
                return
            spin(node, lambda due=asked + 1.0 / rate: time.monotonic() >= due)  # type: ignore[misc]


def _answer(node: Any, kind: Any, name: str, request: Any, timeout: float) -> Any:
    from agv_motion.ros.remote_services import call as ask

    return ask(node, kind, full_name(node, name), request, timeout)


def _await(node: Any, name: str, timeout: float) -> None:
    """Wait until a service is found; say so, as ros2 does, if it is not there yet."""
    end = time.monotonic() + timeout

    def found() -> bool:
        return name in services(node, hidden=True)

    settle(node, min(DISCOVERY, timeout), found)
    if not found():
        typer.echo('waiting for service to become available...')
        spin(node, lambda: found() or time.monotonic() > end)
    if not found():
        msg = (
            f'no service {name} within {timeout:g} s'
            f'{meant(name, list(services(node, hidden=True)))}'
        )
        raise ConfigurationError(msg)
