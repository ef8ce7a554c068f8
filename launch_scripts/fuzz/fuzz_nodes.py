"""The doors of the nodes: messages, services and parameters, given to nodes without middleware."""

from __future__ import annotations

import tempfile
from array import array
from contextlib import suppress
from functools import cache, partial
from math import cos, inf, nan, sin
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rosidl_parser.definition import AbstractSequence, Array, BasicType, NamespacedType

from agv_motion.errors import AgvMotionError
from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.nodes.differential_simulator import DifferentialSimulator
from agv_motion.nodes.ghost_trajectory import GhostTrajectory
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.nodes.omni_simulator import OmniSimulator
from agv_motion.nodes.route_follower import RouteFollowerNode
from agv_motion.nodes.sequence import SequenceNode
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.parameters import nested, rows
from agv_motion.ros.cdr import codec
from agv_motion.ros.endpoints import message_class
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.messages import stamp_of

if TYPE_CHECKING:
    import random
    from collections.abc import Callable, Iterator

NOW = 1_434_366_000_000_000_000
HOSTILE = (
    *(nan, inf, -inf, 0.0, -0.0, 1.0, -1.0, 5e-324, 1e-300, 1e308, -1e308, 1e154, 1e100, 1e20),
    *(9e15, -9e15, 2.0**31, 2.0**63, 1e9, 24.0, 1e-9),
)
MAY_BE_MISSING = ('temperature', 'illuminance')
"""fields that are NaN where there is no reading"""
TEXTS = ('', 'map', 'odom', 'base_link', 'oak', 'ash', '\0', 'x' * 5000, '\U0001f600', "'; [bold]")
CLAIM = '{"journey": 3, "heard": {"oak": 7}, "parked": false}'

ZONE = 'boundary: [[0, 0], [12, 0], [12, 9], [0, 9]]\nmargin: 0.3\n'
SEQUENCE = 'actions:\n  - go_to: {x: 2.0, y: 1.0, heading: 90}\n  - rotate: {by: 90}\n  - wait: 1\n'
KINDS: dict[str, tuple[Any, dict[str, Any]]] = {
    'arbiter': (ArbiterNode, {'limits.linear_acceleration': 1.0, 'limits.turn_rate': 2.0}),
    'differential_kinematics': (DifferentialKinematics, {}),
    'differential_simulator': (DifferentialSimulator, {}),
    'ghost_trajectory': (GhostTrajectory, {}),
    'granier_probe': (GranierProbe, {}),
    'localization': (Localization, {}),
    'motion_generator': (MotionGenerator, {'goal': (5.0, 5.0)}),
    'motion_generator sharing': (
        MotionGenerator, {'share_zone': True, 'tree_name': 'oak', 'traffic.expected': ('ash',)},
    ),
    'omni_kinematics': (OmniKinematics, {}),
    'omni_simulator': (OmniSimulator, {}),
    'route_follower': (RouteFollowerNode, {}),
    'sequence': (SequenceNode, {}),
    'simulator': (Simulator, {}),
    'wheel_kinematics': (
        WheelKinematics, {'turret_x': (0.5, -0.5), 'turret_y': (0.0, 0.0)},
    ),
}  # fmt: skip
"""nodes and what they are started with"""


class NotFiniteError(Exception):
    """A number came out that is none."""


