"""The application: every door of the page, and what stands before them."""

from __future__ import annotations

import asyncio
import time
from contextlib import asynccontextmanager, suppress
from typing import TYPE_CHECKING, Any, NamedTuple

from starlette.applications import Starlette
from starlette.responses import FileResponse, JSONResponse, RedirectResponse
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles

from agv_motion.dashboard.server.alerts import AlertDesk, alert_doors
from agv_motion.dashboard.server.door import is_public
from agv_motion.dashboard.server.doors import doors
from agv_motion.dashboard.server.drive import drive
from agv_motion.dashboard.server.foxglove.door import FoxgloveDoor
from agv_motion.dashboard.server.gate import Gate
from agv_motion.dashboard.server.ground import ground_doors
from agv_motion.dashboard.server.history import history_doors, keep_told, look_back
from agv_motion.dashboard.server.live import Client
from agv_motion.dashboard.server.login import login_doors
from agv_motion.dashboard.server.marks import mark_doors
from agv_motion.dashboard.server.parameters import parameter_doors
from agv_motion.dashboard.server.reports import report_doors
from agv_motion.dashboard.server.roles import Role
from agv_motion.dashboard.server.site import STATIC

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Awaitable, Callable, Collection

    from starlette.requests import Request
    from starlette.responses import Response
    from starlette.routing import BaseRoute
    from starlette.types import ASGIApp
    from starlette.websockets import WebSocket

    from agv_motion.dashboard.server.foxglove.door import EndpointRoom
    from agv_motion.dashboard.server.site import Site

MOST_CLIENTS = 100
"""that look at once; a tablet, a few phones and a laptop are ten"""
MOST_OF_ONE = 40
"""of them from one address"""


class PageFiles(StaticFiles):
    """The files of the page: a browser keeps them, and asks each time whether they are the same."""

    def file_response(self, *args: Any, **options: Any) -> Response:
        """Return a file, or that it has not changed."""
        response = super().file_response(*args, **options)
        response.headers['cache-control'] = 'no-cache'
        return response


class Foxglove(NamedTuple):
    """The endpoint for tools."""

    room: EndpointRoom
    acts: bool = False
    """whether operators and experts may act there"""
    origins: Collection[str] = ()
    """sites whose pages may open it"""
    alone: bool = False
    """without the operator's page, and at the root of the address, too"""


def application(
    site: Site, names: Collection[str] = (), clock: Callable[[], float] = time.monotonic,
    foxglove: Foxglove | None = None,
) -> ASGIApp:  # fmt: skip
    """Return the application of a page.

    Args:
        site: Robots, access and what is kept.
        names: By which browsers may know this host, beside its addresses and ``localhost``.
        clock: Returns seconds that never go back.
        foxglove: What is served to tools such as Foxglove; None: nothing.

    """

    @asynccontextmanager
    async def life(_: Starlette) -> AsyncIterator[None]:
        work = [site.hub.run(), keep_told(site), *([foxglove.room.run()] if foxglove else [])]
        running = [asyncio.create_task(one) for one in work]
        yield
        for task in running:
            task.cancel()
            with suppress(asyncio.CancelledError):
                await task

    routes: list[BaseRoute] = [Route('/health', _health(site)), *login_doors(site)]
    origins: Collection[str] = ()
    if foxglove is not None:
        origins = foxglove.origins
        door = FoxgloveDoor(site, foxglove.room, acts=foxglove.acts)
        paths = ('/foxglove', '/') if foxglove.alone else ('/foxglove',)
        routes += [WebSocketRoute(path, door.open) for path in paths]
    if foxglove is None or not foxglove.alone:
        routes += _page(site)
    return Gate(Starlette(routes=routes, lifespan=life), names, clock, origins)


def _page(site: Site) -> list[BaseRoute]:
    """Return all that belongs to the operator's page."""
    desk = AlertDesk(site)
    routes: list[BaseRoute] = [
        *_pages(site), *doors(site), *parameter_doors(site), *ground_doors(site),
        *mark_doors(site), *history_doors(site, desk), *alert_doors(site, desk),
        *report_doors(site), *_sockets(site),
    ]  # fmt: skip
    if STATIC.is_dir():
        routes.append(Mount('/static', PageFiles(directory=STATIC)))
    return routes


def _health(site: Site) -> Callable[[Request], Awaitable[Response]]:
    async def health(_: Request) -> Response:
        return JSONResponse({'robots': len(site.fleet.robots), 'clients': len(site.hub.clients)})

    return health


def _pages(site: Site) -> list[Route]:
    async def page(request: Request) -> Response:
        if site.access.visitor(request).role is Role.PUBLIC:
            return RedirectResponse('/login', 303)
        return _file('index.html')

    async def public(_: Request) -> Response:
        return _file('public.html')

    async def login(_: Request) -> Response:
        return _file('login.html')

    return [
        Route('/', page),
        Route('/public', public),
        Route('/login', login, methods=['GET']),
    ]


def _file(name: str) -> Response:
    path = STATIC / name
    if not path.is_file():
        return JSONResponse({'error': f'{name} is missing: install agv_motion anew'}, 503)
    return FileResponse(path)


def _sockets(site: Site) -> list[WebSocketRoute]:
    async def live(socket: WebSocket) -> None:
        address = '' if socket.client is None else socket.client.host
        here = sum(client.address == address for client in site.hub.clients)
        if len(site.hub.clients) >= MOST_CLIENTS or here >= MOST_OF_ONE:
            await socket.close(1013, 'too many look at once')
            return
        public = is_public(site, socket)
        visitor = site.access.visitor(socket)
        await socket.accept()
        hello = {
            'role': Role.PUBLIC.word if public else visitor.role.word,
            'user': '' if public else visitor.name,
            'csrf': '' if public else visitor.csrf,
            'robots': site.fleet.robots,
        }
        client = Client(
            public=public, address=address,
            welcome=lambda: public or site.access.visitor(socket) == visitor,
        )  # fmt: skip
        if 'at' in socket.query_params or site.recorded:
            await look_back(site, socket, client, hello)
        else:
            await site.hub.serve(socket, client, hello)

    async def hand(socket: WebSocket) -> None:
        await drive(site, socket)

    return [WebSocketRoute('/live', live), WebSocketRoute('/robots/{robot}/drive', hand)]
