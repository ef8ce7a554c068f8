"""A day of all robots, read back from the bags of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.bag.message_objects import decoded
from agv_motion.errors import SourceError
from agv_motion.report.daily_robot import RobotDay

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.bag.reader import BagReader

SECOND = 1e-9
TYPES = {
    'pose': 'geometry_msgs/msg/PoseWithCovarianceStamped',
    'odom': 'nav_msgs/msg/Odometry',
    'zone': 'std_msgs/msg/String',
    'goal': 'geometry_msgs/msg/PoseStamped',
    'driver': 'diagnostic_msgs/msg/DiagnosticStatus',
    'why': 'diagnostic_msgs/msg/DiagnosticArray',
    'granier/water_use_today': 'geometry_msgs/msg/Vector3Stamped',
}
"""Topics of a robot that count, and their types"""

DIAGNOSTICS = '/diagnostics'
ALONE = 'robot'
"""How a robot without a namespace is called"""

SIGNS = frozenset({'pose', 'odom', 'driver', 'why'})
"""Who speaks on one of these is a robot."""

MOST_ROBOTS = 20


class Day(NamedTuple):
    """A day, or what a bag holds of it; seconds since 1970."""

    begin: float
    end: float
    robots: list[RobotDay]


def read_day(bags: Iterable[BagReader], begin: int | None = None, end: int | None = None) -> Day:
    """Return what the robots of some bags did.

    Args:
        bags: One after the other in time.
        begin: [ns since 1970] where the day begins; None: with the first bag.
        end: [ns since 1970] where it ends; None: with the last bag.

    Raises:
        SourceError: No bag holds anything of a robot, or one is damaged.

    """
    robots: dict[str, RobotDay] = {}
    first, last = float('inf'), float('-inf')
    for bag in bags:
        first, last = min(first, bag.start * SECOND), max(last, bag.end * SECOND)
        _read(bag, robots, begin, end)
    if not robots:
        names = ', '.join(str(bag.path) for bag in bags)
        msg = f'no robot in {names}: a report needs one of {", ".join(sorted(SIGNS))}'
        raise SourceError(msg)
    return Day(
        first if begin is None else begin * SECOND,
        last if end is None else end * SECOND,
        [robots[name] for name in sorted(robots)],
    )


def _read(bag: BagReader, robots: dict[str, RobotDay], begin: int | None, end: int | None) -> None:
    topics = _topics(bag)
    for namespace in sorted({n for n, kind in topics.values() if kind in SIGNS})[:MOST_ROBOTS]:
        robots.setdefault(namespace, RobotDay(namespace.strip('/') or ALONE))
    wanted = [topic for topic, (namespace, _) in topics.items() if namespace in robots]
    if DIAGNOSTICS in bag.topics:
        wanted.append(DIAGNOSTICS)
    for message, content in decoded(bag, wanted, begin, end):
        time = message.stamp * SECOND
        if message.connection.topic == DIAGNOSTICS:
            _take_reports(robots, time, content)
        else:
            namespace, kind = topics[message.connection.topic]
            _take(robots[namespace], kind, time, content)


def _topics(bag: BagReader) -> dict[str, tuple[str, str]]:
    """Return namespace and kind of the topics that count; odometry only where no pose is told."""
    found = {}
    for connection in bag.connections:
        for kind, wanted in TYPES.items():
            if connection.type == wanted and connection.topic.endswith(f'/{kind}'):
                found[connection.topic] = connection.topic.removesuffix(f'/{kind}'), kind
    told = {namespace for namespace, kind in found.values() if kind == 'pose'}
    return {
        topic: (namespace, kind) for topic, (namespace, kind) in found.items()
        if kind != 'odom' or namespace not in told
    }  # fmt: skip


def _take(robot: RobotDay, kind: str, time: float, content: Any) -> None:
    if kind in {'pose', 'odom'}:
        robot.add_place(content.pose.pose.position)
    elif kind == 'goal':
        robot.add_goal(time, content.pose.position)
    elif kind == 'zone':
        robot.zone = content.data
    elif kind == 'driver':
        robot.add_driver(time, content)
    elif kind == 'granier/water_use_today':
        robot.add_litres(content.vector)
    else:
        robot.add_reasons(time, content)


def _take_reports(robots: dict[str, RobotDay], time: float, content: Any) -> None:
    for status in content.status:
        namespace, _, node = str(status.name).rpartition('/')
        if namespace in robots:
            robots[namespace].add_report(node, time, status)
