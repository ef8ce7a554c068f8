"""`POST /login` and `POST /logout`: a session begins with a password, and ends for good."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from starlette.responses import JSONResponse
from starlette.routing import Route

from agv_motion.dashboard.server.access import PLAIN, SECURE, token_of
from agv_motion.dashboard.server.door import Asked, Door, acting, refusal
from agv_motion.dashboard.server.rates import RateLimit
from agv_motion.dashboard.server.requests import RequestError, body_of, text
from agv_motion.dashboard.server.roles import Role
from agv_motion.dashboard.server.users import LASTING, LONGEST
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from starlette.requests import Request
    from starlette.responses import Response

    from agv_motion.dashboard.server.site import Site

WRONG = 'user or password is wrong'
"""the same words whatever is wrong: nobody learns who is a user"""
AT_ONCE = 2
"""passwords that are verified at a time: each takes 64 MB and a tenth of a second"""


def login_doors(site: Site) -> list[Route]:
    """Return the doors by which visitors come and go."""
    by_address = RateLimit(burst=10, rate=1.0 / 15.0)
    by_name = RateLimit(burst=10, rate=1.0 / 30.0)
    turn = asyncio.Semaphore(AT_ONCE)

    async def login(request: Request) -> Response:
        try:
            name = await _verified(request)
        except AgvMotionError as error:
            return refusal(error)
        assert site.access.users is not None
        answer = JSONResponse({'user': name})
        _set_cookie(answer, request, site.access.users.begin(name), LASTING)
        return answer

    async def _verified(request: Request) -> str:
        """Return who has logged in.

        Raises:
            RequestError: Nobody has, or it was tried too often.

        """
        told = await body_of(request, ('user', 'password'))
        name = text(told, 'user', 60)
        password = told.get('password')
        if not isinstance(password, str) or len(password) > LONGEST:
            raise RequestError(401, WRONG)
        address = '' if request.client is None else request.client.host
        if not (by_address.allows(address) and by_name.allows(name.lower())):
            raise RequestError(429, 'too many attempts: wait a minute')
        users = site.access.users
        if users is None:
            raise RequestError(401, WRONG)
        async with turn:
            if not await asyncio.to_thread(users.verify, name, password):
                raise RequestError(401, WRONG)
        return name

    return [
        Route('/login', login, methods=['POST']),
        acting(site, Door('/logout', _logout, ('everywhere',), Role.VIEWER, keyed=False)),
    ]


def _logout(asked: Asked) -> dict[str, Any]:
    users, token = asked.site.access.users, token_of(asked.request)
    if users is None or not token:
        return {'user': ''}
    if asked.told.get('everywhere') is True:
        users.end_all(asked.visitor.name)
    users.end(token)
    return {'user': ''}


def _set_cookie(answer: Response, request: Request, token: str, seconds: float) -> None:
    secure = request.url.scheme == 'https'
    answer.set_cookie(
        SECURE if secure else PLAIN, token, max_age=round(seconds), path='/', secure=secure,
        httponly=True, samesite='strict',
    )  # fmt: skip
