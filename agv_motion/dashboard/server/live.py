"""`WS /live`: the newest of each slot to each client, never a queue.

One task looks at the board, eight times a second and only while somebody is there. Each
client has a task of its own, which sends what is newer than what this client has, and then waits
until the client acknowledges it: who is slow skips what is old, and costs the others nothing.
"""

from __future__ import annotations

import asyncio
import json
import logging
import time
from typing import TYPE_CHECKING, Any

from starlette.websockets import WebSocketDisconnect

from agv_motion.dashboard.core.board import as_json

if TYPE_CHECKING:
    from collections.abc import Callable

    from starlette.websockets import WebSocket

    from agv_motion.dashboard.core.board import Board

_LOG = logging.getLogger('uvicorn.error')

PERIOD = 0.12
"""[s] between two frames"""
PATIENCE = 1.0
"""[s] after which a frame goes out though the last one was not acknowledged"""
MOST_WANTED = 40
"""slots that a client may ask for"""
RENEWAL = 2.0
"""[s] after which it is looked whether a client is still welcome"""
MOST_SAID = 60
"""messages that a client may send in `RENEWAL`: it acknowledges eight frames a second"""
MOST_OUTCOMES = 100
"""of acts that a client has not been told yet"""

PUBLIC = frozenset({
    'summary', 'platform', 'pose', 'trail', 'turrets', 'wheels', 'twist', 'goal', 'path',
    'sap_flow', 'day', 'drank', 'sun', 'zone', 'clock', 'memory/sap_flow', 'memory/last_visit',
})  # fmt: skip
"""slots for everyone; all others are for those who have logged in"""


class Client:
    """One browser that looks."""

    def __init__(
        self, *, public: bool, address: str = '', welcome: Callable[[], bool] = lambda: True
    ) -> None:
        """Start with nothing sent.

        Args:
            public: Whether it sees the slots for everyone only.
            address: From where it looks.
            welcome: Returns whether it may still see what it sees: its session may have ended.

        """
        self.public, self.address, self.welcome = public, address, welcome
        self.wanted: set[tuple[str, str]] = set()
        self.sent: dict[tuple[str, str], int] = {}
        """version of each cell that it has"""
        self.outcomes: list[str] = []
        """of acts, to be told with the next frame"""
        self.number = self.acknowledged = 0
        self.news = asyncio.Event()
        self.said = 0
        """messages since it was last looked whether it is welcome"""
        self._sent_at = -PATIENCE
        self._renewed_at = time.monotonic()

    async def listen(self, socket: WebSocket) -> None:
        """Take what the client says until it leaves; one that floods is sent away."""
        try:
            while self.said < MOST_SAID:
                self.hear(await socket.receive_text())
            await socket.close(1008, 'too many messages')
        except (WebSocketDisconnect, RuntimeError, KeyError):
            return  # it left, or sent what is no text

    def is_due(self) -> bool:
        """Return whether a frame may go out: the last was acknowledged, or is old."""
        return self.acknowledged >= self.number or time.monotonic() - self._sent_at >= PATIENCE

    def renew(self) -> bool:
        """Look now and then whether the client is still welcome."""
        now = time.monotonic()
        if now - self._renewed_at < RENEWAL:
            return True
        self._renewed_at, self.said = now, 0
        return self.welcome()

    def hear(self, text: str) -> None:
        """Take what the client says: an acknowledgement, or what it wants; all else is let be."""
        self.said += 1
        try:
            told = json.loads(text)
        except (ValueError, RecursionError):
            return
        if not isinstance(told, dict):
            return
        acknowledged = told.get('ack')
        if isinstance(acknowledged, int) and self.acknowledged < acknowledged <= self.number:
            self.acknowledged = acknowledged
            self.news.set()
        wanted = told.get('want')
        if isinstance(wanted, list):
            self.wanted = {
                (robot, slot)
                for robot, _, slot in (
                    str(one).partition('/') for one in wanted[:MOST_WANTED] if isinstance(one, str)
                )
            }

    def tell(self, outcome: str) -> None:
        """Tell the outcome of an act, as JSON."""
        del self.outcomes[:-MOST_OUTCOMES]
        self.outcomes.append(outcome)
        self.news.set()

    def frame(self, board: Board, now: float) -> str:
        """Return what is newer than what the client has, as one frame; empty if nothing is."""
        updates = []
        for key, cell in board.cells.items():
            if self.sent.get(key, 0) >= cell.version or not self._sees(key, board):
                continue
            self.sent[key] = cell.version
            updates.append(cell.update)
        if not updates:
            return ''
        self.number += 1
        self._sent_at = time.monotonic()
        return (
            f'{{"kind":"frame","n":{self.number},"now":{now:.3f},"updates":[{",".join(updates)}]}}'
        )

    def _sees(self, key: tuple[str, str], board: Board) -> bool:
        if self.public and key[1] not in PUBLIC:
            return False
        return key[1] not in board.on_request or key in self.wanted


