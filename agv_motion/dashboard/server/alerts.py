"""Alerts on the page: from the robots' chains of reasons, kept over a restart, acknowledged."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.core import conversions
from agv_motion.dashboard.core.alerts import Alert, AlertBook, PlainLink
from agv_motion.dashboard.server.door import Asked, Door, acting
from agv_motion.dashboard.server.requests import RequestError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from starlette.routing import Route

    from agv_motion.dashboard.core.robot_state import RobotState
    from agv_motion.dashboard.server.site import Site

SHOWN = 200
"""newest alerts that the page shows"""


class AlertDesk:
    """Feeds the book of alerts, keeps it, and shows it."""

    def __init__(self, site: Site) -> None:
        """Take up the alerts of earlier runs."""
        self._site, self._book = site, AlertBook()
        self._seen: dict[str, int] = {}
        """number of the chain of each robot that was looked at last"""
        if site.store is not None:
            rows = site.store.rows('SELECT content FROM alerts ORDER BY raised DESC LIMIT 1000')
            self._book.restore(Alert(**json.loads(content)) for (content,) in reversed(rows))
        self._show()
        site.hub.at_each_second.append(self.look)

    def look(self, now: float) -> None:
        """Take up what the robots have said since the last time [s, on the clock of the board]."""
        time = self._site.fleet.board.time_of_robots(now)
        changed: list[Alert] = []
        for robot in list(self._site.fleet.board.robots.values()):
            links = self._news(robot, now)
            if links is not None:
                changed += self._book.update(robot.name, links, time)
        changed += self._book.look(time)
        if changed:
            self._keep(changed)

    def acknowledge(self, number: str, by: str) -> Alert:
        """Note who has seen an alert.

        Raises:
            RequestError: There is none of this id.

        """
        board, now = self._site.fleet.board, self._site.fleet.now()
        alert = self._book.acknowledge(number, by, board.time_of_robots(now))
        if alert is None:
            raise RequestError(404, f"no alert '{number[:60]}'")
        self._keep([alert])
        return alert

    def alerts(self) -> list[dict[str, Any]]:
        """Return the newest alerts, newest first."""
        return [alert._asdict() for alert in self._book.alerts()[:SHOWN]]

    def _news(self, robot: RobotState, now: float) -> Sequence[PlainLink] | None:
        """Return the chain of a robot if it is new; of one without a chain what its nodes say."""
        entry = robot.latest.get('why')
        if entry is None:
            fresh = [node.told for node in robot.nodes.values() if not node.is_old(now)]
            links = [PlainLink(t['name'], t['level'], t['message']) for t in fresh]
            return links or None
        if entry.message is None or self._seen.get(robot.name) == entry.number:
            return None
        self._seen[robot.name] = entry.number
        return [
            PlainLink(link['name'], link['level'], link['sentence'], link['because'])
            for link in conversions.why(entry.message)['links']
            if link['name'] != 'headline'
        ]

    def _keep(self, changed: list[Alert]) -> None:
        store = self._site.store
        if store is not None:
            for alert in changed:
                store.change(
                    'INSERT OR REPLACE INTO alerts VALUES (?, ?, ?, ?)',
                    (alert.id, alert.robot, alert.raised, json.dumps(alert._asdict())),
                )
        self._show()

    def _show(self) -> None:
        self._site.fleet.board.put('', 'alerts', self._site.fleet.now(), self.alerts())


def alert_doors(site: Site, desk: AlertDesk) -> list[Route]:
    """Return the doors to alerts."""

    def acknowledge(asked: Asked) -> dict[str, Any]:
        number = str(asked.request.path_params['alert'])
        return {'id': desk.acknowledge(number, asked.visitor.name).id}

    return [acting(site, Door('/alerts/{alert:path}/acknowledge', acknowledge))]
