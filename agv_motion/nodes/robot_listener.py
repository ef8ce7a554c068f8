"""What `dashboard` hears: robots found on the graph by themselves, their topics newest only."""

from __future__ import annotations

from struct import Struct
from typing import TYPE_CHECKING, Any

from agv_motion.dashboard.core.names import (
    MOST_ROBOTS,
    SIGNS,
    namespace_of,
    split,
    type_of,
)
from agv_motion.errors import ConfigurationError
from agv_motion.ros.cdr import codec
from agv_motion.ros.endpoints import message_class
from agv_motion.ros.newest import NewestSubscription
from agv_motion.ros.raw_subscription import ListenerNodes

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from agv_motion.dashboard.core.board import Board
    from agv_motion.ros.live_port import LivePort

_TIME = Struct('<iI'), Struct('>iI')
DEPTHS = {'diagnostics': 60, 'reservations': 30}
"""messages that are kept of topics on which many speak"""


class _Topic:
    """One topic that is heard."""

    def __init__(
        self, robot: str, relative: str, subscription: NewestSubscription,
        decode: Callable[[bytes], Any],
    ) -> None:  # fmt: skip
        self.robot, self.relative = robot, relative
        self.subscription, self.decode = subscription, decode
        self.publishers = 0


class RobotListener:
    """Subscribes to what the page knows, once it is there, and hands the newest to a board."""

    def __init__(self, port: LivePort, board: Board, only: Collection[str]) -> None:
        """Join the graph; hear nothing yet.

        Args:
            port: Of the node.
            board: Takes what is heard.
            only: Names of the robots that are shown; empty: all that are found.

        """
        self._port, self._board, self._only = port, board, frozenset(only)
        self._listeners = ListenerNodes(port.name, port.node.context)
        port.close_later(self._listeners.close)
        self._topics: dict[str, _Topic] = {}
        self._passed_over: set[str] = set()
        self._clock: int | None = None

    @property
    def robots(self) -> list[str]:
        """Names of the robots that were ever seen."""
        return sorted(self._board.robots)

    def look(self) -> None:
        """Look who is on the graph, and subscribe to what is new."""
        found = [
            (topic, *known, types)
            for topic, types in self._port.node.get_topic_names_and_types()
            if (known := split(topic)) is not None
        ]
        for topic, robot, relative, _ in found:
            if relative in SIGNS and self._shown(robot) and self._port.count_publishers(topic):
                self._meet_robot(robot)
        for topic, robot, relative, types in found:
            if not robot or robot in self._board.robots:
                self._meet(topic, robot, relative, types)

    def simulated_time(self) -> int | None:
        """Return what a simulation tells on `/clock` now [ns]; None where time is real."""
        clock = self._topics.get('/clock')
        if clock is None or not clock.publishers:
            return None
        for data in clock.subscription.take():
            self._clock = _nanoseconds(data)
        return self._clock

    def take(self, now: float) -> None:
        """Hand on what has come, as of ``now`` [s] on the clock of the board."""
        receive = self._board.receive
        for topic in self._topics.values():
            for data in topic.subscription.take():
                if topic.relative == 'clock':
                    self._clock = _nanoseconds(data)
                receive(topic.robot, topic.relative, now, data, topic.decode)

    def close(self) -> None:
        """Hear no more."""
        for topic in self._topics.values():
            topic.subscription.close()
        self._topics.clear()

    def _shown(self, robot: str) -> bool:
        return bool(robot) and (not self._only or robot in self._only)

    def _meet_robot(self, robot: str) -> None:
        if robot in self._board.robots:
            return
        if self._board.robot(robot) is not None:
            self._port.info(f'{robot} is there ({namespace_of(robot) or "/"})')
        elif robot not in self._passed_over:
            self._passed_over.add(robot)
            self._port.warning(
                f'{robot} is not shown: the page has {MOST_ROBOTS} robots already; name those to '
                'be shown by the parameter robots'
            )

    def _meet(self, topic: str, robot: str, relative: str, types: list[str]) -> None:
        """Hear a topic; its publishers are looked at again when their number has changed."""
        count = self._port.count_publishers(topic)
        heard = self._topics.get(topic)
        if not count or (heard is not None and heard.publishers == count):
            return
        if heard is None:
            heard = self._subscribe(topic, robot, relative, types)
            if heard is None:
                return
        heard.publishers = count
        expected = type_of(relative)
        publishers = self._port.node.get_publishers_info_by_topic(topic)
        heard.subscription.meet([one for one in publishers if one.topic_type == expected])

    def _subscribe(self, topic: str, robot: str, relative: str, types: list[str]) -> _Topic | None:
        expected = type_of(relative)
        if topic in self._passed_over:
            return None
        if types != [expected]:
            self._pass_over(topic, f'is {", ".join(types)}, expected {expected}')
            return None
        try:
            kind = message_class(expected)
        except ConfigurationError as error:
            self._pass_over(topic, str(error))
            return None
        node, depth = self._listeners.node(0), DEPTHS.get(relative, 1)
        made = _Topic(
            robot, relative, NewestSubscription(node, topic, kind, depth), codec(kind).decode
        )
        self._topics[topic] = made
        return made

    def _pass_over(self, topic: str, why: str) -> None:
        self._passed_over.add(topic)
        self._port.warning(f'{topic} is not shown: it {why}')


def _nanoseconds(clock: bytes) -> int:
    """Return the time in a rosgraph_msgs/Clock [ns]."""
    seconds, rest = _TIME[not clock[1] & 1].unpack_from(clock, 4)
    return int(seconds) * 1_000_000_000 + int(rest)
