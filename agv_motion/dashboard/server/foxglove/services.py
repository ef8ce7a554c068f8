"""Services of a graph, as clients of the endpoint are told of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.dashboard.foxglove import protocol
from agv_motion.dashboard.foxglove.protocol import CDR, ServiceInfo
from agv_motion.errors import AgvMotionError, ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from agv_motion.dashboard.foxglove.requests import Call
    from agv_motion.dashboard.foxglove.source import GraphSource
    from agv_motion.dashboard.server.foxglove.client import FoxgloveClient


class Services:
    """Those that are there, by number; the same service always has the same number."""

    def __init__(self, source: GraphSource) -> None:
        """Know none."""
        self._source = source
        self._known: dict[tuple[str, str], ServiceInfo | None] = {}
        """by name and type; None: its type is not installed here"""
        self._there: dict[int, ServiceInfo] = {}

    def seen_by(self, client: FoxgloveClient) -> list[ServiceInfo]:
        """Return what a client may call."""
        return [one for one in self._there.values() if client.permissions.sees_service(one.name)]

    def update(self, services: Mapping[str, str], clients: Iterable[FoxgloveClient]) -> None:
        """Take which there are now, and tell clients what has changed for them."""
        before, self._there = self._there, {}
        for name, kind in services.items():
            info = self._info(name, kind)
            if info is not None:
                self._there[info.id] = info
        for client in clients:
            sees = client.permissions.sees_service
            gone = [n for n, one in before.items() if n not in self._there and sees(one.name)]
            new = [o for n, o in self._there.items() if n not in before and sees(o.name)]
            if gone:
                client.send(protocol.unadvertise_services(gone))
            if new:
                client.send(protocol.advertise_services(new))

    async def call(self, client: FoxgloveClient, request: Call) -> None:
        """Call a service for a client, and send it the response, or why there is none."""
        info = self._there.get(request.service)
        if info is None or not client.permissions.sees_service(info.name):
            why = f'there is no service {request.service} that may be called here'
        elif request.encoding != CDR:
            why = f"encoding '{request.encoding}': only {CDR} is taken"
        else:
            why = await self._called(client, request, info)
        if why:
            client.send(protocol.service_failure(request.service, request.id, why))

    async def _called(self, client: FoxgloveClient, request: Call, info: ServiceInfo) -> str:
        """Return why a call has failed; empty if it has not."""
        try:
            response = await self._source.call(info.name, info.type, request.data)
        except AgvMotionError as error:
            return str(error)
        client.send(protocol.service_response(info.id, request.id, CDR, response))
        return ''

    def _info(self, name: str, kind: str) -> ServiceInfo | None:
        key = name, kind
        if key not in self._known:
            try:
                sides = self._source.service_definitions(kind)
            except ConfigurationError:
                self._known[key] = None
            else:
                self._known[key] = ServiceInfo(len(self._known) + 1, name, kind, *sides)
        return self._known[key]
