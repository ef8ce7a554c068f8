"""Where a robot is: the pose that its topic tells, how old that is, and why it cannot be used."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.planar import Pose, Twist, integrate
from agv_motion.ros.input_watch import InputWatch
from agv_motion.ros.messages import pose_of, seconds_of
from agv_motion.ros.qos import SENSOR
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from agv_motion.nodes.driving_parameters import DrivingParameters
    from agv_motion.ros.port import Port

OLDEST_POSE = 0.3
"""[s] An older pose, or one from another clock, is taken as of now."""


class PoseInput:
    """Listens to `odom` or `pose`, in the one frame in which the robot is driven."""

    def __init__(self, port: Port, given: DrivingParameters) -> None:
        """Listen, and know nothing."""
        self._port, self._given = port, given
        self._watch = InputWatch(port, given.position, given.freshness(), loss='the robot stops')
        self._time = 0.0
        self.begin()
        kind = Odometry if given.drives_by_odom else PoseWithCovarianceStamped
        port.listen(kind, given.position, self._on_pose, SENSOR, sole=True)
        port.need(given.position)

    def begin(self) -> None:
        """Know nothing of before: where the robot is must be told anew."""
        self._pose: Pose | None = None
        self.lost = f'no {self._given.position} yet'
        """Why the pose cannot be used; empty if it can"""

    @property
    def measured(self) -> Pose | None:
        """The pose as it was told last; None while it is lost."""
        return None if self.lost else self._pose

    def now(self, twist: Twist) -> Pose | None:
        """Return the pose, carried on by the ``twist`` commanded since; None while it is lost."""
        pose = self.measured
        if pose is None:
            return None
        age = self._port.seconds() - self._time
        return integrate(pose, twist, age) if 0.0 < age < OLDEST_POSE else pose

    def require(self, twist: Twist) -> Pose:
        """Return the same.

        Raises:
            SignalError: Nobody knows where the robot is.

        """
        pose = self.now(twist)
        if pose is None:
            msg = f'{self.lost}: where the robot is must be known before it can go anywhere'
            if not self._given.drives_by_odom:
                msg += ': tell its localization (topic initialpose), or let it move'
            raise SignalError(msg)
        return pose

    def require_frame(self, frame: str) -> None:
        """Raise unless ``frame`` is the one in which the robot is driven.

        Raises:
            ConfigurationError: It is another.

        """
        given = self._given
        if given.named(frame) not in {'', given.frame}:
            msg = (
                f"frame '{frame}': this node drives in '{given.frame}'; transform it "
                'first, or set the parameter frame'
            )
            raise ConfigurationError(msg)

    def look(self) -> bool:
        """Judge the silence; return whether to stop: again and again while the clock stands."""
        before, self.lost = self.lost, self._why_lost()
        return bool(self.lost) and (bool(self._port.clock.fault) or not before)

    def _on_pose(self, message: Any) -> None:
        self.require_frame(message.header.frame_id)
        pose = pose_of(message.pose.pose)
        if self._watch.is_news(message.header.stamp):
            self._watch.note()
            self._pose, self._time = pose, seconds_of(message.header.stamp)
            self.lost = ''

    def _why_lost(self) -> str:
        """Return why the pose cannot be used; empty if it can."""
        watch, given, port = self._watch, self._given, self._port
        if watch.tell() is not Silence.LOST:
            return ''
        silent = watch.age(port.steady_seconds()) is not None and not port.clock.fault
        return f'no {given.position} for {given.stop_after:g} s' if silent else watch.why()
