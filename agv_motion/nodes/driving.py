"""What nodes share that drive a robot by its pose: `odom` in, `cmd_vel` out, never a silent end."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from std_msgs.msg import String

from agv_motion.activity import Activity, Cause
from agv_motion.blocked import BlockedParameters
from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.kinematics.differential_platform import TrackParameters
from agv_motion.nodes.blocked_report import BlockedReport
from agv_motion.nodes.input_parameters import CommandParameters
from agv_motion.parameters import Spec, check
from agv_motion.planar import REST, Pose, Twist, integrate
from agv_motion.ros.input_watch import InputWatch
from agv_motion.ros.messages import pose_of, seconds_of
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import LATCHED, SENSOR
from agv_motion.ros.twist_rows import twist_publisher
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from agv_motion.ros.port import Port
    from agv_motion.twist_limits import TwistLimits


FAREWELL = 1.0
"""[s] How long zeros are sent after the end of a drive; then `cmd_vel` is free for others."""


INACTIVE = 'not active'
"""What it says to be doing as long as nobody activates it."""

LONGEST_STEP = 5
"""Cycles that pass at once at most: nothing runs away from a node that slept."""

OLDEST_POSE = 0.3
"""[s] An older pose, or one from another clock, is taken as of now."""


class PoseTopic(Enum):
    """The topic that tells where the robot is."""

    ODOM = 'odom'
    """nav_msgs/Odometry of its wheels, which drifts"""
    POSE = 'pose'
    """PoseWithCovarianceStamped of its localisation"""


@dataclass(frozen=True)
class DrivingParameters(CommandParameters, TrackParameters):
    """How often to command, and whom to believe where the robot is."""

    rate: Annotated[float, Spec('commands per second', 'Hz', (0.1, 1000.0))] = 20.0
    position: Annotated[
        str,
        Spec(
            'where the pose comes from: topic odom, or topic pose',
            choices=tuple(each.value for each in PoseTopic),
        ),
    ] = PoseTopic.ODOM.value
    frame: Annotated[
        str,
        Spec(
            'frame of the pose, and of all that is to be driven; that of odom gets the prefix, '
            'that of pose does not'
        ),
    ] = 'odom'
    blocked: BlockedParameters = field(default_factory=BlockedParameters)

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    @property
    def drives_by_odom(self) -> bool:
        """Whether `frame` is that of the robot's own odometry, rather than one of all robots."""
        return PoseTopic(self.position) is PoseTopic.ODOM

    def named(self, frame: str) -> str:
        """Return a frame that was told as `frame` is on the graph."""
        return self.own(frame) if self.drives_by_odom else frame.lstrip('/')

    def own_names(self) -> tuple[str, ...]:
        """Return which parameters name frames of the robot itself."""
        return (*super().own_names(), *(['frame'] * self.drives_by_odom))

    def shared_names(self) -> tuple[str, ...]:
        """Return which parameters name frames of all robots."""
        return (*super().shared_names(), *(['frame'] * (not self.drives_by_odom)))


P = TypeVar('P', bound=DrivingParameters)


