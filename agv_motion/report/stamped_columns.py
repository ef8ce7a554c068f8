"""Topics of a bag as columns, stamped as their headers say, in the order of those stamps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.bag.message_objects import decoded
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable

    from agv_motion.bag.reader import BagReader

Array = NDArray[np.float64]

POSES = ('nav_msgs/msg/Odometry', 'geometry_msgs/msg/PoseWithCovarianceStamped')
JOINTS = 'sensor_msgs/msg/JointState'


class PoseColumns(NamedTuple):
    """Odometry, or poses with covariance."""

    stamp: Array
    """(n,) [s]"""
    pose: Array
    """(3, n) x [m], y [m], heading [rad]"""
    covariance: Array
    """(6, n) xx, xy, xt, yy, yt, tt"""


class JointColumns(NamedTuple):
    """Joint states in which all joints are."""

    stamp: Array
    """(n,) [s]"""
    position: Array
    """(joints, n); NaN where the messages have none"""
    velocity: Array
    """(joints, n); NaN where the messages have none"""


def topics_of(bag: BagReader, types: Collection[str]) -> list[str]:
    """Return the topics of a bag all of whose messages are of some types."""
    others = {connection.topic for connection in bag.connections if connection.type not in types}
    return [topic for topic in bag.topics if topic not in others]


def pose_columns(bag: BagReader, topics: Iterable[str]) -> list[PoseColumns]:
    """Return topics of nav_msgs/Odometry or geometry_msgs/PoseWithCovarianceStamped.

    Raises:
        SourceError: The bag is damaged.
        ConfigurationError: It does not have one of the topics, or one is of another type.

    """
    columns, topics = [], list(topics)
    require_type(bag, topics, POSES)
    for rows in _rows(bag, topics, _pose_row):
        table = np.array(rows, dtype=float).reshape(len(rows), 10).T
        columns.append(PoseColumns(*_in_order(table[0], table[1:4], table[4:])))
    return columns


def joint_columns(bag: BagReader, topic: str, names: list[str]) -> JointColumns:
    """Return a topic of sensor_msgs/JointState; messages that lack one of ``names`` are left out.

    Raises:
        SourceError: The bag is damaged.
        ConfigurationError: It does not have the topic, that is of another type, or no message has
            all the names.

    """
    require_type(bag, [topic], (JOINTS,))
    seen: set[str] = set()

    def row(message: Any) -> tuple[float, ...] | None:
        seen.update(message.name)
        index = {name: i for i, name in enumerate(message.name)}
        if any(name not in index for name in names):
            return None
        places = [index[name] for name in names]
        return (
            _seconds(message),
            *(_picked(message.position, places)),
            *(_picked(message.velocity, places)),
        )

    (rows,) = _rows(bag, [topic], row)
    if not rows:
        msg = f'{topic} has joints {sorted(seen)}, expected {names}: give their names as they are'
        raise ConfigurationError(msg)
    table = np.array(rows, dtype=float).T
    return JointColumns(*_in_order(table[0], table[1 : 1 + len(names)], table[1 + len(names) :]))


def require_type(bag: BagReader, topics: Collection[str], types: Collection[str]) -> None:
    """Refuse topics that are not there, or of another type than ``types``.

    Raises:
        ConfigurationError: One is; fitting ones are named.

    """
    bag.require(topics)
    for connection in bag.connections:
        if connection.topic in topics and connection.type not in types:
            fitting = sorted(topics_of(bag, types))
            msg = f'{connection.topic} is {connection.type}, expected {" or ".join(types)}: ' + (
                f'choose one of {", ".join(fitting)}' if fitting else 'the bag has none'
            )
            raise ConfigurationError(msg)


def _rows(
    bag: BagReader, topics: Iterable[str], row: Callable[[Any], tuple[float, ...] | None]
) -> list[list[tuple[float, ...]]]:
    rows: dict[str, list[tuple[float, ...]]] = {name: [] for name in topics}
    for message, content in decoded(bag, rows):
        found = row(content)
        if found is not None:
            rows[message.connection.topic].append(found)
    return list(rows.values())


def _pose_row(message: Any) -> tuple[float, ...]:
    pose, c = message.pose.pose, message.pose.covariance
    q = pose.orientation
    heading = np.arctan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
    return (
        _seconds(message), pose.position.x, pose.position.y, float(heading),
        c[0], c[1], c[5], c[7], c[11], c[35],
    )  # fmt: skip


def _seconds(message: Any) -> float:
    return float(message.header.stamp.sec) + 1e-9 * float(message.header.stamp.nanosec)


def _picked(values: Any, places: list[int]) -> list[float]:
    whole = len(values) > max(places, default=-1)
    return [float(values[i]) for i in places] if whole else [np.nan] * len(places)


def _in_order(stamp: Array, *tables: Array) -> tuple[Array, ...]:
    """Return columns in the order of their stamps, the first of those that share one."""
    _, first = np.unique(stamp, return_index=True)
    return stamp[first], *(table[:, first] for table in tables)
