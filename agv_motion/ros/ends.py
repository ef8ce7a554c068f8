"""Topics, timers and services of a node: there while it is configured, silent while inactive.

rclpy lets callbacks of an inactive node run, and what they raise end the process. Here a callback
runs only while its node is active, an error of the input is told, and a defect stops the node.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.qos import DurabilityPolicy

from agv_motion.errors import AgvMotionError, ConfigurationError, shortened

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.clock import Clock
    from rclpy.qos import QoSProfile

    from agv_motion.ros.live_node import LiveNode
    from agv_motion.ros.live_port import LivePort

NO_EVENTS = PublisherEventCallbacks(use_default_callbacks=False)
"""Destroying a publisher with event callbacks crashes the EventsExecutor."""


class Ends:
    """What one node has opened."""

    def __init__(self, node: LiveNode[Any], port: LivePort) -> None:
        """Have opened nothing yet."""
        self._node, self._port = node, port
        self._closers: list[Callable[[], Any]] = []
        self._unheard: dict[str, Callable[[], None]] = {}
        """Latched messages that came while inactive, by topic"""

    def __bool__(self) -> bool:
        """Return whether anything is open."""
        return bool(self._closers)

    def add(self, close: Callable[[], Any]) -> None:
        """Call ``close`` when the node closes its ends; what was opened last goes first."""
        self._closers.append(close)

    def pop(self) -> Callable[[], Any]:
        """Return what closes the end that was opened last, and forget it."""
        return self._closers.pop()

    def forget_unheard(self) -> None:
        """Let be what came while inactive."""
        self._unheard.clear()

    def hear(self) -> None:
        """Hear what latched messages came while inactive, as long as the node is active."""
        while self._port.active and self._unheard:
            self._unheard.popitem()[1]()

    def publisher(self, kind: type[Any], topic: str, qos: QoSProfile) -> Any:
        """Return a publisher."""
        node = self._node
        publisher = node.create_publisher(kind, topic, qos, event_callbacks=NO_EVENTS)
        self.add(lambda: node.destroy_publisher(publisher))
        return publisher

    def listen(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], qos: QoSProfile
    ) -> None:
        """Call ``callback`` with each message; what is latched is kept while inactive."""
        node, port, unheard = self._node, self._port, self._unheard
        latched = qos.durability is DurabilityPolicy.TRANSIENT_LOCAL

        def guarded(message: Any) -> None:
            if not port.active:
                if latched:
                    unheard[topic] = lambda: guarded(message)
                return
            try:
                port.clock_guard.wake()
                callback(message)
            except AgvMotionError as error:
                port.refuse(f'{topic}: {port.message_of(error)}')
            except Exception as error:  # noqa: BLE001 - a defect
                node.stop_for(topic, error)

        subscription = node.create_subscription(
            kind, topic, guarded, qos,
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )  # fmt: skip
        self.add(lambda: node.destroy_subscription(subscription))

    def every(self, seconds: float, callback: Callable[[], None], clock: Clock | None) -> None:
        """Call ``callback`` periodically."""
        node, port = self._node, self._port

        def guarded() -> None:
            if port.active:
                try:
                    port.clock_guard.wake()
                    callback()
                except AgvMotionError as error:
                    port.refuse(port.message_of(error))
                except Exception as error:  # noqa: BLE001 - a defect
                    node.stop_for('a timer', error)

        timer = node.create_timer(seconds, guarded, clock=clock)
        self.add(lambda: node.destroy_timer(timer))

    def serve(self, kind: type[Any], name: str, act: Callable[[Any], str]) -> None:
        """Offer a service; it refuses while the node is inactive."""
        node, port = self._node, self._port

        def guarded(request: Any, response: Any) -> Any:
            try:
                self._require_active()
                port.clock_guard.wake()
                message, response.success = act(request), True
            except AgvMotionError as error:
                message = f'refused: {port.message_of(error)}'
            except Exception as error:  # noqa: BLE001 - a defect
                node.stop_for(name, error)
                message = f'refused: {node.defect}'
            if hasattr(response, 'message'):
                response.message = message.removeprefix('refused: ')
            port.complaints.inform(f'{name}: {shortened(message)}')
            return response

        service = node.create_service(kind, name, guarded)
        self.add(lambda: node.destroy_service(service))

    def _require_active(self) -> None:
        if not self._port.active:
            msg = f'{self._port.name} is not active: activate it first'
            raise ConfigurationError(msg)
