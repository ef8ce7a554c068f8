"""Anybody's node of rclpy as a member of an `InProcessGraph`.

The node is made as it is made live, from its class without arguments; only where it would speak to
the middleware it gets a stand-in, and its clock tells the time of the recording.
"""

from __future__ import annotations

import importlib
import random
import re
import sys
from typing import TYPE_CHECKING, Any

from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile

from agv_motion.errors import ConfigurationError
from agv_motion.reprocess.foreign import refusal
from agv_motion.reprocess.foreign.foreign_port import ForeignPort, where
from agv_motion.reprocess.foreign.refusal import KEEPS, refuse, refusing
from agv_motion.reprocess.foreign.stand_ins import (
    ForeignPublisher,
    ForeignSubscription,
    ForeignTimer,
    NoPublisher,
)
from agv_motion.ros.in_process_port import Place
from agv_motion.ros.suggestion import meant

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from agv_motion.ros.in_process_graph import InProcessGraph

INTERNAL = '/parameter_events'


class ForeignNode:
    """A node of the graph; made from ``package.module:Class``."""

    def __init__(
        self, graph: InProcessGraph, target: str, namespace: str, remap: Mapping[str, str],
        given: Callable[[str], Mapping[str, Any]],
    ) -> None:  # fmt: skip
        """Import the class anew and make the node.

        Args:
            graph: Where it lives.
            target: ``package.module:Class``.
            namespace: Of the node, such as ``/oak``.
            remap: Full names of topics, by the full names that the node uses.
            given: Returns the parameters of a node by its full name.

        Raises:
            ConfigurationError: There is no such class, or it is no node.

        """
        self.target = target
        self.port = ForeignPort(graph)
        module, _, name = target.partition(':')
        package = module.partition('.')[0]
        refusal.watch(package)
        _forget(package)
        random.seed(0)
        _seed_numpy()
        kind = _class(module, name)
        self.context = Context()
        self.context.init()
        try:
            self.node = _made(kind, self.port, self.context, (namespace, remap), given)
        except BaseException:
            self.context.try_shutdown()
            raise
        graph.nodes.append(self)

    def activate(self) -> None:
        """Leave it: a node acts from its constructor on."""

    def deactivate(self) -> None:
        """End the node."""
        self.port.active = False
        self.node.destroy_node()
        self.context.try_shutdown()


def _made(
    kind: type[Any], port: ForeignPort, context: Context, place: tuple[str, Mapping[str, str]],
    given: Callable[[str], Mapping[str, Any]],
) -> Any:  # fmt: skip
    """Return a node of a class, its ends on the graph."""
    namespace, remap = place

    class Standing(kind):
        """The node, with its hands tied."""

    _tie(Standing, port)
    original = Node.__init__

    def begin(self: Any, node_name: str, **options: Any) -> None:
        options.pop('cli_args', None)
        own = str(options.pop('namespace', None) or '').strip('/')
        whole = '/' + '/'.join(part for part in (namespace.strip('/'), own) if part)
        port.name, port.place = node_name, Place(node_name, whole, remap)
        values = {p.name: p for p in options.pop('parameter_overrides', None) or ()}
        found = given(f'{whole.rstrip("/")}/{node_name}')
        fixed = {'use_sim_time': False, 'start_type_description_service': False}
        for name, value in {**found, **fixed}.items():
            values[name] = Parameter(name, value=value)
        options |= {'context': context, 'use_global_arguments': False, 'enable_rosout': False}
        options |= {'start_parameter_services': False, 'enable_logger_service': False}
        original(
            self, node_name, namespace=whole, parameter_overrides=list(values.values()), **options
        )
        port.clock = self._clock
        port.clock.is_recorded = True
        port.clock._set_ros_time_is_active(True)  # noqa: FBT003, SLF001 - what /clock would do
        port.tell_time()

    Node.__init__ = begin  # type: ignore[method-assign]
    try:
        node = Standing()
    except TypeError as error:
        msg = f'{kind.__module__}:{kind.__name__} cannot be made without arguments: {where(error)}'
        raise ConfigurationError(msg) from error
    finally:
        Node.__init__ = original  # type: ignore[method-assign]
    if port.clock is None:
        msg = f'{kind.__module__}:{kind.__name__} did not call super().__init__(name)'
        raise ConfigurationError(msg)
    return node


