"""The graph as the endpoint `/foxglove` sees it: bytes that nobody decodes, and what is asked.

What changes on the graph happens in the thread of the node, as all of rclpy; but what is said is
taken in the thread of the server, two hundred times a second, from subscriptions that no executor
knows: handing each message from one thread to the other would cost more than the message.
"""

from __future__ import annotations

import time
from collections import deque
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from rclpy.parameter import parameter_value_to_python

from agv_motion.bag.cdr.definitions import installed
from agv_motion.dashboard.foxglove.channels import GraphTopic
from agv_motion.dashboard.foxglove.protocol import NO_GRAPH
from agv_motion.dashboard.foxglove.transforms import HOLD, DerivedTransforms
from agv_motion.errors import AgvMotionError, ConfigurationError
from agv_motion.nodes.foxglove_acts import FoxgloveActs
from agv_motion.nodes.foxglove_connections import connections
from agv_motion.nodes.promise import guarded, promise
from agv_motion.ros.cdr import codec
from agv_motion.ros.channel_subscription import ChannelSubscription, terms
from agv_motion.ros.endpoints import message_class
from agv_motion.ros.raw_subscription import ListenerNodes

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable, Iterator, Mapping

    from agv_motion.ros.live_port import LivePort

LOOK_PERIOD = 1.0
"""[s] between two looks at the graph, while somebody is there"""
IN_TURN = 5
"""topics of each look that are asked for though the number of their publishers is the same"""
CLOCK, EVENTS = '/clock', '/parameter_events'
TYPES = {CLOCK: 'rosgraph_msgs/msg/Clock', EVENTS: 'rcl_interfaces/msg/ParameterEvent'}
SECOND = 1_000_000_000


