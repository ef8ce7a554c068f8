"""What all doors share: the robots, who looks, who may do what, and what is kept."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.server.acts import Acts
from agv_motion.dashboard.server.live import Hub
from agv_motion.dashboard.server.replays import Replays

if TYPE_CHECKING:
    from agv_motion.dashboard.server.access import Access
    from agv_motion.dashboard.server.fleet import Fleet
    from agv_motion.dashboard.server.history_bag import History
    from agv_motion.dashboard.server.store import Store

STATIC = Path(__file__).parents[1] / 'static'


@dataclass
class Site:
    """One running page."""

    fleet: Fleet
    access: Access
    store: Store | None = None
    """what is kept over a restart; None: nothing is"""
    history: History | None = None
    """into what one can look back; None: nothing is recorded"""
    reports: Path | None = None
    """folder of the daily reports"""
    recorded: bool = False
    """whether there is nothing but the past"""
    replays: Replays = field(default_factory=Replays)
    drivers: dict[str, tuple[object, float]] = field(default_factory=dict)
    """who drives each robot by hand, and when it last moved the hand [s, steady]"""

    def __post_init__(self) -> None:
        """Make the hub and the acts."""
        self.hub = Hub(self.fleet.board, self.fleet.now)
        self.acts = Acts(self.fleet, self.hub)

    @property
    def is_watched(self) -> bool:
        """Whether somebody looks, or waits for what comes of an act."""
        return bool(self.hub.clients) or self.hub.busy()

    def platforms(self) -> dict[str, dict[str, Any]]:
        """Return the shapes of robots, of now or as they were kept."""
        kept = {}
        if self.store is not None:
            rows = self.store.rows('SELECT robot, content FROM platforms')
            kept = {robot: json.loads(content) for robot, content in rows}
        robots = self.fleet.board.robots.values()
        return kept | {robot.name: robot.platform for robot in robots if robot.platform}

    def keep_platforms(self) -> None:
        """Keep the shapes of robots, for who looks back into a bag when they are gone."""
        if self.store is not None:
            for robot, platform in self.platforms().items():
                self.store.change(
                    'INSERT OR REPLACE INTO platforms VALUES (?, ?)', (robot, json.dumps(platform))
                )

    def close(self) -> None:
        """Close what is kept."""
        if self.store is not None:
            self.keep_platforms()
            self.store.close()
