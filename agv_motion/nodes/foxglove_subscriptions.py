"""What the endpoint `/foxglove` hears: bytes that nobody decodes, the clock, changed parameters."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Any

from rclpy.parameter import parameter_value_to_python

from agv_motion.errors import AgvMotionError
from agv_motion.ros.cdr import codec
from agv_motion.ros.channel_subscription import ChannelSubscription
from agv_motion.ros.endpoints import message_class

if TYPE_CHECKING:
    from collections.abc import Iterator
    from collections.abc import Set as AbstractSet

    from agv_motion.nodes.foxglove_topics import ServedTopics
    from agv_motion.ros.raw_subscription import ListenerNodes

CLOCK, EVENTS = '/clock', '/parameter_events'
TYPES = {CLOCK: 'rosgraph_msgs/msg/Clock', EVENTS: 'rcl_interfaces/msg/ParameterEvent'}
SECOND = 1_000_000_000


class GraphSubscriptions:
    """Opened and closed in the thread of the node, taken from in that of the server."""

    def __init__(self, listeners: ListenerNodes) -> None:
        """Hear nothing yet."""
        self._listeners = listeners
        self._open: dict[str, ChannelSubscription] = {}
        self._taken: tuple[tuple[str, ChannelSubscription], ...] = ()
        self.now: int | None = None
        """[ns] simulated time; None while no clock is heard"""
        self._changed: dict[str, Any] = {}

    def hear(self, wanted: AbstractSet[str], topics: ServedTopics) -> None:
        """Hear what is wanted of the topics that were found, and nothing else."""
        for name in self._open.keys() - wanted:
            self._open.pop(name).close()
        for name in wanted:
            if name not in self._open:
                kind = message_class(topics.found[name].type)
                self._open[name] = ChannelSubscription(self._listeners.node(0), name, kind)
            self._open[name].meet(topics.publishers(name))
        self._taken = tuple(sorted(self._open.items(), key=lambda item: item[0] != CLOCK))

    def arrived(self) -> Iterator[tuple[str, int, bytes]]:
        """Yield topic, time of arrival [ns] and data of each message since the last time."""
        for topic, subscription in self._taken:
            heard = topic in TYPES
            for data, received in subscription.take():
                if heard:
                    self._hear(topic, data)
                yield topic, received if self.now is None else self.now, data

    def changed_parameters(self) -> dict[str, Any]:
        """Return what has changed since the last time: ``/node.parameter`` and its value."""
        changed, self._changed = self._changed, {}
        return changed

    def close(self) -> None:
        """Hear no more."""
        self._taken = ()
        for subscription in self._open.values():
            subscription.close()
        self._open.clear()

    def _hear(self, topic: str, data: bytes) -> None:
        """Take a tick of the clock, or what has become of parameters."""
        with suppress(AgvMotionError):  # a message that is none changes nothing
            message = codec(message_class(TYPES[topic])).decode(data)
            if topic == CLOCK:
                self.now = max(message.clock.sec * SECOND + message.clock.nanosec, 0)
                return
            for one in (*message.new_parameters, *message.changed_parameters):
                value = parameter_value_to_python(one.value)
                self._changed[f'{message.node}.{one.name}'] = _plain(value)


def _plain(value: Any) -> Any:
    """Return the value of a parameter as JSON has it."""
    if isinstance(value, (bytes, bytearray)):
        return list(value)
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    return [one[0] if isinstance(one, bytes) else one for one in value]
