"""Messages as values for a browser: numbers that JSON has, of bounded size, None for what is none.

A message is anything with the fields of its type: one of rclpy, or one out of a bag. Frames are
those of the message: the map for places, the robot's own for twists. SI units, angles in radians.
"""

from __future__ import annotations

import base64
import json
from functools import lru_cache
from math import hypot
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.core.numbers import (
    MOST_JOINTS,
    finite,
    heading_of,
    known,
    listed,
    point_of,
    text_of,
    thinned,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

FAR = 1000.0
"""[m] A centre of rotation beyond is as good as none: the robot goes straight."""
STILL = 1e-4
"""[rad/s] below which nothing turns"""
MOST_CELLS = 250_000
"""of a map that is sent"""
MOST_LINKS = 40
"""of a chain of reasons, and of the sources of twists"""
LEVELS = ('OK', 'WARN', 'ERROR', 'STALE')
OF_ALL = frozenset({'driver', 'stop', 'lock', 'lost'})
"""Values of a `driver` that are of no one source: who drives, why STOP holds, who is held"""
STEERING, WHEEL = '_steering', '_wheel'

Value = dict[str, Any]


def twist(message: Any) -> Value:
    """Return a geometry_msgs/Twist with its centre of rotation in the robot's frame."""
    vx, vy, wz = (finite(n, 5) for n in (message.linear.x, message.linear.y, message.angular.z))
    return {'vx': vx, 'vy': vy, 'wz': wz, 'icr': centre_of_rotation(vx, vy, wz)}


def centre_of_rotation(vx: float | None, vy: float | None, wz: float | None) -> list[float] | None:
    """Return the point about which a body turns [m], in its own frame; None: far, or unknown."""
    if vx is None or vy is None or wz is None or abs(wz) < STILL:
        return None
    x, y = -vy / wz, vx / wz
    return [round(x, 4), round(y, 4)] if hypot(x, y) < FAR else None


def pose(message: Any) -> Value:
    """Return a geometry_msgs/PoseWithCovarianceStamped: place, heading and covariance."""
    place, c = message.pose.pose, message.pose.covariance
    return {
        'x': finite(place.position.x),
        'y': finite(place.position.y),
        'heading': heading_of(place.orientation),
        'covariance': [finite(c[i], 6) for i in (0, 1, 7, 35)],
    }


def goal(message: Any) -> Value:
    """Return a geometry_msgs/PoseStamped."""
    x, y = point_of(message.pose.position)
    return {'x': x, 'y': y, 'heading': heading_of(message.pose.orientation)}


def path(message: Any) -> Value:
    """Return the places of a nav_msgs/Path."""
    points = [point_of(stamped.pose.position) for stamped in thinned(message.poses)]
    return {'points': [point for point in points if known(point)]}


def turrets(message: Any, radius: float | None) -> Value:
    """Return a sensor_msgs/JointState of turrets: their angles [rad] and speeds [m/s].

    Args:
        message: Joints ``turret_i_steering`` by position and ``turret_i_wheel`` by velocity, in
            any order.
        radius: Of the wheels [m]; None where nobody has told: then there are no speeds.

    """
    steering, _ = _turret_places(tuple(message.name[: 2 * MOST_JOINTS]))
    rates = turret_rates(message)
    return {
        'angles': _picked(message.position, steering),
        'speeds': _speeds(rates, [radius] * len(rates)),
    }


def turret_rates(message: Any) -> list[float | None]:
    """Return the rates of the wheels of turrets [rad/s], as :func:`turrets` has their speeds."""
    _, wheels = _turret_places(tuple(message.name[: 2 * MOST_JOINTS]))
    return _picked(message.velocity, wheels)


def wheels(message: Any, radii: Sequence[float | None]) -> Value:
    """Return a sensor_msgs/JointState of fixed wheels: speeds [m/s] in the order of the message."""
    rates = listed(message.velocity)
    given = list(radii) + [radii[-1] if radii else None] * (len(rates) - len(radii))
    return {'names': [text_of(name, 60) for name in message.name[:MOST_JOINTS]],
            'speeds': _speeds(rates, given)}  # fmt: skip


@lru_cache(maxsize=100)
def _turret_places(names: tuple[str, ...]) -> tuple[list[int], list[int]]:
    """Return where among ``names`` are the steering joints, and where the wheels; -1: nowhere."""
    index = {name: i for i, name in enumerate(names)}
    count = min(sum(name.endswith(STEERING) for name in index), MOST_JOINTS)
    steering = [index.get(f'turret_{i}{STEERING}', -1) for i in range(count)]
    return steering, [index.get(f'turret_{i}{WHEEL}', -1) for i in range(count)]


def _picked(values: Sequence[Any], places: Sequence[int]) -> list[float | None]:
    """Return the values at some places, None where there are not so many."""
    count = len(values)
    return [finite(values[i]) if 0 <= i < count else None for i in places]


def _speeds(rates: Sequence[float | None], radii: Sequence[float | None]) -> list[float | None]:
    return [
        None if rate is None or radius is None else finite(rate * radius, 5)
        for rate, radius in zip(rates, radii, strict=False)
    ]


def status(message: Any) -> Value:
    """Return a diagnostic_msgs/DiagnosticStatus."""
    return {
        'name': text_of(message.name, 200),
        'level': level(message.level),
        'message': text_of(message.message),
        'values': {text_of(v.key, 100): text_of(v.value, 300) for v in message.values[:64]},
    }


def level(value: Any) -> str:
    """Return the level of a status in a word: rclpy has bytes for it, a bag numbers."""
    number = value[0] if isinstance(value, (bytes, bytearray)) and value else value
    return LEVELS[number] if isinstance(number, int) and 0 <= number < len(LEVELS) else 'STALE'


def driver(message: Any) -> Value:
    """Return who drives, and why the other sources of twists do not."""
    told = status(message)
    values = told['values']
    sources = []
    for name, text in list(values.items())[:MOST_LINKS]:
        if name not in OF_ALL:
            verdict = text.partition(',')[0].partition(' (')[0]
            sources.append({'name': name, 'verdict': verdict.strip(), 'text': text})
    driving = values.get('driver', '')
    return {
        'driver': '' if driving == 'none' else driving,
        'sentence': told['message'],
        'level': told['level'],
        'stop': bool(values.get('stop', '').strip()),
        'reason': values.get('stop', ''),
        'lock': values.get('lock', ''),
        'lost': values.get('lost', ''),
        'sources': sources,
    }


def why(message: Any) -> Value:
    """Return the chain of reasons, from the wheels back to the probe."""
    links = []
    for one in message.status[:MOST_LINKS]:
        told = status(one)
        values = told['values']
        links.append({
            'name': told['name'], 'level': told['level'], 'sentence': told['message'],
            'age': finite(values.get('age [s]'), 2), 'since': values.get('since', ''),
            'remedy': values.get('remedy', ''), 'limit': values.get('limit', ''),
            'because': values.get('because', ''),
        })  # fmt: skip
    return {'links': links}


def sap_flow(message: Any) -> Value:
    """Return a geometry_msgs/Vector3Stamped of three sap flows [1]."""
    v = message.vector
    return {'s': [finite(v.x), finite(v.y), finite(v.z)]}


def occupancy(message: Any) -> Value:
    """Return a nav_msgs/OccupancyGrid; its cells row by row from the south, int8 in base64."""
    info = message.info
    cells = bytes(int(cell) & 0xFF for cell in message.data[: MOST_CELLS + 1])
    whole = len(cells) == info.width * info.height and len(cells) <= MOST_CELLS
    return {
        'x': finite(info.origin.position.x),
        'y': finite(info.origin.position.y),
        'resolution': finite(info.resolution),
        'width': int(info.width) if whole else 0,
        'height': int(info.height) if whole else 0,
        'cells': base64.b64encode(cells if whole else b'').decode('ascii'),
    }


KINDS = ('held', 'requested', 'planned')


def reservations(messages: dict[str, Any]) -> list[Value]:
    """Return the floor that each tree holds, asks for and means to go, of its last message."""
    found = []
    for name, message in messages.items():
        for marker in message.markers[:4]:
            points = [point_of(point) for point in thinned(marker.points)]
            if 0 <= marker.id < len(KINDS) and points:
                found.append({
                    'robot': name, 'kind': KINDS[marker.id],
                    'width': finite(marker.scale.x), 'points': [p for p in points if known(p)],
                })  # fmt: skip
    return found


def zone(message: Any) -> Value | None:
    """Return the zone in a std_msgs/String of JSON; None where it is none."""
    try:
        told = json.loads(message.data[:200_000])
    except (ValueError, RecursionError):
        return None
    if not isinstance(told, dict):
        return None
    home = told.get('home')
    return {
        'boundary': _outline(told.get('boundary')),
        'holes': _outlines(told.get('holes')),
        'translation_only': _outlines(told.get('translation_only')),
        'margin': finite(told.get('margin')),
        'clearance_from': finite(told.get('clearance_from')),
        'home': listed(home, 2) if isinstance(home, list) else None,
    }


def _outlines(told: Any) -> list[list[list[float | None]]]:
    return [_outline(one) for one in told[:100]] if isinstance(told, list) else []


def _outline(told: Any) -> list[list[float | None]]:
    """Return the corners of a polygon, those that are none left out."""
    points = [listed(p, 2) for p in told[:2000] if isinstance(p, list)] if isinstance(
        told, list) else []  # fmt: skip
    return [point for point in points if len(point) == 2 and known(point)]
