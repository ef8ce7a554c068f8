"""The live endpoint: one task looks at the graph and serves all clients, message by message never.

At each look the newest of the topics that somebody has chosen are taken, and each client gets its
part of them in one write. A client that has not taken what it was sent before is left out: it
costs a comparison, and gets the newest when it can take something again.
"""

from __future__ import annotations

import asyncio
import logging
import secrets
import time
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.foxglove import protocol
from agv_motion.dashboard.foxglove.channels import Channels
from agv_motion.dashboard.foxglove.frames import frame
from agv_motion.dashboard.foxglove.protocol import Severity
from agv_motion.dashboard.server.foxglove.client import ALL, Renewal
from agv_motion.dashboard.server.foxglove.services import Services

if TYPE_CHECKING:
    from collections.abc import Mapping

    from agv_motion.dashboard.foxglove.source import GraphSource
    from agv_motion.dashboard.server.foxglove.client import FoxgloveClient

_LOG = logging.getLogger('uvicorn.error')

PERIOD = 0.005
"""[s] between two looks for messages"""
SHORTEST = 0.001
"""[s] that are left for others between two looks, whatever a look has taken"""
AFTER_FAILURE = 1.0
"""[s] without a look after one that has failed: what fails again is told once a second"""
GRAPH_PERIOD = 0.25
"""[s] between two looks for what has come and gone"""


class FoxgloveHub:
    """All clients of a live graph."""

    def __init__(self, source: GraphSource, name: str = 'agv_motion') -> None:
        """Start without a client.

        Args:
            source: The graph.
            name: Of this server, as tools show it.

        """
        self.source, self.name = source, name
        self.channels = Channels()
        self.services = Services(source)
        self.clients: set[FoxgloveClient] = set()
        self._session = secrets.token_hex(8)
        self._someone = asyncio.Event()
        self._seen: dict[str, Any] = {}
        """what the source told last, each by its name: other objects are news"""
        self._time: int | None = None

    def welcome(self, client: FoxgloveClient) -> None:
        """Tell a new client what there is, and serve it from now on."""
        self._look_at_graph()
        client.send(self._server_info(client))
        client.send(protocol.advertise(c.info for c in self.channels.by_number.values()))
        client.send(protocol.advertise_services(self.services.seen_by(client)))
        self._complain(client)
        self.clients.add(client)
        self.want()
        self._time = None
        self._someone.set()

    def leave(self, client: FoxgloveClient) -> None:
        """Serve a client no more."""
        client.close()
        self.clients.discard(client)
        self.want()

    def want(self) -> None:
        """Tell the source what clients want now; what nobody listens to is kept no longer."""
        chosen = {n for client in self.clients for n in client.subscriptions.by_channel}
        for number, channel in self.channels.by_number.items():
            if number not in chosen:
                channel.forget()
        by_number = self.channels.by_number
        self.source.watch(
            frozenset(by_number[n].info.topic for n in chosen if n in by_number),
            clients=bool(self.clients),
            parameters=any(client.watched for client in self.clients),
            connections=any(client.watches_graph for client in self.clients),
        )

    async def run(self) -> None:
        """Look and serve until cancelled; without a client, wait."""
        renewal, graph_at = Renewal(), 0.0
        while True:
            if not self.clients:
                self._someone.clear()
                await self._someone.wait()
            begun = time.monotonic()
            try:
                self._pass_on()
                if begun - graph_at >= GRAPH_PERIOD:
                    graph_at = begun
                    self._look_at_graph()
                    self._tell_changes()
                if renewal.is_due():
                    self._renew()
            except Exception:  # noqa: BLE001 - told; the others must go on
                _LOG.exception('a look at the graph has failed')
                await asyncio.sleep(AFTER_FAILURE)
            await asyncio.sleep(max(PERIOD - (time.monotonic() - begun), SHORTEST))

    def _pass_on(self) -> None:
        """Take what has come, and serve everybody."""
        fresh = self.channels.take(self.source.take())
        told, now = None, self.source.time()
        if now is not None and now != self._time:
            self._time, told = now, protocol.time_data(now)
        if fresh or told:
            framed = None if told is None else frame(told)
            for client in self.clients:
                client.serve(fresh, self.channels.count, framed)
        else:
            for client in self.clients:
                client.catch_up(self.channels.count)

    def _look_at_graph(self) -> None:
        """Take what has come and gone, and tell it."""
        source = self.source
        if self._is_new('topics', source.topics):
            self._update_channels()
        if self._is_new('services', source.services):
            self.services.update(source.services, self.clients)
        if self._is_new('complaints', source.complaints):
            for client in self.clients:
                self._complain(client)
        if self._is_new('simulated', source.simulated):
            for client in self.clients:
                client.send(self._server_info(client))

    def _update_channels(self) -> None:
        new, gone = self.channels.update(self.source.topics)
        for client in self.clients:
            for number in gone:
                client.subscriptions.drop(number)
            if gone:
                client.send(protocol.unadvertise(gone))
            if new:
                client.send(protocol.advertise(channel.info for channel in new))
        if gone:
            self.want()

    def _complain(self, client: FoxgloveClient) -> None:
        for topic, why in self.source.complaints.items():
            client.tell(Severity.WARNING, f'{topic} is not served: {why}', topic)

    def _tell_changes(self) -> None:
        """Tell parameters and connections that have changed, to those who want to know."""
        changed = self.source.changed_parameters()
        for client in self.clients:
            told = _watched(changed, client.watched) if changed else {}
            if told:
                client.send(protocol.parameter_values(told))
            if client.watches_graph:
                now = self.source.connections
                update = protocol.graph_update(now, client.graph)
                if update:
                    client.graph = now
                    client.send(update)

    def _renew(self) -> None:
        for client in list(self.clients):
            if not client.welcome():
                client.tell(Severity.ERROR, 'the session has ended: log in again')
                client.wire.finish()

    def _is_new(self, what: str, told: object) -> bool:
        """Return whether a source tells another object than before."""
        if what in self._seen and self._seen[what] is told:
            return False
        self._seen[what] = told
        return True

    def _server_info(self, client: FoxgloveClient) -> str:
        simulated = self.source.simulated
        capabilities = client.permissions.capabilities(simulated=simulated)
        words = {'role': 'may act' if client.permissions.acts else 'may look'}
        return protocol.server_info(self.name, capabilities, self._session, metadata=words)


def _watched(changed: Mapping[str, Any], names: set[str]) -> dict[str, Any]:
    return {n: value for n, value in changed.items() if n in names or ALL in names}