class Home:
    """A node in a graph of its own, begun anew when it has seen enough or has ended."""

    def __init__(self, name: str, folder: Path) -> None:
        """Start the node."""
        self.name, self.folder = name, folder
        self.begin()

    def begin(self) -> None:
        """Make a node and activate it."""
        kind, given = KINDS[self.name]
        files = {
            'motion_generator': {'zone_file': str(self.folder / 'zone.yaml')},
            'sequence': {'file': str(self.folder / 'sequence.yaml')},
        }.get(self.name.split()[0], {})
        self.seen = 0
        self.graph = InProcessGraph(self._check, NOW)
        self.node = InProcessNode(self.graph, kind, given | files)
        self.services = list(self.node.port.services.values())
        self.graph.start()
        self.topics = {
            topic: next(one for one in found if one.port is self.node.port)
            for topic, found in self.graph.listeners.items()
            if any(one.port is self.node.port for one in found)
        }

    def hear(self, topic: str, data: bytes, later: int) -> None:
        """Let a message come, and time pass; a node that has ended begins anew."""
        self.seen += 1
        if self.seen % 1000 == 0:
            self.begin()
        try:
            self.graph.feed(topic, self.graph.now, data)
            self.graph.run(self.graph.now + later)
            self.graph.now += later
        except BaseException:
            self.begin()
            raise

    def ask(self, act: Any, request: Any) -> None:
        """Ask for a service."""
        try:
            with suppress(AgvMotionError):
                act(request)
            self.graph.run(self.graph.now + 50_000_000)
        except BaseException:
            self.begin()
            raise

    def change(self, changes: dict[str, Any]) -> None:
        """Change parameters as a client would."""
        try:
            with suppress(AgvMotionError, TypeError):
                self.node.set_parameters(changes)
            self.graph.run(self.graph.now + 50_000_000)
        except BaseException:
            self.begin()
            raise

    def _check(self, publisher: Any, _: int, data: Any) -> None:
        if type(data) is bytes:
            wrong = not_finite(codec(publisher.kind).decode(data), '')
            if wrong:
                msg = f'{publisher.topic}{wrong}'
                raise NotFiniteError(msg)


def not_finite(value: Any, name: str) -> str:
    """Return the name of a number in a message that is none, empty if all are."""
    if isinstance(value, float):
        fine = -inf < value < inf or name.rpartition('.')[2] in MAY_BE_MISSING
        return '' if fine else f'{name} = {value}'
    if hasattr(value, 'get_fields_and_field_types'):
        parts = ((getattr(value, field), f'{name}.{field}') for field in _fields(type(value)))
    elif isinstance(value, (list, tuple, array)) or type(value).__name__ == 'ndarray':
        parts = ((item, f'{name}') for item in value)
    else:
        return ''
    return next(filter(None, (not_finite(part, inner) for part, inner in parts)), '')


@cache
def _fields(kind: Any) -> tuple[tuple[str, Any], ...] | Any:
    return tuple(kind.get_fields_and_field_types())


