"""The bag into which one looks back: how far it reaches, and some minutes of it saved."""

from __future__ import annotations

import asyncio
import time
from datetime import datetime, timezone
from typing import TYPE_CHECKING

from agv_motion.bag.editing.excerpt import save_excerpt
from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.dashboard.server.requests import RequestError
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from pathlib import Path

SECOND = 1_000_000_000


class History:
    """The bag into which one looks back, and how far it reaches."""

    renewal = 5.0
    """[s] between two looks at how far a bag reaches that is being written"""

    def __init__(self, bag: Path, saves: Path) -> None:
        """Look at nothing yet.

        Args:
            bag: Folder of the bag, which may still be written, or may not be there yet.
            saves: Folder into which excerpts go.

        """
        self.bag, self._saves = bag, saves
        self.watchers = 0
        self._span = 0.0, 0.0
        self._looked = -self.renewal
        self._turn = asyncio.Semaphore(1)

    def open(self) -> BagReader:
        """Open the bag as it is now.

        Raises:
            AgvMotionError: There is none, or it cannot be read at all.

        """
        return BagReader(self.bag)

    async def span(self) -> tuple[float, float]:
        """Return begin and end of the bag [s since 1970]; zeros as long as it has nothing."""
        async with self._turn:
            if time.monotonic() - self._looked >= self.renewal:
                self._span = await asyncio.to_thread(self._read_span)
                self._looked = time.monotonic()
        return self._span

    async def save(self, begin: float, end: float) -> tuple[str, int]:
        """Save what was recorded between two moments; return the folder and how many messages.

        Raises:
            AgvMotionError: There is no bag, or nothing in it then, or the disk takes no more.

        """
        async with self._turn:
            return await asyncio.to_thread(self._save, begin, end)

    def _read_span(self) -> tuple[float, float]:
        try:
            with self.open() as bag:
                return bag.start / SECOND, bag.end / SECOND
        except AgvMotionError:
            return 0.0, 0.0

    def _save(self, begin: float, end: float) -> tuple[str, int]:
        name = datetime.now(timezone.utc).strftime('around_%Y_%m_%d-%H_%M_%S_%f')
        folder = self._saves / name
        with self.open() as bag:
            first, last = int(begin * SECOND), int(end * SECOND)
            if not (bag.start <= last and first <= bag.end):
                msg = f'nothing was recorded then: the bag reaches from {bag.start / SECOND:.0f} '
                msg += f'to {bag.end / SECOND:.0f} s'
                raise RequestError(422, msg)
            with BagWriter(folder) as writer:
                return str(folder), save_excerpt(bag, writer, first, last)
