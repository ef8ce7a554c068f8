"""The web server in a thread of its own, beside whoever hears the robots."""

from __future__ import annotations

import errno
import socket
import threading
from typing import TYPE_CHECKING, Any

import uvicorn

from agv_motion.dashboard.server.foxglove.wire import BatchProtocol
from agv_motion.dashboard.server.prompt_protocol import PromptProtocol, allow_descriptors
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from starlette.types import ASGIApp

LARGEST_MESSAGE = 64 * 1024
"""[bytes] that a browser may send at once"""
NEXT_PORTS = 20
"""that are tried after one that is taken"""
STARTING = 20.0
"""[s] within which the server must be ready"""


def listening(host: str, port: int, *, next_free: bool = False) -> socket.socket:
    """Return a socket that listens.

    Args:
        host: Name or address of this machine.
        port: 0 for any that is free.
        next_free: Take one of the next ports where this one is taken.

    Raises:
        ConfigurationError: The port is taken, or the host is not this machine.

    """
    family = socket.AF_INET6 if ':' in host else socket.AF_INET
    for candidate in range(port, port + (NEXT_PORTS if next_free and port else 1)):
        made = socket.socket(family, socket.SOCK_STREAM)
        made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            made.bind((host, candidate))
            made.listen(100)
        except OSError as error:
            made.close()
            if error.errno == errno.EADDRINUSE and candidate < port + NEXT_PORTS - 1 and next_free:
                continue
            if error.errno == errno.EADDRINUSE:
                msg = f'port {candidate} of {host} is taken: give another by --port'
            else:
                msg = f'cannot listen on {host}:{candidate} ({error.strerror or error})'
            raise ConfigurationError(msg) from error
        return made
    msg = f'ports {port} to {port + NEXT_PORTS - 1} of {host} are taken: give another by --port'
    raise ConfigurationError(msg)


class WebServer:
    """Serves an application until it is closed."""

    def __init__(
        self, application: ASGIApp, listener: socket.socket, certificate: str = '', key: str = ''
    ) -> None:
        """Prepare.

        Args:
            application: To be served.
            listener: Of `listening`.
            certificate: File of the certificate (PEM), for TLS; empty: none.
            key: File of its key.

        """
        allow_descriptors()
        tls: dict[str, Any] = (
            {'ssl_certfile': certificate, 'ssl_keyfile': key or None} if certificate else {}
        )
        self.listener = listener
        config = uvicorn.Config(
            application, log_level='warning', access_log=False, lifespan='on', http=PromptProtocol,
            ws=BatchProtocol, ws_max_size=LARGEST_MESSAGE, ws_per_message_deflate=False,
            ws_ping_interval=10.0, ws_ping_timeout=10.0, server_header=False, date_header=False,
            h11_max_incomplete_event_size=16 * 1024, timeout_graceful_shutdown=1,
            timeout_keep_alive=10, **tls,
        )  # fmt: skip
        self._server = uvicorn.Server(config)
        self._thread = threading.Thread(target=self._run, name='web server', daemon=True)
        self.scheme = 'https' if certificate else 'http'

    @property
    def url(self) -> str:
        """Where a browser finds the page."""
        host, port = self.listener.getsockname()[:2]
        name = {'0.0.0.0': socket.gethostname(), '::': socket.gethostname()}.get(host, host)  # noqa: S104 - compared
        return f'{self.scheme}://{f"[{name}]" if ":" in name else name}:{port}'

    def start(self) -> None:
        """Serve in a thread from now on.

        Raises:
            ConfigurationError: The server did not start.

        """
        self._thread.start()
        waited = threading.Event()
        for _ in range(int(STARTING / 0.02)):
            if self._server.started or not self._thread.is_alive():
                break
            waited.wait(0.02)
        if not self._server.started:
            msg = 'the web server did not start: its log above tells why'
            raise ConfigurationError(msg)

    def close(self) -> None:
        """Say goodbye to all, and stop."""
        self._server.should_exit = True
        if self._thread.is_alive():
            self._thread.join(timeout=5.0)
        self.listener.close()

    def _run(self) -> None:
        self._server.run(sockets=[self.listener])
