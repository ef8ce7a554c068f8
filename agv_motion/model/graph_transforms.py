"""`/tf` and `/tf_static` of all robots of a graph, from the bytes of what they say.

Where tf2_msgs is not installed nobody can publish transforms. Whoever hears all messages (a
recorder, a server of live data) makes them here from what every robot says in its namespace:
`robot_description`, `joint_states`, `odom`, and `pose`, or `fix` as long as there is no `pose`.
"""

from __future__ import annotations

from math import atan2, inf, isfinite
from typing import TYPE_CHECKING

from agv_motion.errors import AgvMotionError, SignalError
from agv_motion.model.cdr_reader import CdrReader
from agv_motion.model.robot_transforms import RobotTransforms
from agv_motion.model.stamped_reader import StampedReader
from agv_motion.model.transform_message import TF, TF_STATIC, encoded
from agv_motion.model.urdf_reading import read_urdf
from agv_motion.planar import FARTHEST, Pose

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.model.robot_model import RobotModel
    from agv_motion.model.transform import Transform

    Told = list[tuple[str, bytes]]
    """topic and message in CDR of each that follows"""

SOURCES = {
    'robot_description': 'std_msgs/msg/String',
    'joint_states': 'sensor_msgs/msg/JointState',
    'odom': 'nav_msgs/msg/Odometry',
    'pose': 'geometry_msgs/msg/PoseWithCovarianceStamped',
    'fix': 'geometry_msgs/msg/PoseWithCovarianceStamped',
}
"""Topics in the namespace of a robot, and their types"""
MOST = 200
"""Robots on a graph"""
ANY_HEADING = 3.0
"""[rad2] Variance of a heading that may be any"""
POSE, COVARIANCE = 7, 36
"""Numbers of a geometry_msgs/Pose, and of the covariance behind it"""
YAW = 35
"""Place of the variance of the heading among the numbers of a covariance"""


class GraphTransforms:
    """Takes messages of any robot, and returns the messages about transforms that follow.

    ::

        transforms = GraphTransforms()
        if transforms.wants(topic, message_type):
            for tf_topic, tf_data in transforms.take(topic, data):
                ...  # of the type transform_message.TYPE, in CDR
    """

    def __init__(self, hold: float = inf) -> None:
        """Know no robot yet.

        Args:
            hold: How long the place of `odom` in the map counts after a pose [s]; see
                `RobotTransforms`.

        """
        self.refused = ''
        """Why the last message that could not be used was not; empty if all could"""
        self._hold = hold
        self._robots: dict[str, _Robot] = {}
        self._take = {name: getattr(self, f'_take_{name}') for name in SOURCES}

    @staticmethod
    def wants(topic: str, message_type: str) -> bool:
        """Return whether transforms follow from a topic of this type."""
        return SOURCES.get(topic.rpartition('/')[2]) == message_type

    def take(self, topic: str, data: bytes) -> Told:
        """Return what follows from a message; nothing from one that cannot be used."""
        namespace, _, name = topic.rpartition('/')
        robot = self._robots.get(namespace)
        if robot is None:
            if len(self._robots) >= MOST:
                return []
            robot = self._robots[namespace] = _Robot(namespace, self._hold)
        try:
            before = robot.fixed
            transforms = self._take[name](robot, data)
        except AgvMotionError as error:
            self.refused = f'{topic}: {error}'
            return []
        told: Told = [(TF, encoded(transforms))] if transforms else []
        if robot.fixed != before:
            told.insert(0, (TF_STATIC, self.static()))
        return told

    def static(self) -> bytes:
        """Return all transforms that hold for good, as one message for ``/tf_static``."""
        return encoded(one for robot in self._robots.values() for one in robot.fixed)

    def last(self) -> Told:
        """Return what there is to tell at the end of a recording."""
        found = [one for robot in self._robots.values() for one in robot.transforms.last()]
        return [(TF, encoded(found))] if found else []

    # What each topic tells

    def _take_robot_description(self, robot: _Robot, data: bytes) -> list[Transform]:
        robot.describe(read_urdf(CdrReader(data).text()))
        return []

    def _take_joint_states(self, robot: _Robot, data: bytes) -> list[Transform]:
        stamp, (frame, names), positions = robot.read.joints.read(data)
        robot.note_base(frame, stamp)
        if len(names) != len(positions):  # of joints of which only rates are told
            return []
        return robot.transforms.take_joints(stamp, dict(zip(names, positions, strict=True)))

    def _take_odom(self, robot: _Robot, data: bytes) -> list[Transform]:
        stamp, (frame, child), numbers = robot.read.odom.read(data)
        pose = _pose(numbers)
        robot.note_base(child, stamp)
        return robot.transforms.take_odometry(stamp, frame, child, pose)

    def _take_pose(self, robot: _Robot, data: bytes) -> list[Transform]:
        robot.is_located = True
        stamp, frame, numbers = robot.read.pose.read(data)
        return robot.transforms.take_pose(stamp, frame, _pose(numbers))

    def _take_fix(self, robot: _Robot, data: bytes) -> list[Transform]:
        """Take a fix for a pose: one with a heading, of a robot that no localization locates."""
        stamp, frame, numbers = robot.read.fix.read(data)
        pose, variance = _pose(numbers), numbers[POSE + YAW]
        if robot.is_located or not 0.0 < variance <= ANY_HEADING:
            return []
        return robot.transforms.take_pose(stamp, frame, pose)

    def expect(self, topic: str) -> None:
        """Note that a topic has a publisher: where a ``pose`` is silent, no fix stands in."""
        namespace, _, name = topic.rpartition('/')
        if name == 'pose' and len(self._robots) < MOST:
            self._robots.setdefault(namespace, _Robot(namespace, self._hold)).is_located = True