class DrivingNode(PlainNode[P]):
    """A node that overrides `cycle`, and sends one command in each: `drive`, `stand` or `leave`.

    Every command keeps the limits that it overrides `limits` with. A robot that does not move
    though told to is blocked: `obstacle` tells so.
    """

    state_topic = 'state'
    """Where it says what the robot does"""

    release = ''
    """What a person does to let a blocked robot go on"""

    def __init__(self, port: Port, parameters: P) -> None:
        """Open the topics."""
        super().__init__(port, parameters)
        given = parameters
        self.pose: Pose | None = None
        self.lost = f'no {given.position} yet'
        """Why the pose cannot be used; empty if it can"""
        self._pose_time = 0.0
        self._twist = REST
        self.told = ''
        """The state told last"""
        self._pose_watch = InputWatch(
            port, given.position, given.freshness(), loss='the robot stops'
        )
        self._last_cycle: float | None = None
        self._farewell = 0.0
        self._activity, self._active_since = (Activity.STARTING, Cause.NOTHING), port.seconds()
        arm = 0.5 * self.limits().track
        self.guard = BlockedReport(port, given.blocked, arm, f'clear its way, then {self.release}')
        """Watches that the robot moves when told to"""
        self._command = twist_publisher(port, given.base_frame, stamped=given.stamped)
        self._state = port.publisher(String, self.state_topic, LATCHED, sole=True)
        if given.drives_by_odom:
            port.listen(Odometry, 'odom', self._on_pose, SENSOR, sole=True)
        else:
            port.listen(PoseWithCovarianceStamped, 'pose', self._on_pose, SENSOR, sole=True)
        port.every(1.0 / given.rate, self._on_cycle)
        port.watch_inputs(given.stop_after, self._watch)

    def begin(self) -> None:
        """Know nothing of before: where the robot is must be told anew."""
        self.pose, self.lost = None, f'no {self.parameters.position} yet'
        self._last_cycle = None
        self._twist, self._farewell = REST, 0.0
        self.guard.release()

    def halt(self) -> None:
        """Send the last word, no motion, and say so: who comes later hears what was said last."""
        self._send(REST)
        self.tell(INACTIVE)

    def limits(self) -> TwistLimits:
        """Return what no command may pass."""
        raise NotImplementedError

    def cycle(self, dt: float) -> None:
        """Command the robot, ``dt`` [s] after the last time."""
        raise NotImplementedError

    def activity(self) -> tuple[Activity, Cause]:
        """Return what the robot does, for programs, and what that goes back to."""
        raise NotImplementedError

    def hindered(self) -> tuple[Activity, Cause]:
        """Return the same of a robot with an `obstacle`."""
        if self.port.clock.fault:
            return Activity.STOPPED, Cause.CLOCK
        if self.lost:
            return Activity.STOPPED, Cause.POSE
        return Activity.BLOCKED, Cause.MOTION

    def activity_values(self) -> dict[str, str]:
        """Return the activity for the diagnostics, and since when it is that."""
        activity = self.activity()
        if activity != self._activity:
            self._activity, self._active_since = activity, self.port.seconds()
        return {
            'activity': activity[0].value,
            'because': activity[1].value,
            'since [s]': f'{self._active_since:.1f}',
        }

    def tell(self, state: str) -> None:
        """Say what the robot does, where that has changed."""
        if state != self.told:
            self.told = state
            self._state.publish(String(data=state))

    @property
    def obstacle(self) -> str:
        """Why the robot must not move now, in words; empty if it may."""
        return f'stopped: {self.lost}' if self.lost else self.guard.reason

    def drive(self, twist: Twist) -> None:
        """Move, within the limits."""
        self._farewell = FAREWELL
        self._send(self.limits().hold(twist))

    def stand(self) -> None:
        """Keep the robot where it is: zero, cycle after cycle."""
        self.drive(REST)

    def leave(self, dt: float) -> None:
        """Be done with the robot: zeros for a while, then silence, so that others may drive it."""
        self.guard.release()
        if self._farewell > 0.0:
            self._farewell -= dt
            self._send(REST)

    def pose_now(self) -> Pose | None:
        """Return the pose, carried on to now by what was commanded since; None while it is lost."""
        if self.pose is None or self.lost:
            return None
        age = self.port.seconds() - self._pose_time
        return integrate(self.pose, self._twist, age) if 0.0 < age < OLDEST_POSE else self.pose

    def require_pose(self) -> Pose:
        """Return where the robot is now.

        Raises:
            SignalError: Nobody knows.

        """
        pose = self.pose_now()
        if pose is None:
            msg = f'{self.lost}: where the robot is must be known before it can go anywhere'
            if not self.parameters.drives_by_odom:
                msg += ': tell its localization (topic initialpose), or let it move'
            raise SignalError(msg)
        return pose

    def require_frame(self, frame: str) -> None:
        """Raise unless ``frame`` is the one in which this node drives.

        Raises:
            ConfigurationError: It is another.

        """
        if self.parameters.named(frame) not in {'', self.parameters.frame}:
            msg = (
                f"frame '{frame}': this node drives in '{self.parameters.frame}'; transform it "
                'first, or set the parameter frame'
            )
            raise ConfigurationError(msg)

    def _on_pose(self, message: Any) -> None:
        self.require_frame(message.header.frame_id)
        pose = pose_of(message.pose.pose)
        if self._pose_watch.is_news(message.header.stamp):
            self._pose_watch.note()
            self.pose, self._pose_time = pose, seconds_of(message.header.stamp)
            self.lost = ''

    def _on_cycle(self) -> None:
        now = self.port.seconds()
        dt = 0.0 if self._last_cycle is None else max(now - self._last_cycle, 0.0)
        dt = min(dt, LONGEST_STEP / self.parameters.rate)
        self._last_cycle = now
        self._look_for_block(dt)
        self.cycle(dt)

    def _look_for_block(self, dt: float) -> None:
        """Find out whether the robot has moved as it was told, by its pose as measured."""
        pose = None if self.lost else self.pose
        self.guard.look(self.parameters.blocked, pose, self._twist, dt)

    def _watch(self) -> None:
        """Stop where the pose is lost; again and again where no cycle will, as the clock stands."""
        before, self.lost = self.lost, self._why_lost()
        if self.lost and self._farewell > 0.0 and (self.port.clock.fault or not before):
            self._send(REST)

    def _why_lost(self) -> str:
        """Return why the pose cannot be used; empty if it can."""
        watch, given = self._pose_watch, self.parameters
        if watch.tell() is not Silence.LOST:
            return ''
        silent = watch.age(self.port.steady_seconds()) is not None and not self.port.clock.fault
        return f'no {given.position} for {given.stop_after:g} s' if silent else watch.why()

    def _send(self, twist: Twist) -> None:
        self._twist = twist
        self._command(twist)
