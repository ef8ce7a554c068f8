"""Parameters of robots: shown while somebody looks, set live, saved, compared and reverted.

A save holds the values of all nodes of a robot with date, author and comment, and is kept for good.
Reverting sets what may change while the robot runs, and names what may not.
"""

from __future__ import annotations

import asyncio
import json
import time
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.server.fleet import NoAnswerError, RefusedError
from agv_motion.dashboard.server.requests import RequestError

if TYPE_CHECKING:
    from agv_motion.dashboard.server.site import Site
    from agv_motion.dashboard.server.store import Store

Values = dict[str, dict[str, Any]]
"""by node and name"""

PERIOD = 5.0
"""[s] between two looks at parameters that somebody looks at"""
PATIENCE = 5.0
"""[s] within which the nodes of a robot must tell theirs"""
SLOT = 'parameters'


class ParameterDesk:
    """Reads the parameters of robots, and keeps what was saved of them."""

    def __init__(self, site: Site) -> None:
        """Read nothing until somebody looks."""
        self._site = site
        self._due: dict[str, float] = {}
        self._reading: dict[str, asyncio.Task[None]] = {}
        site.hub.at_each_look.append(self.look)

    def look(self, now: float) -> None:
        """Read what somebody looks at, now and then."""
        for robot in self._site.fleet.robots:
            if (robot, SLOT) in self._site.hub.wanted and now >= self._due.get(robot, 0.0):
                self.show(robot)

    def show(self, robot: str) -> None:
        """Read the parameters of a robot, for those who look at them."""
        self._due[robot] = self._site.fleet.now() + PERIOD
        if robot not in self._reading:
            task = asyncio.create_task(self._show(robot))
            self._reading[robot] = task
            task.add_done_callback(lambda _: self._reading.pop(robot, None))

    async def _show(self, robot: str) -> None:
        try:
            nodes = await self.read(robot)
        except RequestError:
            return  # told at the next look, if somebody answers
        self._site.fleet.board.put(robot, SLOT, self._site.fleet.now(), {'nodes': nodes})

    async def read(self, robot: str) -> list[dict[str, Any]]:
        """Return the nodes of a robot with their parameters.

        Raises:
            RequestError: They do not answer.

        """
        try:
            return await asyncio.wait_for(self._site.fleet.parameters(robot), PATIENCE)
        except (RefusedError, NoAnswerError, asyncio.TimeoutError) as error:
            reason = str(error) or f'no answer in {PATIENCE:g} s'
            raise RequestError(503, f'parameters of {robot}: {reason}') from error

    # What is kept

    async def save(self, robot: str, by: str, comment: str) -> int:
        """Save all values of a robot; return the number of the save."""
        content = json.dumps(_values(await self.read(robot)))
        store = _store(self._site)
        return store.change(
            'INSERT INTO parameters (robot, at, by, comment, content) VALUES (?, ?, ?, ?, ?)',
            (robot, time.time(), by, comment, content),
        )

    def saved(self, robot: str) -> list[dict[str, Any]]:
        """Return the saves of a robot, newest first."""
        rows = _store(self._site).rows(
            'SELECT id, at, by, comment FROM parameters WHERE robot = ? ORDER BY id DESC LIMIT 500',
            (robot,),
        )
        return [{'id': i, 'at': at, 'by': by, 'comment': comment} for i, at, by, comment in rows]

    async def differences(self, robot: str, save: int) -> list[dict[str, Any]]:
        """Return what differs now from a save: node, name, saved, now, dynamic.

        Raises:
            RequestError: There is no such save, or the robot does not answer.

        """
        rows = _store(self._site).rows(
            'SELECT content FROM parameters WHERE robot = ? AND id = ?', (robot, save)
        )
        if not rows:
            raise RequestError(404, f'no save {save} of {robot}')
        before: Values = json.loads(rows[0][0])
        found = []
        for node in await self.read(robot):
            saved = before.get(node['node'], {})
            for row in node['rows']:
                name = row['name']
                if name in saved and saved[name] != row['value']:
                    found.append({
                        'node': node['node'], 'name': name, 'saved': saved[name],
                        'now': row['value'], 'dynamic': row['dynamic'],
                    })  # fmt: skip
        return found


def _values(nodes: list[dict[str, Any]]) -> Values:
    return {node['node']: {row['name']: row['value'] for row in node['rows']} for node in nodes}


def _store(site: Site) -> Store:
    if site.store is None:
        raise RequestError(503, 'nothing is kept here: this page shows a bag')
    return site.store
