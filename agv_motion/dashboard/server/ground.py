"""Zone, hours and a rest until a time: parameters of the trees, which refuse what cannot be."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.server.door import Asked, Door, acting, known_robot
from agv_motion.dashboard.server.doors import begun
from agv_motion.dashboard.server.requests import RequestError, number, text
from agv_motion.dashboard.server.roles import Role

if TYPE_CHECKING:
    from starlette.routing import Route

    from agv_motion.dashboard.server.site import Site

NODE = 'motion_generator'
MOST_CORNERS = 2000
MOST_RINGS = 100
DAYS = ('mon', 'tue', 'wed', 'thu', 'fri', 'sat', 'sun')
ZONE = ('boundary', 'holes', 'translation_only', 'margin', 'clearance_from', 'home')
HOURS = ('robot', 'open', 'close', 'days', 'time_zone', 'enabled')


def ground_doors(site: Site) -> list[Route]:
    """Return the doors to zone, hours and rests."""
    return [
        acting(site, Door('/zone', _zone, ('robot', 'zone'), Role.EXPERT)),
        acting(site, Door('/hours', _hours, HOURS, Role.EXPERT)),
        acting(site, Door('/robots/{robot}/rest', _rest, ('until',))),
    ]


def _set(asked: Asked, robots: list[str], values: dict[str, Any]) -> dict[str, Any]:
    return begun(asked, robots, 'set_parameters', {'node': NODE, 'values': values})


def _robots(asked: Asked) -> list[str]:
    """Return the robot that a request names, or all trees."""
    name = asked.told.get('robot')
    if name is not None:
        return [known_robot(asked.site, str(name))]
    robots = asked.site.fleet.board.robots.values()
    return sorted(robot.name for robot in robots if robot.kind == 'tree')


def _rest(asked: Asked) -> dict[str, Any]:
    return _set(asked, [asked.robot], {'rest_until': number(asked.told, 'until', 0.0, 1e11)})


def _hours(asked: Asked) -> dict[str, Any]:
    told = asked.told
    values: dict[str, Any] = {
        'schedule.enabled': told.get('enabled') is not False,
        'schedule.opens': _clock(told, 'open'),
        'schedule.closes': _clock(told, 'close'),
    }
    if 'days' in told:
        days = told['days']
        if not isinstance(days, list) or not days or any(day not in DAYS for day in days):
            raise RequestError(422, f'days = {str(days)[:60]}: give some of {", ".join(DAYS)}')
        values['schedule.days'] = days
    if 'time_zone' in told:
        values['schedule.time_zone'] = text(told, 'time_zone', 60, least=1)
    return _set(asked, _robots(asked), values)


def _clock(told: dict[str, Any], key: str) -> str:
    """Return a time of the day as HH:MM; it is told so, or in hours."""
    value = told.get(key)
    if isinstance(value, str):
        if not re.fullmatch(r'([01]\d|2[0-3]):[0-5]\d', value):
            raise RequestError(422, f'{key} = {value[:20]!r}: expected HH:MM')
        return value
    minutes = round(60.0 * number(told, key, 0.0, 24.0)) % (24 * 60)
    return f'{minutes // 60:02}:{minutes % 60:02}'


def _zone(asked: Asked) -> dict[str, Any]:
    zone = asked.told.get('zone')
    if not isinstance(zone, dict) or not set(zone) <= set(ZONE):
        raise RequestError(422, f'zone: expected an object with {", ".join(ZONE)}')
    return _set(asked, _robots(asked), {'zone': json.dumps(_checked(zone))})


def _checked(zone: dict[str, Any]) -> dict[str, Any]:
    """Return what a zone tells, its numbers finite; whether it is one the trees decide."""
    found: dict[str, Any] = {'boundary': _ring(zone.get('boundary'), 'boundary')}
    for key in ('holes', 'translation_only'):
        rings = zone.get(key) or []
        if not isinstance(rings, list) or len(rings) > MOST_RINGS:
            raise RequestError(422, f'{key}: expected a list of at most {MOST_RINGS} polygons')
        if rings:
            found[key] = [_ring(ring, f'{key} {i + 1}') for i, ring in enumerate(rings)]
    if zone.get('margin') is not None:
        found['margin'] = number(zone, 'margin', 0.0, 1000.0)
    if zone.get('clearance_from') is not None:
        found['clearance_from'] = text(zone, 'clearance_from', 20)
    if zone.get('home') is not None:
        found['home'] = _point(zone['home'], 'home')
    return found


def _ring(told: Any, name: str) -> list[list[float]]:
    if not isinstance(told, list) or not 3 <= len(told) <= MOST_CORNERS:
        raise RequestError(422, f'{name}: expected 3 to {MOST_CORNERS} corners')
    return [_point(point, name) for point in told]


def _point(told: Any, name: str) -> list[float]:
    if not isinstance(told, list) or len(told) != 2:
        raise RequestError(422, f'{name}: {str(told)[:40]} is no point: expected x and y in metres')
    return [number({name: value}, name) for value in told]
