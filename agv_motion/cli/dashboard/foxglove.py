"""`agv foxglove`: a live graph, or a recording, for Foxglove, Lichtblick and their like."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.errors import ConfigurationError
from agv_motion.ros.stop import Stop, end_at_once

if TYPE_CHECKING:
    from agv_motion.dashboard.server.foxglove.recorded import RecordedRoom
    from agv_motion.dashboard.server.site import Site

PORT = 8765
"""where these tools look first"""
LOOK = 0.2
"""[s] between two looks whether to end"""


def foxglove(
    recording: Annotated[
        Path | None,
        typer.Argument(metavar='[BAG]', help='Folder of a bag, or one of its files; none: live.'),
    ] = None,
    *,
    host: Annotated[str, typer.Option(help='Address on which it is served.')] = '127.0.0.1',
    port: Annotated[int, typer.Option(min=0, max=65535, help='0: any that is free.')] = PORT,
    origin: Annotated[
        str, typer.Option(help='Sites whose pages may connect, by commas; none.')
    ] = '',
    acts: Annotated[
        bool, typer.Option('--acts', help='Operators and experts may publish, call and set.')
    ] = False,
    rate: Annotated[float, typer.Option(help='Seconds of a bag in a second, at first.')] = 1.0,
    name: Annotated[str, typer.Option(help='By which tools know this host, by commas.')] = '',
    certificate: Annotated[str, typer.Option(help='File of a certificate (PEM), for TLS.')] = '',
    key: Annotated[str, typer.Option(help='File of its key.')] = '',
    state_folder: Annotated[str, typer.Option(help='Where the users are kept.')] = '',
) -> None:
    """Let Foxglove and Lichtblick see the robots of this ROS graph, or a bag, without ROS.

    In the tool choose "Open connection", "Foxglove WebSocket", and the address that is printed. A
    program on this machine comes in by itself. A tool that runs in a browser has an origin, which
    must be named:

    agv foxglove --origin https://app.foxglove.dev

    agv foxglove --origin http://localhost:3000      # Lichtblick, served by yourself

    agv foxglove walk_of_monday                      # a bag: play, pause, seek, rate

    Each looks at a bag by itself. Foxglove has its own controls for it; elsewhere set the
    parameters /playback.playing, /playback.rate and /playback.seconds.

    To look is all that one may do, unless --acts is given: then an operator may publish what people
    say (cmd_vel/manual, goal_pose), and an expert set parameters. Nothing passes a robot's arbiter.

    From other machines one must log in. Tools cannot: give them a token in the address.

    agv dashboard user token anna --hours 8

    The operator's page (agv dashboard) has the same endpoint, at /foxglove.
    """
    if recording is not None:
        with _recorded(recording, rate, host, state_folder) as (site, room):
            _serve(site, room, (host, port, certificate, key), (name, origin))
        return
    from agv_motion.cli.dashboard.group import listed, run_node

    end_at_once()  # until the node's `run` takes over
    texts = {'host': host, 'certificate': certificate, 'key': key, 'state_folder': state_folder}
    given: dict[str, object] = {'port': port, 'page': 'false', 'foxglove_acts': str(acts).lower()}
    given |= {option: json.dumps(value) for option, value in texts.items() if value}
    run_node(given | listed({'names': name, 'foxglove_origins': origin}))


@contextmanager
def _recorded(
    recording: Path, rate: float, host: str, state_folder: str
) -> Iterator[tuple[Site, RecordedRoom]]:
    """Open a bag for the endpoint."""
    try:
        from agv_motion.dashboard.server.bag_fleet import BagFleet
        from agv_motion.dashboard.server.foxglove.recorded import RecordedRoom
        from agv_motion.dashboard.server.opening import opened
    except ModuleNotFoundError as error:
        msg = f'this needs {error.name}: pip install "agv_motion[dashboard]"'
        raise ConfigurationError(msg) from error
    room = RecordedRoom(recording, rate)
    site = opened(BagFleet(recording), host, state_folder, str(recording), recorded=True)
    try:
        yield site, room
    finally:
        site.close()


def _serve(
    site: Site, room: RecordedRoom, place: tuple[str, int, str, str], known: tuple[str, str]
) -> None:
    """Serve a bag until the end is asked for.

    Args:
        site: Knows who may look.
        room: Serves.
        place: Host, port, certificate and key.
        known: Names of this host, and origins, each by commas.

    """
    from agv_motion.dashboard.server.app import Foxglove, application
    from agv_motion.dashboard.server.serve import WebServer, listening

    host, port, certificate, key = place
    names, origins = ([one.strip() for one in text.split(',') if one.strip()] for text in known)
    page = application(site, names, foxglove=Foxglove(room, origins=origins, alone=True))
    server = WebServer(page, listening(host, port), certificate, key)
    stop = Stop()
    try:
        server.start()
        address = server.url.replace('http', 'ws', 1)
        typer.echo(f'{room.path} is at {address}; end with Ctrl-C')
        while not stop.requested:
            time.sleep(LOOK)
    finally:
        server.close()
