"""The doors by which people act on robots: `POST /stop`, `POST /robots/NAME/...`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.server.door import Asked, Door, acting
from agv_motion.dashboard.server.requests import RequestError, number

if TYPE_CHECKING:
    from collections.abc import Callable

    from starlette.routing import Route

    from agv_motion.dashboard.server.site import Site

PLAIN = 'release', 'pause', 'resume', 'home', 'next_goal', 'lock', 'unlock'
"""acts on one robot that need no more than its name"""
PLACE = 'x', 'y', 'heading'
TURN = 7.0
"""[rad] of a heading, either way"""


def doors(site: Site) -> list[Route]:
    """Return the doors of a page."""
    robot = '/robots/{robot}/'
    found = [
        Door('/stop', _of_all('stop'), keyed=False),
        Door('/release', _of_all('release')),
        Door(f'{robot}stop', _of_one('stop'), keyed=False),
        Door(f'{robot}goal', _goal, PLACE),
        Door(f'{robot}pose', _pose, PLACE),
        *(Door(f'{robot}{name}', _of_one(name)) for name in PLAIN),
    ]
    return [acting(site, door) for door in found]


def begun(
    asked: Asked, robots: list[str], action: str, arguments: dict[str, Any]
) -> dict[str, Any]:
    """Begin an act on robots; return its id, under which `/live` tells how it ends.

    Raises:
        RequestError: There is no robot, or too much is under way.

    """
    if asked.site.recorded:
        raise RequestError(409, 'this is a recording: nothing can be done in it')
    acts = asked.site.acts
    if not robots:
        raise RequestError(409, 'there is no robot')
    if acts.full and action != 'stop':
        raise RequestError(503, 'too many acts are under way: wait until some have ended')
    return {'id': acts.begin(robots, action, arguments | {'by': asked.visitor.name})}


def _of_all(action: str) -> Callable[[Asked], dict[str, Any]]:
    return lambda asked: begun(asked, asked.site.fleet.robots, action, {})


def _of_one(action: str) -> Callable[[Asked], dict[str, Any]]:
    return lambda asked: begun(asked, [asked.robot], action, {})


def _goal(asked: Asked) -> dict[str, Any]:
    return begun(asked, [asked.robot], 'goal', _place(asked, 0.0))


def _pose(asked: Asked) -> dict[str, Any]:
    return begun(asked, [asked.robot], 'pose', _place(asked, None))


def _place(asked: Asked, heading: float | None) -> dict[str, Any]:
    told = asked.told
    return {
        'x': number(told, 'x'),
        'y': number(told, 'y'),
        'heading': number(told, 'heading', -TURN, TURN, heading),
    }
