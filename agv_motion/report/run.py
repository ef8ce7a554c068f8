"""A run in a bag as columns: where the robot was to be, where it was, and the ways it was shown."""

from __future__ import annotations

from math import atan2
from operator import attrgetter
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.bag.message_objects import decoded
from agv_motion.bag.notes import notes_of
from agv_motion.errors import ConfigurationError
from agv_motion.report.recorded_footprint import moments, read_footprints
from agv_motion.report.stamped_columns import topics_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from agv_motion.bag.notes import Note
    from agv_motion.bag.reader import BagReader
    from agv_motion.model.footprint import Footprint

    Column = NDArray[np.float64]

PLANNED = ('ghost/pose',)
DRIVEN = ('ground_truth', 'pose', 'odom/filtered', 'odom', 'fix')
"""Topics that tell a pose, by the ends of their names, the most trusted first."""

POSES = {
    'geometry_msgs/msg/PoseStamped': 'pose',
    'geometry_msgs/msg/PoseWithCovarianceStamped': 'pose.pose',
    'nav_msgs/msg/Odometry': 'pose.pose',
}
"""Where the pose stands in each type that has one."""


class Poses(NamedTuple):
    """A topic that tells poses, by the stamps of its messages."""

    topic: str
    frame: str
    time: Column
    """(n,) [s], rising"""
    pose: Column
    """(n, 3) x [m], y [m], heading [rad]"""


class RunBag(NamedTuple):
    """What a bag tells of a run."""

    planned: Poses | None
    """Of the Ghost"""
    driven: Poses
    ways: dict[str, list[Column]]
    """(n, 2) places of each path that was shown [m], by topic"""
    way_frames: frozenset[str] = frozenset()
    """Of all those paths"""
    footprints: list[Footprint] | None = None
    """of the robot at its `moments`; None where the bag does not tell its size"""
    notes: tuple[Note, ...] = ()
    """what somebody noted while the robot was on its way"""

    def distance(self) -> float:
        """Return how far the robot went [m]."""
        return float(np.hypot(*np.diff(self.driven.pose[:, :2], axis=0).T).sum())

    def duration(self) -> float:
        """Return how long it was on its way [s]."""
        return float(self.driven.time[-1] - self.driven.time[0])


def read_run(bag: BagReader, planned: str = '', driven: str = '') -> RunBag:
    """Read a run.

    Args:
        bag: Open.
        planned: Topic of the Ghost; empty: found by its name, if there is one.
        driven: Topic of the robot; empty: found by name, in the frame of the Ghost where it can.

    Raises:
        SourceError: The bag is damaged.
        ConfigurationError: It has no such topic, or nothing that tells where the robot was.

    """
    told = _tell(bag, topics_of(bag, POSES))
    frames: set[str] = set()
    ways = {topic: _ways(bag, topic, frames) for topic in topics_of(bag, ['nav_msgs/msg/Path'])}
    ghost = _pick(told, planned, PLANNED, '')
    robot = _pick(told, driven, DRIVEN, ghost.frame if ghost else '')
    if robot is None:
        has = ', '.join(sorted(bag.topics))
        msg = f'{bag.path} does not tell where the robot was; it has {has}'
        raise ConfigurationError(msg)
    stamps = robot.time[moments(len(robot.time))].tolist()
    footprints = read_footprints(bag, robot.topic, stamps)
    first, last = robot.time[0], robot.time[-1]
    notes = tuple(n for n in notes_of(bag.path) if first <= 1e-9 * n.stamp <= last)
    return RunBag(ghost, robot, ways, frozenset(frames), footprints, notes)


def _pick(told: dict[str, Poses], named: str, ends: Sequence[str], frame: str) -> Poses | None:
    """Return the topic that is named, or the first whose name ends so; in ``frame`` if one is."""
    if named:
        topic = f'/{named.lstrip("/")}'
        if topic not in told:
            msg = f'no poses on {topic}: there are {", ".join(sorted(told)) or "none at all"}'
            raise ConfigurationError(msg)
        return told[topic]
    found = [told[name] for name in named_so(told, ends)]
    inside = [poses for poses in found if poses.frame == frame]
    return next(iter([*inside, *found]), None)


def named_so(topics: Iterable[str], ends: Sequence[str]) -> list[str]:
    """Return the topics whose names end so, in the order of ``ends``."""
    names = list(topics)
    return [name for end in ends for name in names if name.endswith(f'/{end}')]


def _tell(reader: BagReader, topics: list[str]) -> dict[str, Poses]:
    rows: dict[str, list[tuple[float, ...]]] = {topic: [] for topic in topics}
    frames: dict[str, str] = {}
    for message, content in decoded(reader, topics):
        topic = message.connection.topic
        pose = attrgetter(POSES[message.connection.type])(content)
        q, p, stamp = pose.orientation, pose.position, content.header.stamp
        heading = atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
        rows[topic].append((stamp.sec + 1e-9 * stamp.nanosec, p.x, p.y, heading))
        frames[topic] = content.header.frame_id
    told = {}
    for topic, found in rows.items():
        if found:
            table = np.array(found)
            _, first = np.unique(table[:, 0], return_index=True)
            told[topic] = Poses(topic, frames[topic], table[first, 0], table[first, 1:])
    return told


def _ways(reader: BagReader, topic: str, frames: set[str]) -> list[Column]:
    """Return the paths on a topic, and add their frames to ``frames``."""
    ways = []
    for _, content in decoded(reader, [topic]):
        places = [(p.pose.position.x, p.pose.position.y) for p in content.poses]
        if len(places) > 1:
            ways.append(np.array(places))
            frames.add(content.header.frame_id)
    return ways
