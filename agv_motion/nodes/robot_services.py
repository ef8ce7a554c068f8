"""Services of other nodes, called without waiting: the answer comes to a callback, or none does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.dashboard.server.fleet import NoAnswerError

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.ros.live_port import LivePort

PATIENCE = 1.0
"""[s] within which a service is to answer"""


class _Call(NamedTuple):
    name: str
    client: Any
    request: Any
    end: float
    answer: Callable[[Any], None]
    """called with the response, or with a `NoAnswerError`"""


class RobotServices:
    """Calls services, and looks for their answers when it is asked to."""

    def __init__(self, port: LivePort) -> None:
        """Call nothing yet."""
        self._port = port
        self._clients: dict[tuple[str, str], Any] = {}
        self._waiting: list[_Call] = []
        self._called: list[tuple[_Call, Any]] = []

    def has(self, name: str) -> bool:
        """Return whether somebody offers a service."""
        return bool(self._port.node.count_services(name))

    def call(
        self, kind: type[Any], name: str, request: Any, answer: Callable[[Any], None],
        patience: float = PATIENCE,
    ) -> None:  # fmt: skip
        """Call a service; ``answer`` gets its response, or a `NoAnswerError`, later.

        Args:
            kind: Class of the service.
            name: Full name.
            request: Of that class.
            answer: Called by :meth:`poll`.
            patience: How long to wait [s].

        """
        key = name, kind.__name__
        if key not in self._clients:
            self._clients[key] = self._port.node.create_client(kind, name)
        end = self._port.steady_seconds() + patience
        self._waiting.append(_Call(name, self._clients[key], request, end, answer))
        self.poll()

    def poll(self) -> None:
        """Send what waits for its service to be found, and hand on what has been answered."""
        now = self._port.steady_seconds()
        waiting, self._waiting = self._waiting, []
        for call in waiting:
            if call.client.service_is_ready():
                self._called.append((call, call.client.call_async(call.request)))
            elif now > call.end:
                call.answer(NoAnswerError(f'{call.name} is not there'))
            else:
                self._waiting.append(call)
        called, self._called = self._called, []
        for call, future in called:
            if future.done():
                error = future.exception()
                call.answer(future.result() if error is None else NoAnswerError(str(error)))
            elif now > call.end:
                call.client.remove_pending_request(future)
                call.answer(NoAnswerError(f'no answer of {call.name} in {PATIENCE:g} s'))
            else:
                self._called.append((call, future))

    def close(self) -> None:
        """Wait for nothing any more."""
        self._waiting.clear()
        self._called.clear()
        for client in self._clients.values():
            self._port.node.destroy_client(client)
        self._clients.clear()
