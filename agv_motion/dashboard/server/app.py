"""The application: every door of the page, and what stands before them."""

from __future__ import annotations

import asyncio
from contextlib import asynccontextmanager, suppress
from typing import TYPE_CHECKING

from starlette.applications import Starlette
from starlette.responses import FileResponse, JSONResponse
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles

from agv_motion.dashboard.server.live import Client, Hub
from agv_motion.dashboard.server.site import STATIC, Site

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Callable

    from starlette.requests import Request
    from starlette.responses import Response
    from starlette.websockets import WebSocket

    from agv_motion.dashboard.server.fleet import Fleet


def application(fleet: Fleet) -> tuple[Starlette, Callable[[], bool]]:
    """Return the application for some robots, and what tells whether anybody looks."""
    site = Site(fleet, Hub(fleet.board, fleet.now))

    @asynccontextmanager
    async def life(_: Starlette) -> AsyncIterator[None]:
        running = asyncio.create_task(site.hub.run())
        yield
        running.cancel()
        with suppress(asyncio.CancelledError):
            await running

    async def page(_: Request) -> Response:
        return FileResponse(STATIC / 'index.html')

    async def public(_: Request) -> Response:
        return FileResponse(STATIC / 'public.html')

    async def health(_: Request) -> Response:
        return JSONResponse({'robots': fleet.robots, 'clients': len(site.hub.clients)})

    async def live(socket: WebSocket) -> None:
        await socket.accept()
        hello = {'role': 'expert', 'csrf': '', 'robots': fleet.robots}
        await site.hub.serve(socket, Client(public=False), hello)

    routes = [
        Route('/', page),
        Route('/public', public),
        Route('/health', health),
        WebSocketRoute('/live', live),
    ]
    if STATIC.is_dir():
        routes.append(Mount('/static', StaticFiles(directory=STATIC)))
    return Starlette(routes=routes, lifespan=life), lambda: bool(site.hub.clients)
