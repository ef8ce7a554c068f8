"""The doors to parameters: `POST /robots/NAME/parameters`, and those to what was saved of them."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.server.door import Asked, Door, acting, looking
from agv_motion.dashboard.server.parameter_desk import ParameterDesk, Values
from agv_motion.dashboard.server.requests import RequestError, text
from agv_motion.dashboard.server.roles import Role

if TYPE_CHECKING:
    from starlette.routing import Route

    from agv_motion.dashboard.server.site import Site

LONGEST_VALUE = 20_000
"""characters of a value as JSON"""
LONGEST_ID = 15
"""digits of the number of a save"""


def parameter_doors(site: Site) -> list[Route]:
    """Return the doors to parameters."""
    doors = _ParameterDoors(site)
    place = '/robots/{robot}/parameters'
    return [
        acting(site, Door(place, doors.set_one, ('node', 'name', 'value'), Role.EXPERT)),
        acting(site, Door(f'{place}/save', doors.save, ('comment',))),
        acting(site, Door(f'{place}/revert', doors.revert, ('id',), Role.EXPERT)),
        looking(site, f'{place}/saved', doors.saved),
        looking(site, f'{place}/compare', doors.compare),
    ]


class _ParameterDoors:
    """What is done at each door."""

    def __init__(self, site: Site) -> None:
        self._site, self._desk = site, ParameterDesk(site)

    def set_one(self, asked: Asked) -> dict[str, Any]:
        told = asked.told
        node, name = text(told, 'node', 100, least=1), text(told, 'name', 200, least=1)
        if 'value' not in told or len(json.dumps(told['value'])) > LONGEST_VALUE:
            raise RequestError(422, f'value: give one of at most {LONGEST_VALUE} characters')
        return {'id': self._begin(asked.robot, node, {name: told['value']})}

    async def save(self, asked: Asked) -> dict[str, Any]:
        comment = text(asked.told, 'comment', 500, '')
        return {'id': await self._desk.save(asked.robot, asked.visitor.name, comment)}

    async def revert(self, asked: Asked) -> dict[str, Any]:
        """Set what may change while the robot runs; tell what may not."""
        number = asked.told.get('id')
        if type(number) is not int or not 0 < number < 10**LONGEST_ID:
            raise RequestError(422, f'id = {str(number)[:40]!r}: expected the number of a save')
        rows = await self._desk.differences(asked.robot, number)
        changes: Values = {}
        for row in rows:
            if row['dynamic']:
                changes.setdefault(row['node'], {})[row['name']] = row['saved']
        ids = [self._begin(asked.robot, node, values) for node, values in changes.items()]
        fixed = [f'{row["node"]} {row["name"]}' for row in rows if not row['dynamic']]
        return {'id': ids[0] if ids else '', 'ids': ids, 'at_start_only': fixed}

    def saved(self, asked: Asked) -> list[dict[str, Any]]:
        return self._desk.saved(asked.robot)

    async def compare(self, asked: Asked) -> list[dict[str, Any]]:
        number = asked.request.query_params.get('with', '')
        if not number.isdecimal() or len(number) > LONGEST_ID:
            raise RequestError(422, f'with = {number[:40]!r}: expected the number of a save')
        return await self._desk.differences(asked.robot, int(number))

    def _begin(self, robot: str, node: str, values: dict[str, Any]) -> str:
        if self._site.recorded:
            raise RequestError(409, 'this is a recording: nothing can be done in it')
        arguments = {'node': node, 'values': values}
        show = self._desk.show
        return self._site.acts.begin([robot], 'set_parameters', arguments, lambda: show(robot))