class FoxgloveGraph:
    """Implements `GraphSource` on a graph."""

    def __init__(self, port: LivePort, publisher: Callable[[type[Any], str], Any]) -> None:
        """Look at nothing yet.

        Args:
            port: Of the node.
            publisher: Returns the one of a message class and a topic.

        """
        self._port, self._node = port, port.node
        self._listeners = ListenerNodes(f'{port.name}_foxglove', port.node.context)
        port.close_later(self._listeners.close)
        self._acts = FoxgloveActs(port, publisher)
        self._transforms = DerivedTransforms(HOLD)
        self.topics: Mapping[str, GraphTopic] = {}
        self.services: Mapping[str, str] = {}
        self.complaints: Mapping[str, str] = {}
        self.connections = NO_GRAPH
        self.simulated = False
        self._offered: dict[str, GraphTopic] = {}
        self._publishers: dict[str, list[Any]] = {}
        self._wanted: frozenset[str] = frozenset()
        self._watched = (False, False, False)
        """whether there is a client, one that watches parameters, one that watches connections"""
        self._open: dict[str, ChannelSubscription] = {}
        self._taken: tuple[tuple[str, ChannelSubscription], ...] = ()
        self._now: int | None = None
        self._changed: dict[str, Any] = {}
        self._asked: deque[Callable[[], bool]] = deque()
        """each returns whether it is done, or must be tried again"""
        self._stale, self._looked_at, self._turn = False, 0.0, 0

    # In the thread of the server

    def watch(
        self, topics: frozenset[str], *, clients: bool, parameters: bool, connections: bool
    ) -> None:
        """Tell what is wanted; the thread of the node sees to it soon."""
        self._wanted = topics
        self._watched = clients, parameters, connections
        self._stale = True

    def take(self) -> Iterator[tuple[str, int, bytes]]:
        """Yield topic, time of arrival [ns] and data of each message since the last time."""
        return self._transforms.passed(self._arrived(), self._wanted)

    def _arrived(self) -> Iterator[tuple[str, int, bytes]]:
        for topic, subscription in self._taken:
            heard = topic in TYPES
            for data, received in subscription.take():
                if heard:
                    self._hear(topic, data)
                yield topic, received if self._now is None else self._now, data

    def time(self) -> int | None:
        """Return the robots' simulated time [ns]; None where time is real."""
        return self._now if self.simulated else None

    def changed_parameters(self) -> Mapping[str, Any]:
        """Return what has changed since the last time."""
        changed, self._changed = self._changed, {}
        return changed

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

    def _hear(self, topic: str, data: bytes) -> None:
        """Take a tick of the clock, or what has become of parameters."""
        with suppress(AgvMotionError):  # a message that is none changes nothing
            message = codec(message_class(TYPES[topic])).decode(data)
            if topic == CLOCK:
                self._now = max(message.clock.sec * SECOND + message.clock.nanosec, 0)
                return
            for one in (*message.new_parameters, *message.changed_parameters):
                value = parameter_value_to_python(one.value)
                self._changed[f'{message.node}.{one.name}'] = _plain(value)

    # In the thread of the node

    def send(self) -> None:
        """Do what was asked; look at the graph when it is time to, while somebody is there."""
        now = time.monotonic()
        stale, self._stale = self._stale, False
        if self._watched[0] and (now - self._looked_at >= LOOK_PERIOD):
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
        self._taken = ()
        self._asked.clear()
        for subscription in self._open.values():
            subscription.close()
        self._open.clear()

    def _look(self) -> None:
        """Look which topics and services there are."""
        found: dict[str, GraphTopic] = {}
        complaints: dict[str, str] = {}
        names = self._node.get_topic_names_and_types()
        self._turn = (self._turn + IN_TURN) % max(len(names), 1)
        for place, (name, types) in enumerate(names):
            in_turn = (place - self._turn) % len(names) < IN_TURN
            publishers = self._publishers_of(name, again=in_turn)
            if not publishers:
                continue
            try:
                found[name] = _topic(name, types, publishers)
            except ConfigurationError as error:
                complaints[name] = str(error)
        services = {
            name: types[0] for name, types in self._node.get_service_names_and_types()
            if len(types) == 1 and '/_' not in name
        }  # fmt: skip
        self._offered = self._transforms.offered(found)
        found |= self._offered
        if found != self.topics:
            self.topics = found
        if complaints != self.complaints:
            self.complaints = complaints
        if services != self.services:
            self.services = services
        self.simulated = found[CLOCK].type == TYPES[CLOCK] if CLOCK in found else False
        if self._watched[2]:
            self.connections = connections(self._node, names)

    def _publishers_of(self, name: str, *, again: bool) -> list[Any]:
        """Return who publishes a topic; asked for where their number has changed, or ``again``."""
        count, known = self._node.count_publishers(name), self._publishers.get(name, [])
        if count != len(known) or (again and count):
            known = self._publishers[name] = self._node.get_publishers_info_by_topic(name)
        return known

    def _subscribe(self) -> None:
        """Hear what is wanted, and nothing else."""
        clients, parameters, _ = self._watched
        needed = self._transforms.needed(self._wanted)
        wanted = set((self._wanted | needed) & self.topics.keys()) - self._offered.keys()
        if clients and self.simulated:
            wanted.add(CLOCK)
        else:
            self._now = None
        if parameters and EVENTS in self.topics:
            wanted.add(EVENTS)
        for name in self._open.keys() - wanted:
            self._open.pop(name).close()
        for name in wanted:
            kind = self.topics[name].type
            if name not in self._open:
                node = self._listeners.node(0)
                self._open[name] = ChannelSubscription(node, name, message_class(kind))
            self._open[name].meet([p for p in self._publishers[name] if p.topic_type == kind])
        self._taken = tuple(sorted(self._open.items(), key=lambda item: item[0] != CLOCK))


def _topic(name: str, types: list[str], publishers: list[Any]) -> GraphTopic:
    """Return what clients are told of a topic.

    Raises:
        ConfigurationError: It has several types, or one that is not installed.

    """
    if len(types) != 1:
        msg = f'it has the types {", ".join(sorted(types))}: only one can be served'
        raise ConfigurationError(msg)
    (kind,) = types
    message_class(kind)
    slots, latched = terms(publishers)
    return GraphTopic(name, kind, installed(kind).text, slots, latched)


def _plain(value: Any) -> Any:
    """Return the value of a parameter as JSON has it."""
    if isinstance(value, (bytes, bytearray)):
        return list(value)
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    return [one[0] if isinstance(one, bytes) else one for one in value]
