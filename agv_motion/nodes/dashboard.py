"""Node `dashboard`: the operator's page, and between it and the robots the newest only."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from agv_motion.dashboard.core.board import Board
from agv_motion.errors import ConfigurationError
from agv_motion.nodes.foxglove_graph import FoxgloveGraph
from agv_motion.nodes.live_fleet import LiveFleet
from agv_motion.parameters import Spec, check
from agv_motion.ros.diagnosis import OK, Diagnosis
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.run import run

if TYPE_CHECKING:
    from agv_motion.dashboard.server.serve import WebServer
    from agv_motion.dashboard.server.site import Site
    from agv_motion.ros.live_port import LivePort

LOOK_PERIOD = 1.0
"""[s] between two looks at the graph, and for what has come while nobody looks at the page"""
ACT_PERIOD = 0.06
"""[s] within which an act of a person goes out: half of that between two frames of the page"""
TAKE_EVERY = 2
"""periods of these after which is taken what has come, while somebody looks at the page"""


@dataclass(frozen=True)
class DashboardParameters:
    """Where the page is, and whom it shows."""

    host: Annotated[
        str,
        Spec(
            'address on which the page is served; beyond this machine it needs '
            'users: agv dashboard user add NAME'
        ),
    ] = '127.0.0.1'
    port: Annotated[int, Spec('of the page; 0: any that is free', '', (0, 65535))] = 8080
    next_free_port: Annotated[bool, Spec('take the next port where this one is taken')] = False
    names: Annotated[
        tuple[str, ...],
        Spec('by which browsers may know this host, beside its addresses and localhost'),
    ] = ()
    certificate: Annotated[str, Spec('file of a certificate (PEM), for TLS; empty: none')] = ''
    key: Annotated[str, Spec('file of its key')] = ''
    state_folder: Annotated[
        str, Spec('where users, marks and saved parameters are kept; empty: of the user, by XDG')
    ] = ''
    bag: Annotated[
        str, Spec('folder of the bag that is being recorded, to look back into; empty: none')
    ] = ''
    page: Annotated[
        bool, Spec("serve the operator's page; without it there is the endpoint for tools alone")
    ] = True
    foxglove: Annotated[
        bool, Spec('serve /foxglove to Foxglove, Lichtblick and other tools: to look')
    ] = True
    foxglove_acts: Annotated[
        bool,
        Spec('let operators publish and call services there, and experts set parameters, too'),
    ] = False
    foxglove_origins: Annotated[
        tuple[str, ...],
        Spec('sites whose pages may open it, such as https://app.foxglove.dev; empty: none'),
    ] = ()
    robots: Annotated[tuple[str, ...], Spec('names of those that are shown; empty: all')] = ()

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class Dashboard(PlainNode[DashboardParameters]):
    """Serves the page while active; when it stops it sends nothing, and the dead-man acts."""

    name = 'dashboard'
    takes = DashboardParameters

    port: LivePort

    def __init__(self, port: LivePort, parameters: DashboardParameters) -> None:
        """Look at the graph; the page comes with `begin`."""
        super().__init__(port, parameters)
        self.board = Board()
        self.fleet = LiveFleet(port, self.board, parameters.robots)
        self.graph = FoxgloveGraph(port, self.fleet.publisher) if parameters.foxglove else None
        self.site: Site | None = None
        self.server: WebServer | None = None
        self._taken_at = 0.0
        self._turn = 0
        port.every(ACT_PERIOD, self._go_on, steady=True)
        port.every(LOOK_PERIOD, self.fleet.look, steady=True)

    def begin(self) -> None:
        """Serve the page.

        Raises:
            ConfigurationError: Where it should be served is taken, or the extra is not installed.

        """
        try:
            from agv_motion.dashboard.server.app import Foxglove, application
            from agv_motion.dashboard.server.foxglove.live import LiveRoom
            from agv_motion.dashboard.server.opening import opened
            from agv_motion.dashboard.server.serve import WebServer, listening
        except ModuleNotFoundError as error:
            msg = f'the page needs {error.name}: pip install "agv_motion[dashboard]"'
            raise ConfigurationError(msg) from error
        given = self.parameters
        self.fleet.look()
        self.site = opened(self.fleet, given.host, given.state_folder, given.bag)
        listener = listening(given.host, given.port, next_free=given.next_free_port)
        tools = None
        if self.graph is not None:
            room = LiveRoom(self.site, self.graph)
            acts, origins = given.foxglove_acts, given.foxglove_origins
            tools = Foxglove(room, acts, origins, alone=not given.page)
        page = application(self.site, given.names, foxglove=tools)
        self.server = WebServer(page, listener, given.certificate, given.key)
        self.server.start()
        who = 'users log in' if self.site.access.needs_login else 'for this machine alone'
        what = 'the page' if given.page else 'the endpoint for tools'
        self.port.info(f'{what} is at {self.server.url}, {who}')

    def halt(self) -> None:
        """Close the page."""
        if self.server is not None:
            self.server.close()
            self.server = None
        if self.site is not None:
            self.site.close()
            self.site = None
        self.fleet.close()
        if self.graph is not None:
            self.graph.close()

    def diagnose(self) -> Diagnosis:
        """Tell where the page is, and how many look at it."""
        url = '' if self.server is None else self.server.url
        return Diagnosis(OK, f'serving {url}', {'robots': ', '.join(self.fleet.robots)})

    def _go_on(self) -> None:
        """Do what was asked; take what has come, when it is time to."""
        self.fleet.send()
        if self.graph is not None:
            self.graph.send()
        self._turn = (self._turn + 1) % TAKE_EVERY
        if self._turn:
            return
        now = time.monotonic()
        watched = self.site is not None and self.site.is_watched
        if watched or now - self._taken_at >= LOOK_PERIOD:
            self._taken_at = now
            self.fleet.take()


def main() -> None:
    """Run the node."""
    run(Dashboard)


if __name__ == '__main__':
    main()
