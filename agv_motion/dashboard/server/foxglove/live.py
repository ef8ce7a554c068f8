"""The endpoint over a live graph, put together."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.dashboard.server.foxglove.desk import FoxgloveDesk
from agv_motion.dashboard.server.foxglove.hub import FoxgloveHub
from agv_motion.dashboard.server.foxglove.parameters import FoxgloveParameters

if TYPE_CHECKING:
    from agv_motion.dashboard.foxglove.source import GraphSource
    from agv_motion.dashboard.server.foxglove.client import FoxgloveClient
    from agv_motion.dashboard.server.site import Site


class LiveRoom:
    """Implements `EndpointRoom` for a graph."""

    def __init__(self, site: Site, source: GraphSource) -> None:
        """Serve the graph of a source, to those whom a site knows."""
        self.hub = FoxgloveHub(source)
        self._desk = FoxgloveDesk(site, self.hub, FoxgloveParameters(site.fleet))

    def welcome(self, client: FoxgloveClient, subprotocol: str) -> None:
        """Tell a new client what there is."""
        del subprotocol
        self.hub.welcome(client)

    def hear(self, client: FoxgloveClient, message: str | bytes) -> None:
        """Do what it asks."""
        self._desk.hear(client, message)

    def leave(self, client: FoxgloveClient) -> None:
        """Serve it no more."""
        self.hub.leave(client)

    async def run(self) -> None:
        """Serve until cancelled."""
        await self.hub.run()
