"""`agv dashboard`: the operator's page."""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
from typing import Annotated, Any

import typer

from agv_motion.cli.lazy_group import lazy_group
from agv_motion.ros.stop import end_at_once

_Commands = lazy_group({'user': 'dashboard.user:app', 'bag': 'dashboard.bag:bag'})


class _Group(_Commands):  # type: ignore[misc, valid-type] # made by a function
    """Takes what is no command for the bag that is to be shown."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        if args and args[0] not in self.list_commands(ctx):
            args = ['bag', *args]
        return super().resolve_command(ctx, args)


app = typer.Typer(cls=_Group)


@app.callback(invoke_without_command=True)
def dashboard(
    context: typer.Context,
    *,
    host: Annotated[str, typer.Option(help='Address on which the page is served.')] = '127.0.0.1',
    port: Annotated[int, typer.Option(min=0, max=65535, help='Of the page; 0: any.')] = 8080,
    robots: Annotated[str, typer.Option(help='Names of those shown, by commas; all.')] = '',
    name: Annotated[str, typer.Option(help='By which browsers know this host, by commas.')] = '',
    certificate: Annotated[str, typer.Option(help='File of a certificate (PEM), for TLS.')] = '',
    key: Annotated[str, typer.Option(help='File of its key.')] = '',
    state_folder: Annotated[str, typer.Option(help='Where users and marks are kept.')] = '',
    recording: Annotated[
        str, typer.Option('--bag', help='Being recorded, to look back into.')
    ] = '',
    origin: Annotated[
        str, typer.Option(help='Sites whose tools may open /foxglove, by commas.')
    ] = '',
    foxglove_acts: Annotated[
        bool, typer.Option('--foxglove-acts', help='Operators and experts may act there, too.')
    ] = False,
    end_with_stdin: Annotated[bool, typer.Option(hidden=True)] = False,
    next_free_port: Annotated[
        bool, typer.Option('--next-free-port', help='Take the next port where this is taken.')
    ] = False,
) -> None:
    """Serve the operator's page: see, understand, stop and steer the robots from a browser.

    For example:

    agv dashboard

    agv dashboard --port 8081 --robots oak,ash

    agv dashboard walk_of_monday        # a bag, without ROS

    agv dashboard user add anna --role operator

    agv dashboard --host 0.0.0.0 --certificate page.pem --key page.key
    """
    if context.invoked_subcommand:
        return
    if end_with_stdin:
        threading.Thread(target=_end_with_stdin, daemon=True).start()
    end_at_once()  # until the node's `run` takes over
    given: dict[str, object] = {
        'port': port, 'next_free_port': str(next_free_port).lower(),
        'foxglove_acts': str(foxglove_acts).lower(),
    }  # fmt: skip
    texts = {
        'host': host, 'certificate': certificate, 'key': key, 'state_folder': state_folder,
        'bag': recording,
    }  # fmt: skip
    given |= {option: json.dumps(value) for option, value in texts.items() if value}
    run_node(given | listed({'robots': robots, 'names': name, 'foxglove_origins': origin}))


def listed(texts: dict[str, str]) -> dict[str, object]:
    """Return lists that were given by commas, as parameters; without those that are empty."""
    split = {
        option: [one.strip() for one in value.split(',') if one.strip()]
        for option, value in texts.items()
    }
    return {option: json.dumps(values) for option, values in split.items() if values}


def run_node(given: dict[str, object]) -> None:
    """Be the node, with these parameters."""
    from agv_motion.nodes.dashboard import main

    words = (word for option, value in given.items() for word in ('-p', f'{option}:={value}'))
    sys.argv = ['dashboard', '--ros-args', *words]
    main()


def _end_with_stdin() -> None:
    """End this process when whoever started it closes the pipe, or is gone."""
    while os.read(0, 4096):
        pass
    os.kill(os.getpid(), signal.SIGTERM)
