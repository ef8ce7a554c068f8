"""`agv dashboard`: the operator's page."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from agv_motion.ros.stop import end_at_once

app = typer.Typer()


@app.callback(invoke_without_command=True)
def dashboard(
    context: typer.Context,
    *,
    host: Annotated[str, typer.Option(help='Address on which the page is served.')] = '127.0.0.1',
    port: Annotated[int, typer.Option(min=0, max=65535, help='Of the page; 0: any.')] = 8080,
    robots: Annotated[str, typer.Option(help='Names of those shown, by commas; all.')] = '',
    next_free_port: Annotated[
        bool, typer.Option('--next-free-port', help='Take the next port where this is taken.')
    ] = False,
) -> None:
    """Serve the operator's page: see, understand, stop and steer the robots from a browser.

    For example:

    agv dashboard

    agv dashboard --port 8081 --robots oak,ash
    """
    if context.invoked_subcommand:
        return
    end_at_once()  # until the node's `run` takes over
    from agv_motion.nodes.dashboard import main

    given = {'host': f"'{host}'", 'port': port, 'next_free_port': str(next_free_port).lower()}
    names = [name.strip() for name in robots.split(',') if name.strip()]
    if names:
        given['robots'] = str(names)
    words = (word for name, value in given.items() for word in ('-p', f'{name}:={value}'))
    sys.argv = ['dashboard', '--ros-args', *words]
    main()
