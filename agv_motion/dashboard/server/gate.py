"""What stands before every door: whose page asks, how often, and how much.

Refuses names of this host that are none (DNS rebinding), acts and websockets of foreign pages
(`Origin`), floods and bodies without end; and gives every answer the headers by which a browser
keeps to what this page is.
"""

from __future__ import annotations

import asyncio
import json
import logging
import re
import time
from ipaddress import ip_address
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.server.rates import RateLimit

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from starlette.types import ASGIApp, Message, Receive, Scope, Send

LARGEST_BODY = 64 * 1024
"""[bytes] of a request"""
SLOWEST_BODY = 10.0
"""[s] in which it must have come"""
TOOLS = frozenset({'/foxglove', '/'})
"""Doors for tools, whose pages may come from other sites"""
SAFE = frozenset({'GET', 'HEAD'})
KNOWN = SAFE | {'POST'}

_LOG = logging.getLogger('uvicorn.error')
_HOST = re.compile(r'(\[[0-9A-Fa-f:.]+\]|[A-Za-z0-9._-]+)(:\d{1,5})?')

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "font-src 'self'; connect-src 'self' {socket}; manifest-src 'self'; base-uri 'none'; "
    "form-action 'self'; frame-ancestors 'none'"
)
HEADERS = {
    'x-content-type-options': 'nosniff',
    'x-frame-options': 'DENY',
    'referrer-policy': 'no-referrer',
    'cross-origin-opener-policy': 'same-origin',
    'cross-origin-resource-policy': 'same-origin',
    'permissions-policy': 'camera=(), geolocation=(), microphone=(), payment=(), usb=()',
    'cache-control': 'no-store',
}
"""of every answer, unless the door has set its own"""


