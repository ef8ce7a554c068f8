"""Parameters of the robots' nodes, by the names that tools have for them: ``/oak/arbiter.rate``."""

from __future__ import annotations

import asyncio
import time
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.core.names import namespace_of, robot_of
from agv_motion.dashboard.foxglove import protocol
from agv_motion.dashboard.foxglove.requests import ProtocolError
from agv_motion.dashboard.server.foxglove.client import ALL
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from agv_motion.dashboard.foxglove.requests import GetParameters, SetParameters, WatchParameters
    from agv_motion.dashboard.server.fleet import Fleet
    from agv_motion.dashboard.server.foxglove.client import FoxgloveClient

PATIENCE = 5.0
"""[s] within which the nodes of a robot must tell theirs"""
MOST_WATCHED = 5000
"""names by which a client may watch parameters"""
FRESH = 1.0
"""[s] for which what was read counts"""


class FoxgloveParameters:
    """Reads, sets and watches parameters for clients."""

    def __init__(self, fleet: Fleet) -> None:
        """Read nothing yet."""
        self._fleet = fleet
        self._read: dict[str, tuple[float, asyncio.Future[dict[str, Any]]]] = {}
        """values of each robot, and when they were asked for [s, steady]"""

    async def get(self, client: FoxgloveClient, request: GetParameters) -> None:
        """Tell a client values; names that there are not are told, too."""
        names = request.names
        robots = {_robot(name) for name in names} if names else set(self._fleet.robots)
        found: dict[str, Any] = {}
        for robot in sorted(robots & set(self._fleet.robots)):
            found |= await self._values(robot)
        if names:
            missing = [name for name in names if name not in found]
            if missing:
                client.refuse(
                    f"no parameter '{missing[0]}'{' and others' * (len(missing) > 1)}: they are "
                    'named /NODE.PARAMETER, such as /oak/arbiter.rate'
                )
            found = {name: found[name] for name in names if name in found}
        client.send(protocol.parameter_values(found, request.id))

    async def set(self, client: FoxgloveClient, request: SetParameters) -> None:
        """Set values, those of one node all or none; tell what they are then."""
        if not client.permissions.changes:
            client.refuse(
                'parameters can be set by an expert only, where the endpoint was started with '
                '--foxglove-acts'
            )
        else:
            by_node = _by_node(request.values).items()
            told = [await self._set(node, values) for node, values in by_node]
            client.refuse_each([why for why in told if why])
        if request.id:
            self._read.clear()
            names = list(request.values)
            robots = {_robot(name) for name in names} & set(self._fleet.robots)
            found: dict[str, Any] = {}
            for robot in robots:
                found |= await self._values(robot)
            now = {name: found[name] for name in names if name in found}
            client.send(protocol.parameter_values(now, request.id))

    @staticmethod
    def watch(client: FoxgloveClient, request: WatchParameters) -> None:
        """Let a client be told of changes, or no more."""
        names = set(request.names or (ALL,))
        if request.on and len(client.watched | names) > MOST_WATCHED:
            client.refuse(f'{MOST_WATCHED} parameters are watched: watch all of them, by no name')
        elif request.on:
            client.watched |= names
        elif request.names:
            client.watched -= names
        else:
            client.watched.clear()

    async def _set(self, place: str, values: dict[str, Any]) -> str:
        """Set values of one node; return why not, or nothing."""
        namespace, _, node = place.rpartition('/')
        robot = robot_of(namespace)
        if robot not in self._fleet.robots or not node:
            return f"no robot has a node '{place}'"
        try:
            await self._fleet.act(robot, 'set_parameters', {'node': node, 'values': values})
        except AgvMotionError as error:
            return f'{place}: {error}'
        return ''

    async def _values(self, robot: str) -> dict[str, Any]:
        """Return the values of all parameters of a robot, read a moment ago at most."""
        asked, future = self._read.get(robot, (0.0, None))
        if future is None or time.monotonic() - asked > FRESH:
            future = asyncio.ensure_future(self._ask(robot))
            self._read[robot] = time.monotonic(), future
        return await asyncio.shield(future)

    async def _ask(self, robot: str) -> dict[str, Any]:
        try:
            nodes = await asyncio.wait_for(self._fleet.parameters(robot), PATIENCE)
        except asyncio.TimeoutError as error:
            msg = f'the nodes of {robot} have not answered in {PATIENCE:g} s'
            raise ProtocolError(msg) from error
        namespace = namespace_of(robot)
        return {
            f'{namespace}/{one["node"]}.{row["name"]}': row['value']
            for one in nodes for row in one['rows']
        }  # fmt: skip


def _robot(name: str) -> str:
    """Return whose a parameter is."""
    return robot_of(name.partition('.')[0].rpartition('/')[0])


def _by_node(values: dict[str, Any]) -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = {}
    for name, value in values.items():
        node, _, parameter = name.partition('.')
        found.setdefault(node, {})[parameter] = value
    return found
