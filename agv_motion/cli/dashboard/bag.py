"""`agv dashboard BAG`: the page over a recording; nothing can be done in it but to look."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Annotated

import typer

from agv_motion.ros.stop import Stop

LOOK = 0.2
"""[s] between two looks whether to end"""


def bag(
    recording: Annotated[
        Path, typer.Argument(metavar='BAG', help='Folder of the bag, or one of its files.')
    ],
    *,
    host: Annotated[str, typer.Option(help='Address on which the page is served.')] = '127.0.0.1',
    port: Annotated[int, typer.Option(min=0, max=65535, help='Of the page; 0: any.')] = 8080,
    state_folder: Annotated[str, typer.Option(help='Where users and marks are kept.')] = '',
) -> None:
    """Show a recording on the operator's page, without ROS."""
    from agv_motion.dashboard.server.app import application
    from agv_motion.dashboard.server.bag_fleet import BagFleet
    from agv_motion.dashboard.server.opening import opened
    from agv_motion.dashboard.server.serve import WebServer, listening

    fleet = BagFleet(recording)
    site = opened(fleet, host, state_folder, str(recording), recorded=True)
    server = WebServer(application(site), listening(host, port))
    stop = Stop()
    try:
        server.start()
        typer.echo(f'{recording} is at {server.url}; end with Ctrl-C')
        while not stop.requested:
            time.sleep(LOOK)
    finally:
        server.close()
        site.close()