class Gate:
    """Lets pass what may come to the doors."""

    def __init__(
        self, inner: ASGIApp, names: Collection[str] = (),
        clock: Callable[[], float] = time.monotonic, origins: Collection[str] = (),
    ) -> None:  # fmt: skip
        """Stand before an application.

        Args:
            inner: The application.
            names: By which browsers may know this host, beside its addresses and ``localhost``.
            clock: Returns seconds that never go back.
            origins: Sites whose pages may open `/foxglove`, as ``https://app.example``.

        """
        self._inner = inner
        self._origins = frozenset(origin.lower().rstrip('/') for origin in origins)
        self._names = frozenset(name.lower() for name in names) | {'localhost'}
        self._acts = RateLimit(burst=60, rate=20.0, clock=clock)
        self._stops = RateLimit(burst=60, rate=20.0, clock=clock)
        """a flood of other acts must not keep anybody from STOP"""
        self._told = RateLimit(burst=5, rate=0.1, clock=clock)
        self._sockets = RateLimit(burst=100, rate=10.0, clock=clock)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Refuse a request, or let it through."""
        if scope['type'] == 'lifespan':
            await self._inner(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if scope['type'] == 'websocket':
            if refusal:
                await receive()
                await send({'type': 'websocket.close', 'code': 1008, 'reason': refusal[1][:100]})
            else:
                await self._inner(scope, receive, send)
            return
        answer = _Answer(scope, send)
        if refusal:
            await answer.refuse(*refusal)
        elif scope['method'] in SAFE:
            await self._inner(scope, receive, answer.send)
        else:
            await self._bounded(scope, receive, answer)

    async def _bounded(self, scope: Scope, receive: Receive, answer: _Answer) -> None:
        """Let a request through whose body has come, whole and in time."""
        try:
            body = await asyncio.wait_for(_body(receive), SLOWEST_BODY)
        except asyncio.TimeoutError:
            await answer.refuse(408, f'the request has not come within {SLOWEST_BODY:g} s')
            return
        if body is None:
            await answer.refuse(413, f'the request has more than {LARGEST_BODY} bytes')
            return
        rest: list[Message] = [{'type': 'http.request', 'body': body, 'more_body': False}]

        async def replayed() -> Message:
            return rest.pop() if rest else await receive()

        await self._inner(scope, replayed, answer.send)

    def _refusal(self, scope: Scope) -> tuple[int, str] | None:
        """Return status and words where a request must not pass."""
        headers = dict(scope['headers'])
        host = headers.get(b'host', b'').decode('latin-1')
        if not self._is_ours(host):
            return 421, (
                f"'{host[:60]}' is no name of this host: ask by its address, or start the page "
                'with --name'
            )
        socket = scope['type'] == 'websocket'
        method = scope.get('method', '')
        if not socket and method not in KNOWN:
            return 405, f'{method[:10]} is not done here'
        foreign = (socket or method not in SAFE) and _is_foreign(scope, headers, host)
        tool = socket and scope['path'] in TOOLS
        if foreign and not (tool and self._is_listed(headers)):
            return 403, 'another page asks: only this page may act'
        if _length(headers) > LARGEST_BODY:
            return 413, f'the request has more than {LARGEST_BODY} bytes'
        return self._flood(scope, socket=socket)

    def _flood(self, scope: Scope, *, socket: bool) -> tuple[int, str] | None:
        who = str((scope.get('client') or ('',))[0])
        if socket:
            allowed = self._sockets.allows(who)
        elif scope['method'] in SAFE:
            return None
        else:
            stops = scope['path'].endswith('/stop')
            allowed = (self._stops if stops else self._acts).allows(who)
        return None if allowed else (429, 'too many at once: wait a few seconds')

    def _is_listed(self, headers: dict[bytes, bytes]) -> bool:
        """Return whether a tool asks whose site is on the list; one that is not is told of."""
        origin = headers.get(b'origin', b'').decode('latin-1')
        if origin.lower().rstrip('/') in self._origins:
            return True
        if self._told.allows(''):
            shown = ''.join(c if c.isprintable() else ' ' for c in origin[:80])
            _LOG.warning(
                'a tool of %s wanted to connect; if it may: start with --origin %s', shown, shown
            )
        return False

    def _is_ours(self, host: str) -> bool:
        """Return whether a browser may know this host by that name.

        Addresses are always ours: who rebinds a name to this machine has a name.
        """
        found = _HOST.fullmatch(host)
        if not found:
            return False
        name = found[1].lower().rstrip('.')
        if name in self._names:
            return True
        try:
            ip_address(name.strip('[]'))
        except ValueError:
            return False
        return True


async def _body(receive: Receive) -> bytes | None:
    """Return the body of a request; None if it goes on beyond its limit."""
    parts, size = [], 0
    while True:
        message = await receive()
        if message['type'] != 'http.request':
            return b''  # it has left
        parts.append(message.get('body', b''))
        size += len(parts[-1])
        if size > LARGEST_BODY:
            return None
        if not message.get('more_body'):
            return b''.join(parts)


def _is_foreign(scope: Scope, headers: dict[bytes, bytes], host: str) -> bool:
    """Return whether the page of another site asks, as the browser tells."""
    origin = headers.get(b'origin')
    if origin is None:
        site = headers.get(b'sec-fetch-site', b'same-origin')
        return site not in {b'same-origin', b'none'}
    scheme = 'https' if scope.get('scheme') in {'https', 'wss'} else 'http'
    return origin.decode('latin-1').lower() != f'{scheme}://{host}'.lower()


def _length(headers: dict[bytes, bytes]) -> int:
    text = headers.get(b'content-length', b'0')
    return int(text) if text.isdigit() and len(text) < 20 else 0


class _Answer:
    """Sends an answer with the headers of all answers."""

    def __init__(self, scope: Scope, send: Send) -> None:
        self._scope, self._send = scope, send
        self._started = False

    async def send(self, message: Message) -> None:
        if message['type'] == 'http.response.start':
            self._started = True
            given = {name.lower() for name, _ in message['headers']}
            message['headers'] = [
                *message['headers'],
                *((name, value) for name, value in self._headers() if name not in given),
            ]
        await self._send(message)

    async def refuse(self, status: int, words: str) -> None:
        """Answer with an error, unless an answer has begun."""
        if self._started:
            return
        body = json.dumps({'error': words}).encode()
        headers = [
            (b'content-type', b'application/json'), (b'content-length', str(len(body)).encode()),
            (b'connection', b'close'),
        ]  # fmt: skip
        if status == 429:
            headers.append((b'retry-after', b'5'))
        start: dict[str, Any] = {
            'type': 'http.response.start', 'status': status, 'headers': headers,
        }  # fmt: skip
        await self.send(start)
        await self._send({'type': 'http.response.body', 'body': body})

    def _headers(self) -> list[tuple[bytes, bytes]]:
        host = dict(self._scope['headers']).get(b'host', b'').decode('latin-1')
        secure = self._scope.get('scheme') == 'https'
        socket = f'{"wss" if secure else "ws"}://{host}' if _HOST.fullmatch(host) else ''
        headers = HEADERS | {'content-security-policy': POLICY.format(socket=socket)}
        if secure:
            headers['strict-transport-security'] = 'max-age=31536000'
        return [(name.encode(), value.encode()) for name, value in headers.items()]
