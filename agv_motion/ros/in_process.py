"""Nodes without middleware: the same classes, in a `World` instead of on a ROS graph.

`in_process(kind)` derives from a node class of this package one whose rclpy is the stand-in
`InProcessNode`; everything else, from parameters to lifecycle and refusals, is the node's own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.lifecycle import LifecycleNode

from agv_motion.errors import ConfigurationError
from agv_motion.ros.graph_guard import NoGraph
from agv_motion.ros.parameters import OF_THE_PLATFORM
from agv_motion.ros.world import Clock, Listener, Logger, Publisher, Timer, World, require_success

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from agv_motion.ros.node import ManagedNode

_Rclpy: Any = LifecycleNode
"""without its types: the stand-in takes less than rclpy does"""

OF_RCLPY = {'use_sim_time', 'autostart', 'executor'}
"""parameters that every live node has and that mean nothing here"""


def add(
    world: World,
    kind: type[ManagedNode[Any]],
    parameters: Mapping[str, Any],
    remap: Mapping[str, str],
    namespace: str = '/',
) -> Any:
    """Make a node in ``world`` and configure it.

    Args:
        world: Where it lives.
        kind: Class of the node.
        parameters: Values by dotted name; what is not a parameter of it is refused.
        remap: Full names of topics, by the full names that the node uses.
        namespace: Of the node, such as ``/oak``.

    Raises:
        ConfigurationError: A parameter is wrong, or the node cannot be configured.

    """
    node: Any = in_process(kind)(setup=Setup(world, dict(parameters), dict(remap), namespace))
    unknown = set(parameters) - node.declared - OF_RCLPY - OF_THE_PLATFORM
    if unknown:
        msg = f'{node.get_name()} has no parameter {", ".join(sorted(unknown))}'
        raise ConfigurationError(msg)
    require_success(node.on_configure(None), node)
    world.nodes.append(node)
    return node


class Setup(NamedTuple):
    """What a node in a world is made with."""

    world: World
    parameters: dict[str, Any]
    remap: dict[str, str]
    namespace: str = '/'


def full_name(topic: str, namespace: str) -> str:
    """Return the full name of a topic, which may be relative to a namespace."""
    return topic if topic.startswith('/') else f'{namespace.rstrip("/")}/{topic}'


class _Value(NamedTuple):
    value: Any


class InProcessNode(_Rclpy):
    """What a `ManagedNode` uses of rclpy, without it: stands before `LifecycleNode` in the MRO."""

    def __init__(self, name: str, *, setup: Setup) -> None:
        """Join a world, without a word to rclpy."""
        self.world, self._overrides, self._remap, self._own_namespace = setup
        self._own_name = name
        self.declared: set[str] = set()
        self.logger = Logger(name, self.world.complaints)
        self._world_clock = Clock(self.world)

    def get_name(self) -> str:
        """Return the name."""
        return self._own_name

    def get_namespace(self) -> str:
        """Return the namespace."""
        return self._own_namespace

    def get_logger(self) -> Any:
        """Return what keeps warnings."""
        return self.logger

    def get_clock(self) -> Any:
        """Return the world's clock."""
        return self._world_clock

    @property
    def services(self) -> list[Any]:
        """Return none."""
        return []

    @property
    def publishers(self) -> list[Publisher]:
        """All publishers of this node."""
        every = self.world.publishers.values()
        return [publisher for one in every for publisher in one if publisher.node is self]

    def declare_parameter(self, name: str, value: Any = None, *_: Any, **__: Any) -> Any:
        """Return the value that was given, which must be of the type of the default."""
        self.declared.add(name)
        given = self._overrides.get(name, value)
        if isinstance(given, list):
            given = tuple(given)
        if value is not None and type(given) is not type(value):
            msg = f'{name} = {given!r}: expected {type(value).__name__}, as {value!r}'
            raise ConfigurationError(msg)
        return _Value(given)

    def get_parameter(self, name: str) -> Any:
        """Return what was given for a parameter of rclpy's own; `use_sim_time` is false."""
        return _Value(self._overrides.get(name, False))

    def add_on_set_parameters_callback(self, _: Any) -> None:
        """Leave it: parameters stay as they are."""

    def resolve_topic_name(self, topic: str) -> str:
        """Return the full name of a topic."""
        return self._full(topic)

    def count_publishers(self, topic: str) -> int:
        """Return how many speak on a topic."""
        return len(self.world.publishers.get(self._full(topic), ()))

    def create_publisher(self, kind: type[Any], topic: str, qos: Any, **_: Any) -> Any:
        """Return a publisher in the world."""
        return Publisher(self, kind, self._full(topic), qos)

    def create_subscription(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], *_: Any, **__: Any
    ) -> Any:
        """Return a listener in the world."""
        listener = Listener(self, kind, callback)
        self.world.listeners.setdefault(self._full(topic), []).append(listener)
        return listener

    def listener(self, topic: str) -> Listener:
        """Return the node's own end of a topic."""
        return next(one for one in self.world.listeners[self._full(topic)] if one.node is self)

    def create_timer(self, seconds: float, callback: Any, *_: Any, **__: Any) -> Any:
        """Return a timer of the world, whatever clock was asked for: there is one time."""
        timer = Timer(seconds, callback)
        self.world.add_timer(timer)
        return timer

    def create_service(self, *_: Any, **__: Any) -> Any:
        """Return nothing: nobody is there to ask."""

    def destroy_timer(self, timer: Timer) -> bool:
        """Let a timer run no more."""
        timer.callback = None
        return True

    def destroy_publisher(self, publisher: Publisher) -> bool:
        """Leave the topic."""
        self.world.publishers[publisher.topic].remove(publisher)
        return True

    def destroy_subscription(self, listener: Listener) -> bool:
        """Hear no more."""
        for listeners in self.world.listeners.values():
            if listener in listeners:
                listeners.remove(listener)
        return True

    def destroy_service(self, _: Any) -> bool:
        """Leave it."""
        return True

    def _full(self, topic: str) -> str:
        if topic.startswith('~'):
            topic = f'{self._own_name}{topic[1:]}'
        full = full_name(topic, self._own_namespace)
        return self._remap.get(full, full)


