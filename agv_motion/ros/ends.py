"""Topics, timers and services of a node: there while it is configured, silent while inactive.

rclpy lets callbacks of an inactive node run, and what they raise end the process. Here a callback
runs only while its node is active, an error of the input is told, and a defect stops the node. What
an executor had in hand when an end was closed comes to nothing: another one may be there by then.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.service_introspection import ServiceIntrospectionState

from agv_motion.errors import AgvMotionError, ConfigurationError, shortened

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.clock import Clock
    from rclpy.lifecycle import LifecycleNode

NO_EVENTS = PublisherEventCallbacks(use_default_callbacks=False)
"""Destroying a publisher with event callbacks crashes the EventsExecutor."""


TOLD = QoSProfile(depth=100)
"""Of the topics that tell what services are asked, and by whom"""


class Owner(Protocol):
    """For whom callbacks are guarded."""

    active: bool

    def wake(self) -> None:
        """Judge the inputs first, where nothing has run for a while."""

    def refuse(self, reason: str) -> None:
        """Tell of an input that was not used."""

    def inform(self, text: str) -> None:
        """Log what was done; of repeats only some."""

    def message_of(self, error: AgvMotionError) -> str:
        """Return the message of an error, as it may be told."""

    def stop_for(self, where: str, error: Exception) -> str:
        """Deactivate the node for a defect; return it in words."""


class Ends:
    """What one node has opened."""

    def __init__(self, node: LifecycleNode, owner: Owner) -> None:
        """Have opened nothing yet.

        Args:
            node: Of rclpy.
            owner: For whom callbacks are guarded.

        """
        self._node, self._owner = node, owner
        self._closers: list[Callable[[], Any]] = []
        self._unheard: dict[str, Callable[[], None]] = {}
        """Messages that are to be kept and came while inactive, by topic"""

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
        while self._owner.active and self._unheard:
            self._unheard.popitem()[1]()

    def publisher(self, kind: type[Any], topic: str, qos: QoSProfile) -> Any:
        """Return a publisher."""
        node = self._node
        publisher = node.create_publisher(kind, topic, qos, event_callbacks=NO_EVENTS)
        self.add(lambda: node.destroy_publisher(publisher))
        return publisher

    def listen(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], qos: QoSProfile,
        *, kept: bool = False,
    ) -> None:  # fmt: skip
        """Call ``callback`` with each message; the last one is kept while inactive, if latched."""
        node, owner, unheard = self._node, self._owner, self._unheard
        kept = kept or qos.durability is DurabilityPolicy.TRANSIENT_LOCAL
        there = True

        def guarded(message: Any) -> None:
            if not there:
                return
            if not owner.active:
                if kept:
                    unheard[topic] = lambda: guarded(message)
                return
            try:
                owner.wake()
                callback(message)
            except AgvMotionError as error:
                owner.refuse(f'{topic}: {owner.message_of(error)}')
            except Exception as error:  # noqa: BLE001 - a defect
                owner.stop_for(topic, error)

        subscription = node.create_subscription(
            kind, topic, guarded, qos,
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )  # fmt: skip

        def close() -> None:
            nonlocal there
            there = False
            node.destroy_subscription(subscription)

        self.add(close)

    def every(self, seconds: float, callback: Callable[[], None], clock: Clock | None) -> None:
        """Call ``callback`` periodically."""
        node, owner, there = self._node, self._owner, True

        def guarded() -> None:
            if there and owner.active:
                try:
                    owner.wake()
                    callback()
                except AgvMotionError as error:
                    owner.refuse(owner.message_of(error))
                except Exception as error:  # noqa: BLE001 - a defect
                    owner.stop_for('a timer', error)

        timer = node.create_timer(seconds, guarded, clock=clock)

        def close() -> None:
            nonlocal there
            there = False
            node.destroy_timer(timer)

        self.add(close)

    def serve(self, kind: type[Any], name: str, act: Callable[[Any], str]) -> None:
        """Offer a service; it refuses while the node is inactive.

        What it is asked and answers is told on ``NAME/_service_event``, so that it is in a bag.
        """
        node, owner = self._node, self._owner

        def guarded(request: Any, response: Any) -> Any:
            try:
                self._require_active()
                owner.wake()
                message, response.success = act(request), True
            except AgvMotionError as error:
                message = f'refused: {owner.message_of(error)}'
            except Exception as error:  # noqa: BLE001 - a defect
                message = f'refused: {owner.stop_for(name, error)}'
            if hasattr(response, 'message'):
                response.message = message.removeprefix('refused: ')
            owner.inform(f'{name}: {shortened(message)}')
            return response

        service = node.create_service(kind, name, guarded)
        service.configure_introspection(node.get_clock(), TOLD, ServiceIntrospectionState.CONTENTS)
        self.add(lambda: node.destroy_service(service))

    def _require_active(self) -> None:
        if not self._owner.active:
            msg = f'{self._node.get_name()} is not active: activate it first'
            raise ConfigurationError(msg)
