"""A door that acts: who may, with which token, once for each key; and how an error is answered."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any, NamedTuple

from starlette.responses import JSONResponse
from starlette.routing import Route

from agv_motion.dashboard.server.requests import RequestError, body_of
from agv_motion.dashboard.server.roles import Role
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, Collection

    from starlette.requests import HTTPConnection, Request
    from starlette.responses import Response

    from agv_motion.dashboard.server.roles import Visitor
    from agv_motion.dashboard.server.site import Site

    Act = Callable[['Asked'], 'dict[str, Any] | Awaitable[dict[str, Any]]']

TOKEN, KEY = 'x-csrf-token', 'idempotency-key'


class Asked(NamedTuple):
    """What stands at a door."""

    site: Site
    visitor: Visitor
    told: dict[str, Any]
    """the JSON of the request"""
    request: Request

    @property
    def robot(self) -> str:
        """Name of the robot in the address.

        Raises:
            RequestError: There is none of this name.

        """
        return known_robot(self.site, str(self.request.path_params['robot']))


def known_robot(site: Site, name: str) -> str:
    """Return the name of a robot that is there.

    Raises:
        RequestError: There is none.

    """
    if name not in site.fleet.robots:
        raise RequestError(404, f"no robot '{name[:60]}'")
    return name


def require_role(visitor: Visitor, role: Role) -> None:
    """Refuse a visitor who may not.

    Raises:
        RequestError: Nobody has logged in (401), or somebody with a lesser role (403).

    """
    if visitor.role < role:
        status = 401 if visitor.role is Role.PUBLIC else 403
        raise RequestError(status, f'this needs the role {role.word}: log in as one who has it')


def require_token(site: Site, visitor: Visitor, token: str) -> None:
    """Refuse an act that does not bear the token of its session.

    Raises:
        RequestError: It does not.

    """
    if not site.access.bears(visitor, token):
        raise RequestError(403, 'the CSRF token is missing or not of this session: load anew')


class Door(NamedTuple):
    """A door that acts, for POST."""

    path: str
    act: Act
    """does it, and returns what is answered"""
    known: Collection[str] = ()
    """keys that the JSON of a request may have"""
    role: Role = Role.OPERATOR
    """that it needs"""
    keyed: bool = True
    """whether a request must bear a key, by which the same one again is known; without one it is
    done each time"""


def acting(site: Site, door: Door) -> Route:
    """Return the route to a door that acts."""

    async def answer(request: Request) -> Response:
        try:
            return await _acted(site, request, door)
        except AgvMotionError as error:
            return refusal(error)

    return Route(door.path, answer, methods=['POST'])


async def _acted(site: Site, request: Request, door: Door) -> Response:
    visitor = site.access.visitor(request)
    require_role(visitor, door.role)
    require_token(site, visitor, request.headers.get(TOKEN, ''))
    told = await body_of(request, door.known)
    key = request.headers.get(KEY, '')
    what = f'{request.url.path} {sorted(told.items())!r}'
    if door.keyed or key:
        before = site.replays.find(visitor.csrf, key, what)
        if before is not None:
            return JSONResponse(before, 202, {'Idempotency-Replayed': 'true'})
    found = door.act(Asked(site, visitor, told, request))
    answer = await found if inspect.isawaitable(found) else found
    if key:
        site.replays.keep(visitor.csrf, key, what, answer)
    return JSONResponse(answer, 202)


def looking(site: Site, path: str, look: Callable[[Asked], Any]) -> Route:
    """Return a door for GET that answers with JSON."""

    async def door(request: Request) -> Response:
        try:
            visitor = site.access.visitor(request)
            require_role(visitor, Role.VIEWER)
            found = look(Asked(site, visitor, {}, request))
            return JSONResponse(await found if inspect.isawaitable(found) else found)
        except AgvMotionError as error:
            return refusal(error)

    return Route(path, door, methods=['GET'])


def refusal(error: AgvMotionError) -> Response:
    """Return an error as an answer."""
    return JSONResponse({'error': str(error)}, getattr(error, 'status', 422))


def is_public(site: Site, connection: HTTPConnection) -> bool:
    """Return whether a visitor sees only what is for everyone, or asks for no more."""
    if connection.query_params.get('public'):
        return True
    return site.access.visitor(connection).role is Role.PUBLIC