def _seconds(node: InProcessNode) -> float:
    """Return the time of the world [s]."""
    return float(node.world.now) * 1e-9


def _trust(node: ManagedNode[Any]) -> None:
    """Believe the clock of the world."""
    node.clock.fault = ''


def _stamp(node: InProcessNode, message: Any) -> float:
    """Set the stamp of a message's header to the time of the world; return it [s]."""
    stamp, now = message.header.stamp, node.world.now
    stamp.sec, stamp.nanosec = divmod(now, 1_000_000_000)
    return float(now) * 1e-9


class _Every:
    """Tells each refusal: the world counts them itself."""

    def line(self, reason: str, _: float) -> str:
        """Return the reason."""
        return reason


def _raise(_: Any, __: str, error: Exception) -> None:
    raise error


def in_process(kind: type[ManagedNode[Any]]) -> type[Any]:
    """Return the class of nodes of ``kind`` that live in a :class:`World`."""
    return type(
        kind.__name__,
        (kind, InProcessNode),
        {
            # what nodes ask most often, without an object for each answer
            'seconds': _seconds,
            'steady_seconds': _seconds,
            'nanoseconds': lambda node: node.world.now,
            'stamp': _stamp,
            # ManagedNode looks at its clock beside a steady one, and publishes diagnostics every
            # second of that; here there is one clock, which is always right, and nobody to look
            '_steady': property(InProcessNode.get_clock, lambda *_: None),
            '_start_watch': _trust,
            '_graph': property(lambda _: NoGraph(), lambda *_: None),
            '_refusals': property(lambda _: _Every(), lambda *_: None),
            # a defect ends a reprocessing at once
            'stop_for': _raise,
        },
    )
