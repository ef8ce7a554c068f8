"""The robots of a ROS graph, as the server of the page sees them.

The server asks from its own thread; all of rclpy happens in the thread of the node, which takes
what is asked within some hundredths of a second.
"""

from __future__ import annotations

import asyncio
import time
from collections import deque
from contextlib import suppress
from functools import cache, partial
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.server.fleet import NoAnswerError, RefusedError
from agv_motion.nodes.catalogue import available, parameters_of
from agv_motion.nodes.robot_acts import RobotActs
from agv_motion.nodes.robot_listener import RobotListener
from agv_motion.nodes.robot_parameters import RobotParameters
from agv_motion.nodes.robot_platform import read_platform
from agv_motion.nodes.robot_services import RobotServices
from agv_motion.parameters import nested, rows

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator

    from agv_motion.dashboard.core.board import Board
    from agv_motion.planar import Twist
    from agv_motion.ros.live_port import LivePort


AGAIN, RARELY = 3.0, 30.0
"""[s] until a robot is asked for its shape again that has not told it, and that has"""


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
        self._parameters = RobotParameters(self._services, port.node.get_node_names_and_namespaces)
        self._acts = RobotActs(port, self._services, self._parameters)
        self._shapes: dict[str, float] = {}
        """when each robot is to be asked for its shape again [s, steady]"""
        self._listener = RobotListener(port, board, only)
        self._acts.clock = lambda: self._listener.simulated_time() or port.nanoseconds()
        self.publisher = self._acts.publisher
        """returns the publisher of a message class and a topic; in the thread of the node"""
        self._acts.factor = lambda: 1.0 if board.factor is None else max(board.factor, 0.0)
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
        return self._ask(lambda answer: self._acts.begin(robot, action, arguments, answer))

    async def parameters(self, robot: str) -> list[dict[str, Any]]:
        """Return each node of a robot with what there is to know of its parameters."""
        read = await self._ask(lambda answer: self._parameters.read(robot, answer))
        return [
            {'node': node, 'rows': await asyncio.to_thread(_with_defaults, node, rows)}
            for node, rows in read
        ]

    def _ask(self, begin: Callable[[Callable[[Any], None]], None]) -> asyncio.Future[Any]:
        """Return what comes of something that the thread of the node begins."""
        loop = asyncio.get_running_loop()
        future: asyncio.Future[Any] = loop.create_future()

        def answer(found: Any) -> None:
            with suppress(RuntimeError):  # the loop has ended meanwhile
                loop.call_soon_threadsafe(_settle, future, found)

        def guarded() -> None:
            try:
                begin(answer)
            except Exception as error:  # noqa: BLE001 - told to the person who asked
                answer(error)

        self._asked.append(guarded)
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
        now = time.monotonic()
        for robot in self.robots:
            self._acts.prepare(robot)
            if now >= self._shapes.get(robot, 0.0):
                self._shapes[robot] = now + AGAIN
                read_platform(self._parameters, robot, partial(self._take_shape, robot))

    def _take_shape(self, robot: str, shape: dict[str, Any]) -> None:
        if shape:
            self.board.set_platform(robot, shape)
            self._shapes[robot] = time.monotonic() + RARELY

    def take(self) -> None:
        """Take what has come."""
        self._listener.take(self.now())

    def close(self) -> None:
        """Hear and ask no more."""
        self._asked.clear()
        self._drives.clear()


def _settle(future: asyncio.Future[Any], found: Any) -> None:
    """Give a future its end, in the thread of its loop."""
    if future.done():
        return
    if isinstance(found, Exception):
        known = isinstance(found, (RefusedError, NoAnswerError))
        future.set_exception(found if known else RefusedError(str(found)))
    else:
        future.set_result(found)


def _with_defaults(node: str, rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return rows with the defaults of a node of this package; None where nobody knows them."""
    defaults = _defaults(node)
    return [row | {'default': defaults.get(row['name'])} for row in rows]


@cache
def _defaults(node: str) -> dict[str, Any]:
    if node not in available():
        return {}
    return dict(_flat(parameters_of(node)(), ''))


def _flat(values: Any, prefix: str) -> Iterator[tuple[str, Any]]:
    for name, _, _ in rows(type(values)):
        value = getattr(values, name)
        yield prefix + name, list(value) if isinstance(value, tuple) else value
    for name, _ in nested(type(values)):
        yield from _flat(getattr(values, name), f'{prefix}{name}.')
