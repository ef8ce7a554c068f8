"""A script's place on the ROS graph: what a robot says, newest only, and what is said to it.

It has a context and a thread of its own: a script need neither call `rclpy.init` nor spin. Every
wait has a limit by the steady clock.
"""

from __future__ import annotations

import atexit
import os
import threading
import time
from typing import TYPE_CHECKING, Any, NamedTuple

import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.executors import SingleThreadedExecutor
from rclpy.experimental import EventsExecutor

from agv_motion.errors import SourceError
from agv_motion.ros.context import begin_context
from agv_motion.ros.ends import NO_EVENTS
from agv_motion.ros.qos import COMMAND
from agv_motion.ros.remote_services import UnansweredError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from rclpy.qos import QoSProfile

LOOK = 0.1
"""[s] between two looks at what does not come by itself: silence, standing, who is on the graph"""


class Heard(NamedTuple):
    """The newest message of a topic."""

    message: Any
    at: float
    """when it came, by the steady clock [s]"""


class ScriptLink:
    """Topics and services of one robot; what calls back is opened before the thread begins."""

    def __init__(self, namespace: str, domain: int | None = None) -> None:
        """Join the graph.

        Args:
            namespace: Of the robot, such as ``/oak``; empty for none.
            domain: ROS domain; None: that of the environment.

        """
        context = rclpy.Context()
        begin_context(args=[], context=context, domain_id=domain)
        name = f'_agv_client_{os.getpid()}_{id(self) % 100000}'
        self.node = rclpy.create_node(
            name, namespace=namespace, context=context, start_parameter_services=False
        )
        self.news = threading.Condition()
        """Held while anything that was heard is looked at; notified when there is more."""
        self._clients: dict[str, Any] = {}
        self._publishers: dict[str, Any] = {}
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._spin, name=name, daemon=True)

    def hear(
        self, kind: type[Any], topic: str, qos: QoSProfile, take: Callable[[Heard], None]
    ) -> None:
        """Let ``take`` get each message of a topic, with `news` held."""

        def receive(message: Any) -> None:
            with self.news:
                take(Heard(message, time.monotonic()))
                self.news.notify_all()

        self.node.create_subscription(
            kind,
            topic,
            receive,
            qos,
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )

    def know(self, kind: type[Any], services: Iterable[str]) -> None:
        """Look for services of a class, so that they can be called."""
        self._clients |= {name: self.node.create_client(kind, name) for name in services}

    def start(self, look: Callable[[float], None]) -> None:
        """Begin to hear; ``look`` is called with the steady time now and then, `news` held."""

        def tick() -> None:
            with self.news:
                look(time.monotonic())
                self.news.notify_all()

        self.node.create_timer(LOOK, tick, clock=Clock(clock_type=ClockType.STEADY_TIME))
        self._executor = _executor(self.node.context)
        self._executor.add_node(self.node)
        self._thread.start()
        atexit.register(self.close)

    def has(self, service: str) -> bool:
        """Return whether somebody offers a service, and is found."""
        self._require_open()
        return bool(self._clients[service].service_is_ready())

    def speak(self, kind: type[Any], topic: str) -> Any:
        """Return a topic on which to say something, opened when it is first needed."""
        self._require_open()
        if topic not in self._publishers:
            self._publishers[topic] = self.node.create_publisher(
                kind, topic, COMMAND, event_callbacks=NO_EVENTS
            )
        return self._publishers[topic]

    def publish(self, topic: str, message: Any, patience: float) -> None:
        """Say something to whoever listens.

        Raises:
            SourceError: Nobody does within ``patience`` [s].

        """
        publisher = self.speak(type(message), topic)
        if not self.wait(lambda: publisher.get_subscription_count() > 0, patience):
            msg = f'nobody listens on {publisher.topic_name}: start its node, and activate it'
            raise SourceError(msg)
        publisher.publish(message)

    def ask(self, service: str, request: Any, patience: float) -> Any:
        """Return the response of a service.

        Raises:
            UnansweredError: It is not there, or does not answer within ``patience`` [s].

        """
        self._require_open()
        end, client = time.monotonic() + patience, self._clients[service]
        if not self.wait(client.service_is_ready, patience):
            msg = f'the service {client.srv_name} was not there within {patience:g} s'
            raise UnansweredError(msg)
        future = self.ask_only(service, request)
        if not self.wait(future.done, max(end - time.monotonic(), LOOK)):
            client.remove_pending_request(future)
            msg = f'the service {client.srv_name} did not answer within {patience:g} s'
            raise UnansweredError(msg)
        if future.exception() is not None:
            msg = f'the service {client.srv_name}: {future.exception()}'
            raise UnansweredError(msg)
        return future.result()

    def ask_only(self, service: str, request: Any) -> Any:
        """Call a service, and do not wait for its answer."""
        future = self._clients[service].call_async(request)
        future.add_done_callback(lambda _: self._notify())
        return future

    def wait(self, condition: Callable[[], bool], seconds: float) -> bool:
        """Wait until ``condition()``, asked with `news` held, but no longer than ``seconds``.

        Raises:
            SourceError: The link is closed.

        """
        end = time.monotonic() + seconds
        with self.news:
            while not condition():
                self._require_open()
                left = end - time.monotonic()
                if left <= 0.0:
                    return False
                self.news.wait(min(left, LOOK))
            return True

    def close(self) -> None:
        """Leave the graph; a second time does nothing."""
        if self._ended.is_set():
            return
        atexit.unregister(self.close)
        self._ended.set()
        self._thread.join()
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.node.context)

    def _require_open(self) -> None:
        if self._ended.is_set():
            msg = 'the robot was closed: make another'
            raise SourceError(msg)

    def _notify(self) -> None:
        with self.news:
            self.news.notify_all()

    def _spin(self) -> None:
        while not self._ended.is_set():
            self._executor.spin_once(timeout_sec=LOOK)


def _executor(context: Any) -> Any:
    """Return the executor of live nodes, or the usual one where that cannot be made.

    It wants a real file as stderr, for the traces of a crash; a notebook has none.
    """
    try:
        return EventsExecutor(context=context)
    except (OSError, ValueError, AttributeError, RuntimeError):
        return SingleThreadedExecutor(context=context)