def _tie(standing: Any, port: ForeignPort) -> None:
    """Put stand-ins into the methods of a class of nodes."""
    make = ForeignEnds(port)
    standing.create_publisher = lambda _, *args, **options: make.publisher(*args, **options)
    standing.create_subscription = lambda _, *args, **options: make.subscription(*args, **options)
    standing.create_timer = lambda _, *args, **options: make.timer(*args, **options)
    standing.count_publishers = lambda _, topic: make.count_publishers(topic)
    for what in ('publisher', 'subscription', 'timer'):
        setattr(standing, f'destroy_{what}', _destroy)
    standing.create_service = refusing('offers a service')
    standing.create_client = refusing('has a client of a service')
    standing.create_guard_condition = refusing('has a guard condition')
    standing.create_rate = refusing('sleeps by a rate', 'use a timer')
    graph = [name for name in dir(Node) if re.match(r'get_.*(_names|_by_topic)', name)]
    for name in (*graph, 'count_subscribers', 'count_clients', 'count_services'):
        setattr(standing, name, refusing('looks at the graph'))


class ForeignEnds:
    """Makes the stand-ins of a node."""

    def __init__(self, port: ForeignPort) -> None:
        """Make nothing yet."""
        self._port = port

    def publisher(self, msg_type: Any, topic: str, qos_profile: Any, **_: Any) -> Any:
        """Return a publisher."""
        if topic == INTERNAL:
            return NoPublisher()
        full = self._port.place.full_name(topic)
        return ForeignPublisher(self._port, msg_type, full, _qos(qos_profile))

    def subscription(
        self, msg_type: Any, topic: str, callback: Any, qos_profile: Any,
        *, raw: bool = False, **_: Any,
    ) -> ForeignSubscription:  # fmt: skip
        """Return a subscription."""
        full = self._port.place.full_name(topic)
        one = ForeignSubscription(self._port, msg_type, full, callback, raw=raw)
        one.qos_profile = _qos(qos_profile)
        self._port.graph.listeners.setdefault(full, []).append(one)
        return one

    def timer(
        self, timer_period_sec: float, callback: Any, *_: Any, autostart: bool = True, **__: Any
    ) -> ForeignTimer:
        """Return a timer."""
        return ForeignTimer(self._port, timer_period_sec, callback, autostart=autostart)

    def count_publishers(self, topic: str) -> int:
        """Return how many speak on a topic, the recording included."""
        full, graph = self._port.place.full_name(topic), self._port.graph
        return len(graph.publishers.get(full, ())) + (full in graph.recorded)


def _destroy(_: Any, one: Any) -> bool:
    one.destroy()
    return True


def _class(module: str, name: str) -> type[Any]:
    """Return a class of nodes.

    Raises:
        ConfigurationError: It is not there, or is none.

    """
    try:
        found = importlib.import_module(module)
    except ImportError as error:
        msg = f'--node {module}:{name} cannot be imported ({error}): install what it needs'
        raise ConfigurationError(msg) from error
    kind: Any = getattr(found, name, None)
    nodes = sorted(n for n, one in vars(found).items() if _is_node(one) and one is not Node)
    if not _is_node(kind):
        there = f'it has {", ".join(nodes)}' if nodes else 'it has no node'
        hint = meant(name, nodes)
        msg = f"--node {module}:{name}: there is no class of nodes '{name}'{hint}; {there}"
        raise ConfigurationError(msg)
    if any(base.__name__ == 'LifecycleNodeMixin' for base in kind.__mro__):
        refuse('is a lifecycle node, which waits for services', KEEPS)
    node: type[Any] = kind
    return node


def _is_node(one: Any) -> bool:
    return isinstance(one, type) and issubclass(one, Node)


def _forget(package: str) -> None:
    """Let a package be imported anew: what it had remembered of another bag is gone."""
    for name in [name for name in sys.modules if name.partition('.')[0] == package]:
        del sys.modules[name]


def _seed_numpy() -> None:
    import numpy as np

    np.random.seed(0)  # noqa: NPY002 - the generator that old code uses


def _qos(given: Any) -> QoSProfile:
    return given if isinstance(given, QoSProfile) else QoSProfile(depth=int(given))
