"""`WS /foxglove`: who may come in, by which name of the protocol, and how much it may say.

Foxglove and Lichtblick send no cookie to another site and let a person give an address only. So a
token may stand in the address (``?token=...``), or, for clients of one's own, among the offered
subprotocols (``agv.token.TOKEN``), which nobody logs. Such a token is good for this endpoint alone,
for some hours; `agv dashboard user token` makes it. The address is not logged here, but a tool
may keep it: that is why it opens nothing else.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Protocol

from starlette.websockets import WebSocketDisconnect

from agv_motion.dashboard.foxglove.permissions import Permissions
from agv_motion.dashboard.foxglove.protocol import SUBPROTOCOLS
from agv_motion.dashboard.server.foxglove.client import FoxgloveClient
from agv_motion.dashboard.server.foxglove.wire import wire_of
from agv_motion.dashboard.server.rates import RateLimit
from agv_motion.dashboard.server.roles import Role

if TYPE_CHECKING:
    from starlette.websockets import WebSocket

    from agv_motion.dashboard.server.roles import Visitor
    from agv_motion.dashboard.server.site import Site

TOKEN = 'agv.token.'  # noqa: S105 - what precedes one
MOST_CLIENTS = 40
"""of the endpoint"""
MOST_OF_ONE = 20
"""of them from one address"""
BURST, RATE = 1000, 100.0
"""messages that a client may send at once, and a second in the long run: a tool subscribes to each
topic by a message of its own"""
PIECE = 2048
"""[characters] of a message that count as one more: a long list takes long to read"""


class EndpointRoom(Protocol):
    """Who serves a client that was let in."""

    def welcome(self, client: FoxgloveClient, subprotocol: str) -> None:
        """Tell a new client what there is."""

    def hear(self, client: FoxgloveClient, message: str | bytes) -> None:
        """Do what it asks."""

    def leave(self, client: FoxgloveClient) -> None:
        """Serve it no more."""

    async def run(self) -> None:
        """Serve until cancelled."""


class FoxgloveDoor:
    """Lets clients in."""

    def __init__(self, site: Site, room: EndpointRoom, *, acts: bool) -> None:
        """Open a room.

        Args:
            site: Knows who may do what.
            room: Serves clients.
            acts: Whether operators and experts may act here.

        """
        self._site, self._room, self._acts = site, room, acts
        self._addresses: dict[FoxgloveClient, str] = {}

    async def open(self, socket: WebSocket) -> None:
        """Let a client in, and hear it until it leaves."""
        subprotocol = next((one for one in SUBPROTOCOLS if one in socket.scope['subprotocols']), '')
        visitor = self._visitor(socket)
        if not subprotocol or visitor.role < Role.VIEWER:
            await socket.close(1008, 'log in, and speak ' + ' or '.join(SUBPROTOCOLS))
            return
        address = '' if socket.client is None else socket.client.host
        here = sum(one == address for one in self._addresses.values())
        if len(self._addresses) >= MOST_CLIENTS or here >= MOST_OF_ONE:
            await socket.close(1013, 'too many look at once')
            return
        await socket.accept(subprotocol)
        client = FoxgloveClient(
            wire_of(socket), self._permissions(visitor), visitor.name,
            lambda: self._visitor(socket) == visitor,
        )  # fmt: skip
        self._addresses[client] = address
        try:
            self._room.welcome(client, subprotocol)
            await self._listen(socket, client)
        finally:
            del self._addresses[client]
            self._room.leave(client)

    def _visitor(self, socket: WebSocket) -> Visitor:
        """Return who comes: by session or place, or else by a token for this endpoint."""
        access = self._site.access
        visitor = access.visitor(socket)
        if visitor.role is not Role.PUBLIC or access.users is None:
            return visitor
        offered = (one for one in socket.scope['subprotocols'] if one.startswith(TOKEN))
        token = next(offered, '').removeprefix(TOKEN) or socket.query_params.get('token', '')
        return access.users.bearer(token) or visitor

    def _permissions(self, visitor: Visitor) -> Permissions:
        return Permissions(
            acts=self._acts and visitor.role >= Role.OPERATOR,
            changes=self._acts and visitor.role >= Role.EXPERT,
        )

    async def _listen(self, socket: WebSocket, client: FoxgloveClient) -> None:
        """Hear a client until it leaves; one that floods is sent away."""
        rate = RateLimit(BURST, RATE, time.monotonic)
        try:
            while True:
                message = await socket.receive()
                if message['type'] == 'websocket.disconnect':
                    return
                text = message.get('text')
                said: str | bytes = text if text is not None else message.get('bytes') or b''
                if not rate.allows('', 1.0 + len(said) / PIECE):
                    break
                self._room.hear(client, said)
            client.refuse(f'more than {RATE:g} messages of {PIECE} characters a second')
            await socket.close(1008, 'too many messages')
        except (WebSocketDisconnect, RuntimeError):
            return
