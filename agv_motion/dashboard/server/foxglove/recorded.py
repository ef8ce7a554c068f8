"""The endpoint over a bag: each client plays it by itself, by its controls or by parameters."""

from __future__ import annotations

import secrets
from typing import TYPE_CHECKING

from agv_motion.bag.reader import BagReader
from agv_motion.dashboard.foxglove.parsing import parsed
from agv_motion.dashboard.foxglove.playback import require_rate
from agv_motion.dashboard.foxglove.protocol import NEWER
from agv_motion.dashboard.foxglove.requests import ProtocolError
from agv_motion.dashboard.server.foxglove.recorded_topics import recorded_topics
from agv_motion.dashboard.server.foxglove.viewing import Viewing
from agv_motion.errors import AgvMotionError

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.dashboard.server.foxglove.client import FoxgloveClient


class RecordedRoom:
    """Implements `EndpointRoom` for a bag."""

    def __init__(self, path: Path, rate: float = 1.0) -> None:
        """Look what is in a bag.

        Args:
            path: Of the bag.
            rate: Seconds of it in a second, at first.

        Raises:
            AgvMotionError: There is no bag, it cannot be read at all, or the rate is out of range.

        """
        require_rate(rate)
        self.path, self.rate = path, rate
        self.session = secrets.token_hex(8)
        self.contents = recorded_topics(path)
        self._viewings: dict[FoxgloveClient, Viewing] = {}

    def open(self) -> BagReader:
        """Return the bag, opened anew.

        Raises:
            SourceError: It is gone meanwhile.

        """
        return BagReader(self.path)

    def welcome(self, client: FoxgloveClient, subprotocol: str) -> None:
        """Tell a new client what is in the bag, and play it."""
        try:
            viewing = Viewing(self, client, controls=subprotocol == NEWER)
        except AgvMotionError as error:  # the bag is gone meanwhile
            client.refuse(error)
            client.wire.finish()
            return
        self._viewings[client] = viewing
        viewing.begin()

    def hear(self, client: FoxgloveClient, message: str | bytes) -> None:
        """Do what it asks."""
        viewing = self._viewings.get(client)
        try:
            if viewing is not None:
                viewing.do(parsed(message))
        except ProtocolError as error:
            client.refuse(error)

    def leave(self, client: FoxgloveClient) -> None:
        """Serve it no more."""
        viewing = self._viewings.pop(client, None)
        if viewing is not None:
            viewing.end()

    async def run(self) -> None:
        """Do nothing: each viewing runs by itself."""
