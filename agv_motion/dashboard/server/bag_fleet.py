"""The robots of a bag, as the server sees them: they can be looked at, and nothing else."""

from __future__ import annotations

import asyncio
import time
from typing import TYPE_CHECKING, Any

from agv_motion.bag.reader import BagReader
from agv_motion.dashboard.core.board import Board
from agv_motion.dashboard.core.names import SIGNS, split
from agv_motion.dashboard.server.fleet import RefusedError

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.planar import Twist

RECORDED = 'this is a recording: nothing can be done in it'


class BagFleet:
    """Implements `Fleet` for a bag."""

    def __init__(self, path: Path) -> None:
        """Find out which robots are in it.

        Raises:
            SourceError: There is no bag, or it cannot be read at all.

        """
        self.board = Board()
        with BagReader(path) as bag:
            for topic in bag.topics:
                known = split(topic)
                if known is not None and known[1] in SIGNS:
                    self.board.robot(known[0])

    @property
    def robots(self) -> list[str]:
        """Names of the robots in the bag."""
        return sorted(self.board.robots)

    def now(self) -> float:
        """Return seconds since 1970."""
        return time.time()

    def act(self, robot: str, action: str, arguments: dict[str, Any]) -> asyncio.Future[str]:
        """Refuse."""
        del robot, action, arguments
        future: asyncio.Future[str] = asyncio.get_running_loop().create_future()
        future.set_exception(RefusedError(RECORDED))
        return future

    async def parameters(self, robot: str) -> list[dict[str, Any]]:
        """Refuse."""
        del robot
        raise RefusedError(RECORDED)

    def drive(self, robot: str, twist: Twist, age: float) -> None:
        """Do nothing."""
