"""Services of other nodes, called and waited for: an answer, or an error that says what to do."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import rclpy

from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from collections.abc import Mapping

PATIENCE = 5.0
"""[s] within which a service is to be found and to answer"""

LOOK = 0.02
"""[s] between two looks at what has come"""


class UnansweredError(AgvMotionError):
    """A service is not there, or does not answer in time."""


def call(node: Any, kind: type[Any], name: str, request: Any, patience: float = PATIENCE) -> Any:
    """Return the response of a service.

    Args:
        node: Of rclpy, that calls; it is spun.
        kind: Class of the service.
        name: Full name.
        request: Of that class.
        patience: How long to wait [s].

    Raises:
        UnansweredError: It is not there, or does not answer in time.

    """
    answer = call_all(node, kind, {name: request}, patience)[name]
    if isinstance(answer, UnansweredError):
        raise answer
    return answer


def call_all(
    node: Any, kind: type[Any], requests: Mapping[str, Any], patience: float = PATIENCE
) -> dict[str, Any]:
    """Call services of one class, all at once; return of each the response, or a `UnansweredError`.

    Args:
        node: Of rclpy, that calls; it is spun.
        kind: Class of the services.
        requests: By full name.
        patience: How long to wait for all [s].

    """
    end = time.monotonic() + patience
    clients = {name: node.create_client(kind, name) for name in requests}
    futures: dict[str, Any] = {}
    try:
        while time.monotonic() < end:
            for name, client in clients.items():
                if name not in futures and client.service_is_ready():
                    futures[name] = client.call_async(requests[name])
            if len(futures) == len(clients) and all(f.done() for f in futures.values()):
                break
            rclpy.spin_once(node, timeout_sec=LOOK)
        return {name: _answer(name, futures.get(name), patience) for name in requests}
    finally:
        for client in clients.values():
            node.destroy_client(client)


def _answer(name: str, future: Any, patience: float) -> Any:
    if future is None:
        return UnansweredError(f'the service {name} was not there within {patience:g} s')
    if not future.done():
        return UnansweredError(
            f'the service {name} is there, but did not answer within {patience:g} s: '
            'its node is stopped or busy'
        )
    if future.exception() is not None:
        return UnansweredError(f'the service {name}: {future.exception()}')
    return future.result()
