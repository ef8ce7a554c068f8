"""The graph as the endpoint `/foxglove` sees it: bytes that nobody decodes, and what is asked.

What changes on the graph happens in the thread of the node, as all of rclpy; but what is said is
taken in the thread of the server, two hundred times a second, from subscriptions that no executor
knows: handing each message from one thread to the other would cost more than the message.
"""

from __future__ import annotations

import time
from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.bag.cdr.definitions import installed
from agv_motion.dashboard.foxglove.protocol import NO_GRAPH
from agv_motion.dashboard.foxglove.transforms import HOLD, DerivedTransforms
from agv_motion.nodes.foxglove_acts import FoxgloveActs
from agv_motion.nodes.foxglove_connections import connections
from agv_motion.nodes.foxglove_subscriptions import CLOCK, EVENTS, TYPES, GraphSubscriptions
from agv_motion.nodes.foxglove_topics import ServedTopics
from agv_motion.nodes.promise import guarded, promise
from agv_motion.ros.raw_subscription import ListenerNodes

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable, Iterator, Mapping

    from agv_motion.dashboard.foxglove.channels import GraphTopic
    from agv_motion.ros.live_port import LivePort

LOOK_PERIOD = 1.0
"""[s] between two looks at the graph, while somebody is there"""


class Watched(NamedTuple):
    """What clients want; see :meth:`GraphSource.watch`."""

    topics: frozenset[str] = frozenset()
    clients: bool = False
    parameters: bool = False
    connections: bool = False


class FoxgloveGraph:
    """Implements `GraphSource` on a graph."""

    def __init__(self, port: LivePort, publisher: Callable[[type[Any], str], Any]) -> None:
        """Look at nothing yet.

        Args:
            port: Of the node.
            publisher: Returns the one of a message class and a topic.

        """
        self._node = port.node
        listeners = ListenerNodes(f'{port.name}_foxglove', port.node.context)
        port.close_later(listeners.close)
        self._heard = GraphSubscriptions(listeners)
        self._acts = FoxgloveActs(port, publisher)
        self._transforms = DerivedTransforms(HOLD)
        self._served = ServedTopics(port.node, self._transforms)
        self.services: Mapping[str, str] = {}
        self.connections = NO_GRAPH
        self._watched = Watched()
        self._asked: deque[Callable[[], bool]] = deque()
        """each returns whether it is done, or must be tried again"""
        self._stale, self._looked_at = False, 0.0

    # In the thread of the server

    def watch(
        self, topics: frozenset[str], *, clients: bool, parameters: bool, connections: bool
    ) -> None:
        """Tell what is wanted; the thread of the node sees to it soon."""
        self._watched = Watched(topics, clients, parameters, connections)
        self._stale = True

    @property
    def topics(self) -> Mapping[str, GraphTopic]:
        """Those that are there, by name."""
        return self._served.found

    @property
    def complaints(self) -> Mapping[str, str]:
        """Why topics are not served, by name."""
        return self._served.complaints

    @property
    def simulated(self) -> bool:
        """Whether the time of the robots is a simulation's."""
        clock = self.topics.get(CLOCK)
        return clock is not None and clock.type == TYPES[CLOCK]

    def take(self) -> Iterator[tuple[str, int, bytes]]:
        """Yield topic, time of arrival [ns] and data of each message since the last time."""
        return self._transforms.passed(self._heard.arrived(), self._watched.topics)

    def time(self) -> int | None:
        """Return the robots' simulated time [ns]; None where time is real."""
        return self._heard.now if self.simulated else None

    def changed_parameters(self) -> Mapping[str, Any]:
        """Return what has changed since the last time."""
        return self._heard.changed_parameters()

    def prepare(self, topic: str, kind: str) -> asyncio.Future[str]:
        """Let who listens to a topic be found before something is published."""
        return self._ask(lambda: self._acts.prepare(topic, kind))

    def publish(self, topic: str, kind: str, data: bytes) -> asyncio.Future[str]:
        """Publish a message in CDR, in the thread of the node."""
        end = time.monotonic() + self._acts.patience
        return self._ask(lambda: self._acts.publish(topic, kind, data, end))

    def call(self, service: str, kind: str, data: bytes) -> asyncio.Future[bytes]:
        """Call a service with a request in CDR, in the thread of the node."""
        future, answer = promise()

        def begin() -> bool:
            self._acts.call(service, kind, data, answer)
            return True

        self._asked.append(guarded(begin, answer))
        return future

    @staticmethod
    def service_definitions(kind: str) -> tuple[str, str]:
        """Return the definitions of request and response of a type of service.

        Raises:
            ConfigurationError: It is not installed.

        """
        return installed(f'{kind}_Request').text, installed(f'{kind}_Response').text

    def _ask(self, act: Callable[[], bool]) -> asyncio.Future[str]:
        """Return what comes of an act, which is tried until it returns that it is done."""
        future, answer = promise()

        def tried() -> bool:
            done = act()
            if done:
                answer('')
            return done

        self._asked.append(guarded(tried, answer))
        return future

    # In the thread of the node

    def send(self) -> None:
        """Do what was asked; look at the graph when it is time to, while somebody is there."""
        now = time.monotonic()
        stale, self._stale = self._stale, False
        if self._watched.clients and now - self._looked_at >= LOOK_PERIOD:
            self._looked_at = now
            self._look()
            stale = True
        if stale:
            self._subscribe()
        for _ in range(len(self._asked)):
            act = self._asked.popleft()
            if not act():
                self._asked.append(act)
        self._acts.poll()

    def close(self) -> None:
        """Hear and ask no more."""
        self._heard.close()
        self._asked.clear()

    def _look(self) -> None:
        """Look which topics and services there are; hidden ones are none of a viewer's."""
        all_names = self._node.get_topic_names_and_types()
        names = [(name, types) for name, types in all_names if '/_' not in name]
        self._served.look(names)
        services = {
            name: types[0] for name, types in self._node.get_service_names_and_types()
            if len(types) == 1 and '/_' not in name
        }  # fmt: skip
        if services != self.services:
            self.services = services
        if self._watched.connections:
            self.connections = connections(self._node, names)

    def _subscribe(self) -> None:
        """Hear what is wanted, and nothing else."""
        watched, served = self._watched, self._served
        needed = self._transforms.needed(watched.topics)
        wanted = set((watched.topics | needed) & served.found.keys()) - served.derived.keys()
        if watched.clients and self.simulated:
            wanted.add(CLOCK)
        else:
            self._heard.now = None
        if watched.parameters and EVENTS in served.found:
            wanted.add(EVENTS)
        self._heard.hear(wanted, served)