class Maker:
    """Makes plausible messages in which each field is hostile with a certain probability."""

    def __init__(self, rng: random.Random, names: tuple[str, ...], now: int) -> None:
        """Make messages for a node that knows joints of such names, about a time [ns]."""
        self.rng, self.names, self.now = rng, names, now
        self.share = rng.choice((0.0, 0.01, 0.03, 0.3))

    def message(self, kind: Any) -> Any:
        """Return a message of a class."""
        made = kind()
        for field, slot in zip(_fields(kind), kind.SLOT_TYPES, strict=True):
            setattr(made, field, self._value(field, slot))
        if kind.__name__ == 'Time' and not self._wild():
            return stamp_of(self.now + self.rng.choice((0, 0, 0, -(10**7), 10**8)))
        if kind.__name__ == 'Quaternion' and not self._wild():
            angle = self.rng.uniform(-4.0, 4.0)
            made.x = made.y = 0.0
            made.z, made.w = sin(angle / 2.0), cos(angle / 2.0)
        return made

    def _wild(self) -> bool:
        return self.rng.random() < self.share

    def _value(self, field: str, slot: Any) -> Any:
        if isinstance(slot, NamespacedType):
            return self.message(message_class('/'.join((*slot.namespaces, slot.name))))
        if isinstance(slot, Array):
            return [self._value(field, slot.value_type) for _ in range(slot.size)]
        if isinstance(slot, AbstractSequence):
            return self._sequence(field, slot)
        if isinstance(slot, BasicType):
            return self._number(slot.typename)
        if self._wild():
            return self.rng.choice(TEXTS)
        return CLAIM if field == 'text' else self.rng.choice(TEXTS[1:4])

    def _sequence(self, field: str, slot: Any) -> Any:
        if field == 'name' and not self._wild():
            return list(self.names)
        size = 3 if field == 'markers' else max(len(self.names), 2)
        if self._wild():
            size = self.rng.choice((0, 1, 2, 3, 30))
        found = [self._value(field, slot.value_type) for _ in range(size)]
        if field == 'markers' and not self._wild():
            for i, marker in enumerate(found):
                marker.ns, marker.id = 'ash', i
        return found

    def _number(self, kind: str) -> Any:
        rng, wild = self.rng, self._wild()
        if kind == 'boolean':
            return rng.random() < 0.5
        if kind == 'double':
            return rng.choice(HOSTILE) if wild else rng.uniform(-3.0, 9.0)
        if kind == 'float':
            return rng.choice((nan, inf, 0.0, -1e38)) if wild else rng.uniform(0.0, 9.0)
        if kind == 'octet':
            return bytes([rng.randrange(256)])
        bits = int(kind.removeprefix('u').removeprefix('int')) if 'int' in kind else 8
        low, high = (
            (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if kind[0] == 'i' else (0, 2**bits - 1)
        )
        return rng.choice((low, high, 0, 1)) if wild else rng.randrange(3)


def names_of(node: Any) -> tuple[str, ...]:
    """Return the joints that a node knows."""
    given = node.plain.parameters
    if hasattr(given, 'joint_names'):
        return tuple(given.joint_names)
    joints = getattr(node.plain, '_joints', None)
    found = getattr(joints, 'names', ())
    return tuple(found() if callable(found) else found) or ('left_wheel', 'right_wheel')


def message_door(home: Callable[[], Home]) -> Callable[[random.Random], Callable[[], None]]:
    """Return the door of all topics of a node."""

    def door(rng: random.Random) -> Callable[[], None]:
        place = home()
        topic = rng.choice(sorted(place.topics))
        kind = place.topics[topic].kind
        made = Maker(rng, names_of(place.node), place.graph.now).message(kind)
        later = rng.choice((1_000_000, 10_000_000, 100_000_000))
        return partial(place.hear, topic, codec(kind).encode(made), later)

    return door


def service_door(home: Callable[[], Home]) -> Callable[[random.Random], Callable[[], None]]:
    """Return the door of all services of a node."""

    def door(rng: random.Random) -> Callable[[], None]:
        place = home()
        service, act = rng.choice(place.services)
        made = Maker(rng, (), place.graph.now).message(service.Request)
        return partial(place.ask, act, made)

    return door


def dynamic(kind: Any, prefix: str) -> list[str]:
    """Return the names of the parameters that may change at run time; rclpy refuses others."""
    found = [prefix + name for name, _, spec in rows(kind) if spec.dynamic]
    for name, group in nested(kind):
        found += dynamic(group, f'{prefix}{name}.')
    return found


def changed(rng: random.Random, old: Any, texts: tuple[str, ...]) -> Any:
    """Return another value of a parameter, of its type: rclpy sees to that."""
    if isinstance(old, (tuple, list)):
        kind = old[0] if old else 0.5
        return [changed(rng, kind, texts) for _ in range(rng.choice((0, 1, len(old), 3)))]
    choices: dict[type, Any] = {
        bool: (True, False),
        int: (0, 1, -1, 2, 2**31, 2**63 - 1, -(2**63)),
        float: (*HOSTILE, old, old, old),
        str: (*texts, old),
    }
    return rng.choice(choices[type(old)])


def parameter_door(
    home: Callable[[], Home], folder: Path
) -> Callable[[random.Random], Callable[[], None]]:
    """Return the door of the dynamic parameters of a node."""
    texts = (*TEXTS, str(folder / 'zone.yaml'), '/dev/zero', '/etc/passwd', '/proc/self/mem')

    def door(rng: random.Random) -> Callable[[], None]:
        place = home()
        names = dynamic(type(place.node.plain.parameters), '')
        changes = {}
        for name in rng.sample(names, min(rng.choice((1, 1, 2, 4)), len(names))):
            old: Any = place.node.plain.parameters
            for part in name.split('.'):
                old = getattr(old, part, 0.0)
            changes[name] = changed(rng, old, texts)
        return partial(place.change, changes)

    return door


def doors() -> Iterator[tuple[str, Callable[[random.Random], Callable[[], None]]]]:
    """Yield the doors by name."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / 'zone.yaml').write_text(ZONE)
        (folder / 'sequence.yaml').write_text(SEQUENCE)
        for node in KINDS:
            home = cache(partial(Home, node, folder))
            yield f'messages {node}', message_door(home)
            yield f'services {node}', service_door(home)
            yield f'parameters {node}', parameter_door(home, folder)
