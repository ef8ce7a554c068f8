"""The slots of a robot as the page sees them: of which topics each is made, and how.

A slot is made anew when one of its topics has spoken, and only while somebody looks.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.dashboard.core import conversions
from agv_motion.dashboard.core.numbers import finite, text_of
from agv_motion.dashboard.core.robot_state import PROBES
from agv_motion.sun import sun

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.dashboard.core.conversions import Value
    from agv_motion.dashboard.core.robot_state import RobotState

    Make = Callable[[RobotState], 'Value | None']


class Slot(NamedTuple):
    """What the page sees of a robot under one name."""

    name: str
    sources: tuple[str, ...]
    """topics of which it is made; its age is that of the first that has spoken"""
    make: Make
    on_request: bool = False
    """whether it is sent only to who asks for it"""


def _pose(robot: RobotState) -> Value | None:
    return _made(robot, 'pose', conversions.pose)


def _made(robot: RobotState, topic: str, convert: Callable[[Any], Value]) -> Value | None:
    made: Value | None = robot.converted(topic, convert)
    return made


def _turrets(robot: RobotState) -> Value | None:
    state, command = (robot.turrets(f'turrets/{what}') for what in ('state', 'command'))
    if state is None and command is None:
        return None
    nothing: Value = {'angles': [], 'speeds': []}
    return (state or nothing) | {'commanded': command or nothing}


def _wheels(robot: RobotState) -> Value | None:
    state, command = (robot.message(f'wheels/{what}') for what in ('state', 'command'))
    if state is None and command is None:
        return None
    told = {'speeds': []} if state is None else conversions.wheels(state, robot.radii)
    meant = {'speeds': []} if command is None else conversions.wheels(command, robot.radii)
    return told | {'commanded': {'speeds': meant['speeds']}}


def _twist(robot: RobotState) -> Value | None:
    odom, limited = robot.message('odom'), robot.message('cmd_vel/limited')
    commanded = None if limited is None else conversions.twist(limited.twist)
    if odom is None:
        return None if commanded is None else commanded | {'commanded': commanded}
    return conversions.twist(odom.twist.twist) | {'commanded': commanded}


def _goal(robot: RobotState) -> Value | None:
    found = _made(robot, 'goal', conversions.goal)
    if found is None:
        return None
    reasons = (node.told['values'].get('goal', '') for node in robot.nodes.values())
    return found | {'reason': next((text_of(reason) for reason in reasons if reason), '')}


PATHS = ('path', 'sequence/path', 'route/path', 'ghost/path')


def _path(robot: RobotState) -> Value | None:
    entries = [robot.latest[topic] for topic in PATHS if topic in robot.latest]
    newest = max(entries, key=lambda entry: entry.number, default=None)
    if newest is None or newest.message is None:
        return None
    return conversions.path(newest.message)


TEXTS = ('state', 'sequence/state', 'sequence/status', 'route/state', 'ghost/state')


def _state(robot: RobotState) -> Value | None:
    entries = [robot.latest[topic] for topic in TEXTS if topic in robot.latest]
    newest = max(entries, key=lambda entry: entry.number, default=None)
    if newest is None or newest.message is None:
        return None
    message = newest.message
    return {'text': text_of(getattr(message, 'data', None) or getattr(message, 'message', ''))}


def _sap_flow(robot: RobotState) -> Value | None:
    found = _made(robot, 'granier/sap_flow', conversions.sap_flow)
    valid = robot.message('granier/valid')
    if found is None and valid is None:
        return None
    return (found or {'s': [None] * 3}) | {'valid': None if valid is None else bool(valid.data)}


PROBE_TOPICS = tuple(f'granier/probe_{i}/temperature_difference' for i in range(1, PROBES + 1))


def _probes(robot: RobotState) -> Value | None:
    flows = (_sap_flow(robot) or {}).get('s', [])
    texts: dict[str, str] = {}
    for node in robot.nodes.values():
        values = node.told['values']
        texts |= {key: text for key, text in values.items() if key.startswith('probe_')}
    rows = []
    for i, topic in enumerate(PROBE_TOPICS):
        message, name = robot.message(topic), f'probe_{i + 1}'
        if message is None and name not in texts:
            continue
        rows.append({
            'name': name,
            'temperature_difference': None if message is None else finite(message.temperature),
            'quality': texts.get(name, '').partition(',')[0],
            'text': texts.get(name, ''),
            'signal': flows[i] if i < len(flows) else None,
        })  # fmt: skip
    return {'probes': rows} if rows else None


def _sun(robot: RobotState) -> Value | None:
    message = robot.message('sunlight')
    if message is None:
        return None
    found: Value = {'illuminance': finite(message.illuminance, 1)}
    latitude, longitude = (robot.platform.get(key) for key in ('latitude', 'longitude'))
    stamp = message.header.stamp
    if latitude is not None and longitude is not None and stamp.sec > 0:
        where = sun(stamp.sec, latitude, longitude)
        found |= {'elevation': finite(where.elevation), 'azimuth': finite(where.azimuth)}
    return found


def _zone(robot: RobotState) -> Value | None:
    return _made(robot, 'zone', lambda m: conversions.zone(m) or {})


def _standstill(robot: RobotState) -> Value | None:
    return _made(robot, 'standstill', lambda m: {'standstill': bool(m.data)})


SLOTS = (
    Slot('pose', ('pose',), _pose),
    Slot('turrets', ('turrets/state', 'turrets/command'), _turrets),
    Slot('wheels', ('wheels/state', 'wheels/command'), _wheels),
    Slot('twist', ('odom', 'cmd_vel/limited'), _twist),
    Slot('goal', ('goal',), _goal),
    Slot('path', PATHS, _path),
    Slot('state', TEXTS, _state),
    Slot('driver', ('driver',), lambda robot: _made(robot, 'driver', conversions.driver)),
    Slot('standstill', ('standstill',), _standstill),
    Slot('why', ('why',), lambda robot: _made(robot, 'why', conversions.why)),
    Slot('sap_flow', ('granier/sap_flow', 'granier/valid'), _sap_flow),
    Slot('probes', PROBE_TOPICS, _probes),
    Slot('sun', ('sunlight',), _sun),
    Slot('zone', ('zone',), _zone),
    *(
        Slot(f'memory/{what}', (f'memory/{what}',),
             lambda robot, topic=f'memory/{what}': _made(robot, topic, conversions.occupancy),  # type: ignore[misc] # default of a lambda
             on_request=True)
        for what in ('sap_flow', 'last_visit')
    ),
)  # fmt: skip