class _Readers:
    """What reads each topic of a robot: its frames and joints stay as they are."""

    def __init__(self) -> None:
        self.odom = StampedReader(lambda message: ((message.text(), message.text()), POSE))
        self.pose = StampedReader(lambda message: (message.text(), POSE))
        self.fix = StampedReader(lambda message: (message.text(), POSE + COVARIANCE))
        self.joints = StampedReader(
            lambda message: ((message.text(), message.texts()), message.count())
        )


class _Robot:
    """One robot, and by what name it goes."""

    def __init__(self, namespace: str, hold: float) -> None:
        prefix = f'{namespace.lstrip("/")}/' if namespace.strip('/') else ''
        self.transforms = RobotTransforms(None, prefix, hold)
        self.fixed: list[Transform] = []
        """told on ``/tf_static``"""
        self.is_located = False
        """Whether a localization tells its pose"""
        self.read = _Readers()
        self._base: tuple[str, int] | None = None

    def describe(self, model: RobotModel) -> None:
        self.transforms.model = model
        if self._base is not None:
            base, self._base = self._base, None
            self.note_base(*base)

    def note_base(self, frame: str, stamp: int) -> None:
        """Take the prefix from the frame of the base, and tell what is fixed to it."""
        if self._base is not None or not frame:
            return
        self._base, model = (frame, stamp), self.transforms.model
        if model is not None:
            if frame.endswith(model.root):
                self.transforms.prefix = frame.removesuffix(model.root)
            self.fixed = self.transforms.fixed(stamp)


def _pose(numbers: Sequence[float]) -> Pose:
    """Return the planar part of a geometry_msgs/Pose, by its numbers.

    Raises:
        SignalError: It is none.

    """
    x, y, _, qx, qy, qz, qw = numbers[:POSE]
    norm = qx * qx + qy * qy + qz * qz + qw * qw
    if not (isfinite(x + y) and max(abs(x), abs(y)) <= FARTHEST and abs(norm - 1.0) <= 0.01):
        msg = f'a pose at ({x:g}, {y:g}) with a quaternion of the length {norm**0.5:g} is none'
        raise SignalError(msg)
    heading = atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz))
    return Pose(x, y, heading)