class Hub:
    """All clients, and the one task that looks at the board for them."""

    def __init__(self, board: Board, now: Callable[[], float]) -> None:
        """Start without a client.

        Args:
            board: What is known.
            now: Returns the time of the board [s].

        """
        self.board, self.now = board, now
        self.clients: set[Client] = set()
        self.wanted: set[tuple[str, str]] = set()
        """robot and slot of what clients have asked for"""
        self.at_each_look: list[Callable[[float], None]] = []
        """called after each look at the board, with its time"""
        self.at_each_second: list[Callable[[float], None]] = []
        """called about once a second, whether somebody looks or not, with the time of the board"""
        self.busy: Callable[[], bool] = lambda: False
        """returns whether the board must be looked at though there is no client"""

    async def run(self) -> None:
        """Look at the board until cancelled: often while somebody is there, else once a second."""
        second = 0.0
        while True:
            begun = time.monotonic()
            try:
                watched = bool(self.clients) or self.busy()
                if watched:
                    self.look()
                else:
                    self.board.look(self.now())
                if begun - second >= 1.0:
                    second = begun
                    for act in self.at_each_second:
                        act(self.now())
            except Exception:  # noqa: BLE001 - told; the page must go on
                _LOG.exception('a look at the robots has failed')
            period = PERIOD if watched else 5.0 * PERIOD
            await asyncio.sleep(max(period - (time.monotonic() - begun), 0.2 * PERIOD))

    def look(self) -> None:
        """Make the newest cells, and wake all clients."""
        now = self.now()
        self.wanted = {key for client in self.clients for key in client.wanted}
        self.board.refresh(now, self.wanted)
        for act in self.at_each_look:
            act(now)
        for client in self.clients:
            client.news.set()

    def tell(self, outcome: dict[str, Any]) -> None:
        """Tell all who have logged in the outcome of an act."""
        text = as_json({'kind': 'outcome'} | outcome)
        for client in self.clients:
            if not client.public:
                client.tell(text)

    async def serve(self, socket: WebSocket, client: Client, hello: dict[str, Any]) -> None:
        """Serve one client until it leaves."""
        await socket.send_text(as_json(hello | {'kind': 'hello', 'now': round(self.now(), 3)}))
        self.clients.add(client)
        client.news.set()
        sending = asyncio.create_task(self._send(socket, client))
        try:
            await client.listen(socket)
        finally:
            self.clients.discard(client)
            sending.cancel()

    async def _send(self, socket: WebSocket, client: Client) -> None:
        """Send frame after frame, each only when the last one has been acknowledged, or is old."""
        try:
            while True:
                await client.news.wait()
                client.news.clear()
                outcomes, client.outcomes = client.outcomes, []
                for outcome in outcomes:
                    await socket.send_text(outcome)
                if not client.renew():
                    await socket.close(4401, 'the session has ended: log in again')
                    return
                frame = client.frame(self.board, self.now()) if client.is_due() else ''
                if frame:
                    await socket.send_text(frame)
        except (WebSocketDisconnect, RuntimeError, OSError):
            return  # it has left meanwhile
