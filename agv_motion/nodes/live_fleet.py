"""The robots of a ROS graph, as the server of the page sees them.

The server asks from its own thread; all of rclpy happens in the thread of the node, which takes
what is asked within some hundredths of a second.
"""

from __future__ import annotations

import asyncio
import time
from collections import deque
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.server.fleet import NoAnswerError, RefusedError
from agv_motion.nodes.robot_acts import RobotActs
from agv_motion.nodes.robot_listener import RobotListener
from agv_motion.nodes.robot_services import RobotServices

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from agv_motion.dashboard.core.board import Board
    from agv_motion.planar import Twist
    from agv_motion.ros.live_port import LivePort


class LiveFleet:
    """Implements `Fleet` on a graph."""

    def __init__(self, port: LivePort, board: Board, only: Collection[str]) -> None:
        """Hear nothing yet.

        Args:
            port: Of the node.
            board: Takes what is heard.
            only: Names of the robots that are shown; empty: all.

        """
        self.board = board
        self._wall = time.time() - time.monotonic()
        self._services = RobotServices(port)
        self._acts = RobotActs(port, self._services)
        self._listener = RobotListener(port, board, only)
        self._asked: deque[Callable[[], None]] = deque()
        self._drives: dict[str, tuple[Twist, float]] = {}
        """newest of each robot, and when it was [s, steady]"""

    # In the thread of the server

    @property
    def robots(self) -> list[str]:
        """Names of the robots that were ever seen."""
        return sorted(self.board.robots)

    def now(self) -> float:
        """Return seconds since 1970, by a clock that never leaps."""
        return self._wall + time.monotonic()

    def act(self, robot: str, action: str, arguments: dict[str, Any]) -> asyncio.Future[str]:
        """Begin an act in the thread of the node."""
        loop = asyncio.get_running_loop()
        future: asyncio.Future[str] = loop.create_future()

        def answer(words: str | Exception) -> None:
            loop.call_soon_threadsafe(_settle, future, words)

        def begin() -> None:
            try:
                self._acts.begin(robot, action, arguments, answer)
            except Exception as error:  # noqa: BLE001 - told to the person who asked
                answer(error)

        self._asked.append(begin)
        return future

    def drive(self, robot: str, twist: Twist, age: float) -> None:
        """Let a twist go out once, unless a newer one comes before."""
        self._drives[robot] = twist, time.monotonic() - age

    # In the thread of the node

    def send(self) -> None:
        """Do what was asked, and hand on what was answered."""
        while self._drives:
            robot, (twist, moment) = self._drives.popitem()
            self._acts.drive(robot, twist, time.monotonic() - moment)
        while self._asked:
            self._asked.popleft()()
        self._services.poll()

    def look(self) -> None:
        """Look at the graph."""
        self._listener.look()
        for robot in self.robots:
            self._acts.prepare(robot)

    def take(self) -> None:
        """Take what has come."""
        self._listener.take(self.now())

    def close(self) -> None:
        """Hear and ask no more."""
        self._asked.clear()
        self._drives.clear()


def _settle(future: asyncio.Future[str], words: str | Exception) -> None:
    """Give a future its end, in the thread of its loop."""
    if future.done():
        return
    if isinstance(words, str):
        future.set_result(words)
    else:
        known = isinstance(words, (RefusedError, NoAnswerError))
        future.set_exception(words if known else RefusedError(str(words)))
