"""What clients of `/foxglove` say and ask on the graph: decoded, judged, and only then sent on."""

from __future__ import annotations

import time
from math import isfinite
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.foxglove.permissions import HAND, STOP
from agv_motion.dashboard.server.fleet import RefusedError
from agv_motion.errors import SignalError
from agv_motion.nodes.robot_services import RobotServices
from agv_motion.ros.cdr import codec
from agv_motion.ros.endpoints import message_class

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.ros.live_port import LivePort

ARBITER = 'arbiter'
MOST_OPENED = 200
"""topics on which something may ever be published here, each by its type"""
PADDING = 3
"""[bytes] that may follow a message in CDR"""
CALL_PATIENCE = 5.0
"""[s] within which a service is to answer"""


class FoxgloveActs:
    """Publishes and calls; everything in the thread of the node."""

    patience = 1.0
    """[s] within which somebody who listens must have been found"""

    def __init__(self, port: LivePort, publisher: Callable[[type[Any], str], Any]) -> None:
        """Do nothing yet.

        Args:
            port: Of the node.
            publisher: Returns the one of a message class and a topic, made when first needed.

        """
        self._node = port.node
        self._services = RobotServices(port)
        self._publisher = publisher
        self._opened: set[tuple[str, str]] = set()

    def poll(self) -> None:
        """Hand on what services have answered."""
        self._services.poll()

    def prepare(self, topic: str, kind: str) -> bool:
        """Open a topic, so that who listens has been found when something is published.

        Raises:
            RefusedError: Too many were opened before: they stay open.

        """
        self._opened |= {(topic, kind)} if len(self._opened) < MOST_OPENED else set()
        if (topic, kind) not in self._opened:
            msg = f'{topic}: {MOST_OPENED} topics were opened here before: no more can be'
            raise RefusedError(msg)
        self._publisher(message_class(kind), topic)
        return True

    def publish(self, topic: str, kind: str, data: bytes, end: float) -> bool:
        """Publish a message; return False as long as nobody is there who listens.

        Args:
            topic: Full name.
            kind: Its type.
            data: In CDR.
            end: When to give up [s, steady].

        Raises:
            SignalError: The data are no message of the type, or hold a number that is none.
            RefusedError: Nobody listens, or it would move a robot past its arbiter.

        """
        whole = message_class(kind)
        message = decoded(topic, whole, data)
        self.prepare(topic, kind)
        publisher = self._publisher(whole, topic)
        listeners = self._node.get_subscriptions_info_by_topic(topic)
        if not listeners or not publisher.get_subscription_count():
            if time.monotonic() < end:
                return False
            msg = f'{topic}: nobody listens to {kind} there'
            raise RefusedError(msg)
        if topic.endswith((f'/{HAND}', f'/{STOP}')):
            _require_arbiter(topic, listeners)
        publisher.publish(message)
        return True

    def call(
        self, service: str, kind: str, data: bytes, answer: Callable[[bytes | Exception], None]
    ) -> None:
        """Call a service with a request in CDR; ``answer`` gets the response in CDR, later.

        Raises:
            SignalError: The data are no request of the type, or hold a number that is none.

        """
        whole = message_class(kind)
        request = decoded(service, whole.Request, data)

        def told(response: Any) -> None:
            failed = isinstance(response, Exception)
            answer(response if failed else codec(whole.Response).encode(response))

        self._services.call(whole, service, request, told, CALL_PATIENCE)


def _require_arbiter(topic: str, listeners: list[Any]) -> None:
    """Refuse twists that something else than an arbiter would obey.

    Raises:
        RefusedError: There is no arbiter, or wheels listen themselves.

    """
    robot = topic.removesuffix(f'/{HAND}').removesuffix(f'/{STOP}') or '/'
    own = [one.node_name for one in listeners if one.node_namespace == robot]
    if ARBITER not in own:
        msg = f'{topic}: no arbiter listens, without which nothing here moves a robot'
        raise RefusedError(msg)
    wheels = [name for name in own if name.endswith('kinematics')]
    if wheels:
        msg = f'{topic}: {wheels[0]} listens beside the arbiter, past its STOP'
        raise RefusedError(msg)


def decoded(where: str, kind: Any, data: bytes) -> Any:
    """Return the message of a class that data in CDR are, whole, and with no number that is none.

    Raises:
        SignalError: They are none, or more than one: those of another type, as like as not.

    """
    message = codec(kind).decode(data)
    size = len(codec(kind).encode(message))
    if len(data) - size > PADDING:
        msg = f'{where}: {len(data)} bytes, where {kind.__name__} has {size}: is it another type?'
        raise SignalError(msg)
    require_finite(where, message)
    return message


def require_finite(where: str, message: Any, path: str = '') -> None:
    """Refuse a message with a number that is none.

    Raises:
        SignalError: It has one; its field is named.

    """
    for field in message.get_fields_and_field_types():
        value = getattr(message, field)
        many = hasattr(value, '__iter__') and not isinstance(value, (str, bytes))
        for one in value if many else (value,):
            if hasattr(one, 'get_fields_and_field_types'):
                require_finite(where, one, f'{path}{field}.')
            elif isinstance(one, float) and not isfinite(one):
                msg = f'{where}: {path}{field} = {one}: must be a finite number'
                raise SignalError(msg)
