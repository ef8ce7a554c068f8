"""What all doors share: the robots, who looks, who may do what, and what is kept."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from agv_motion.dashboard.server.acts import Acts
from agv_motion.dashboard.server.live import Hub
from agv_motion.dashboard.server.replays import Replays

if TYPE_CHECKING:
    from agv_motion.dashboard.server.access import Access
    from agv_motion.dashboard.server.fleet import Fleet
    from agv_motion.dashboard.server.store import Store

STATIC = Path(__file__).parents[1] / 'static'


@dataclass
class Site:
    """One running page."""

    fleet: Fleet
    access: Access
    store: Store | None = None
    """what is kept over a restart; None: nothing is"""
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

    def close(self) -> None:
        """Close what is kept."""
        if self.store is not None:
            self.store.close()
