"""What all doors share: the robots, who looks, who may do what."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from agv_motion.dashboard.server.fleet import Fleet
    from agv_motion.dashboard.server.live import Hub

STATIC = Path(__file__).parents[1] / 'static'


@dataclass
class Site:
    """One running page."""

    fleet: Fleet
    hub: Hub
