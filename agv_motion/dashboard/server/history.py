"""Look back: `GET /history`, `WS /live?at=SECONDS&rate=1`, `POST /history/save`.

Each who looks back has a board of its own, fed from the bag in a thread; few may at once.
"""

from __future__ import annotations

import asyncio
import time
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from agv_motion.bag.notes import notes_of
from agv_motion.dashboard.core.replay import Replay
from agv_motion.dashboard.server.door import Asked, Door, acting, looking
from agv_motion.dashboard.server.live import PERIOD, Client
from agv_motion.dashboard.server.marks import marks, show
from agv_motion.dashboard.server.requests import RequestError, number
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from starlette.routing import Route
    from starlette.websockets import WebSocket

    from agv_motion.bag.notes import Note
    from agv_motion.dashboard.server.alerts import AlertDesk
    from agv_motion.dashboard.server.history_bag import History
    from agv_motion.dashboard.server.site import Site

MOST = 6
"""who look back at once"""
FASTEST = 1000.0
LONGEST = 6 * 3600.0
"""[s] of a bag that is saved at once"""
LATEST = 1e11
"""[s since 1970]"""


def history_doors(site: Site, desk: AlertDesk) -> list[Route]:
    """Return the doors to the past."""
    history = site.history

    def require() -> History:
        if history is None:
            raise RequestError(404, 'nothing is recorded here: start with --bag FOLDER')
        return history

    async def look(_: Asked) -> dict[str, Any]:
        begin, end = await require().span()
        return {'begin': begin, 'end': end, 'marks': marks(site), 'alerts': desk.alerts()}

    async def save(asked: Asked) -> dict[str, Any]:
        begin, end = (number(asked.told, key, 0.0, LATEST) for key in ('begin', 'end'))
        if not 0.0 < end - begin <= LONGEST:
            raise RequestError(422, f'begin {begin:g}, end {end:g}: up to {LONGEST:g} s, in order')
        folder, count = await require().save(begin, end)
        return {'id': Path(folder).name, 'bag': folder, 'messages': count}

    return [
        looking(site, '/history', look),
        acting(site, Door('/history/save', save, ('begin', 'end'))),
    ]


async def keep_told(site: Site) -> None:
    """Tell on the board how far the bag reaches, as long as the page is served."""
    noted: list[Note] = []
    while site.history is not None:
        notes = await asyncio.to_thread(notes_of, site.history.bag)
        if notes != noted:
            noted = notes
            show(site)
        begin, end = await site.history.span()
        if end > 0.0:
            board, now = site.fleet.board, site.fleet.now()
            board.put('', 'history', now, {'begin': begin, 'end': end})
        await asyncio.sleep(site.history.renewal)


async def look_back(site: Site, socket: WebSocket, client: Client, hello: dict[str, Any]) -> None:
    """Serve frames from the bag, from a moment on; the socket has been accepted."""
    history = site.history
    try:
        at, rate = (float(socket.query_params.get(*pair)) for pair in (('at', '0'), ('rate', '1')))
    except ValueError:
        at = rate = float('nan')
    if not (isfinite(at) and isfinite(rate) and 0 <= at <= LATEST and 0 <= rate <= FASTEST):
        await socket.close(1008, 'at: seconds since 1970; rate: 0 to 1000')
        return
    if history is None or history.watchers >= MOST:
        words = 'nothing is recorded here' if history is None else 'too many look back at once'
        await socket.close(1013, words)
        return
    history.watchers += 1
    try:
        replay = await asyncio.to_thread(Replay, history.open, at or (await history.span())[0],
                                         site.platforms())  # fmt: skip
        try:
            await _Past(socket, client, replay, rate).serve(hello)
        finally:
            replay.close()
    except AgvMotionError as error:
        await socket.close(1011, str(error)[:100])
    finally:
        history.watchers -= 1


class _Past:
    """One who looks back."""

    def __init__(self, socket: WebSocket, client: Client, replay: Replay, rate: float) -> None:
        self._socket, self._client, self._replay, self._rate = socket, client, replay, rate

    async def serve(self, hello: dict[str, Any]) -> None:
        robots = sorted(self._replay.board.robots)
        told = {'kind': 'hello', 'now': self._replay.at, 'robots': robots, 'past': True}
        await self._socket.send_json(hello | told)
        sending = asyncio.create_task(self._send())
        try:
            await self._client.listen(self._socket)
        finally:
            sending.cancel()
            await asyncio.wait([sending])

    async def _send(self) -> None:
        """Send frames at the pace of the bag; who does not acknowledge waits for himself alone."""
        board, client = self._replay.board, self._client
        begun, now = self._replay.at, time.monotonic()
        start = now
        while True:
            at = begun + (time.monotonic() - start) * self._rate
            await asyncio.to_thread(self._replay.advance, at)
            board.refresh(at, client.wanted)
            if client.is_due():
                frame = client.frame(board, at)
                if frame:
                    await self._socket.send_text(frame)
            await asyncio.sleep(PERIOD)
