"""Websockets as uvicorn speaks them, and beside that a wire for many frames at once.

A message through ASGI costs some twenty microseconds: a coroutine, a queue and a write each. Who
has a thousand to send makes the frames itself and hands them over in one piece; and it can ask how
much the other side has not taken yet, which ASGI does not tell.
"""

from __future__ import annotations

import socket
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol

if TYPE_CHECKING:
    from collections.abc import Iterable

    from starlette.websockets import WebSocket

EXTENSION = 'agv_motion.wire'
UNSENT = 128 * 1024
"""[bytes] that the system takes beyond what is on its way: more would only grow old there"""


class Wire:
    """The way to one client."""

    def __init__(self, protocol: WebSocketsSansIOProtocol) -> None:
        """Use the connection of a protocol."""
        self._protocol, self._transport = protocol, protocol.transport
        found = self._transport.get_extra_info('socket')
        if found is not None and hasattr(socket, 'TCP_NOTSENT_LOWAT'):
            with suppress(OSError):
                found.setsockopt(socket.IPPROTO_TCP, socket.TCP_NOTSENT_LOWAT, UNSENT)

    @property
    def is_open(self) -> bool:
        """Whether something can be sent."""
        return not (self._protocol.close_sent or self._transport.is_closing())

    @property
    def waiting(self) -> int:
        """Number of bytes that the other side, or the way to it, has not taken yet."""
        return self._transport.get_write_buffer_size()

    def write(self, frames: Iterable[bytes]) -> None:
        """Send whole frames, given in any pieces, by one call of the system."""
        if self.is_open:
            self._transport.write(b''.join(frames))

    def finish(self) -> None:
        """End the connection when what waits has been taken."""
        self._transport.close()

    def cut(self) -> None:
        """End the connection at once, with whatever waits."""
        self._transport.abort()


class BatchProtocol(WebSocketsSansIOProtocol):
    """One connection."""

    def handle_connect(self, event: Any) -> None:
        """Offer the wire to the application."""
        super().handle_connect(event)
        if not self.handshake_complete:
            self.scope['extensions'][EXTENSION] = {'protocol': self}


def wire_of(connection: WebSocket) -> Wire:
    """Return the wire of a connection that was accepted."""
    return Wire(connection.scope['extensions'][EXTENSION]['protocol'])
