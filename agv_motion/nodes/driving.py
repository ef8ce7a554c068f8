"""What nodes share that drive a robot by its pose: `odom` in, `cmd_vel` out, never a silent end."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from agv_motion.activity import Activity, Cause
from agv_motion.nodes.blocked_report import BlockedReport
from agv_motion.nodes.driving_parameters import DrivingParameters
from agv_motion.nodes.pose_input import PoseInput
from agv_motion.nodes.state_report import StateReport
from agv_motion.planar import REST, Pose, Twist
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.twist_rows import twist_publisher

if TYPE_CHECKING:
    from agv_motion.ros.port import Port
    from agv_motion.twist_limits import TwistLimits


FAREWELL = 1.0
"""[s] How long zeros are sent after the end of a drive; then `cmd_vel` is free for others."""


INACTIVE = 'not active'
"""What it says to be doing as long as nobody activates it."""

LONGEST_STEP = 5
"""Cycles that pass at once at most: nothing runs away from a node that slept."""

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
        self._twist = REST
        self._last_cycle: float | None = None
        self._farewell = 0.0
        arm, longest = 0.5 * self.limits().track, LONGEST_STEP / given.rate
        remedy = f'clear its way, then {self.release}'
        self.guard = BlockedReport(port, given.blocked, arm, remedy, longest)
        """Watches that the robot moves when told to"""
        self._command = twist_publisher(port, given.base_frame, stamped=given.stamped)
        self._state = StateReport(port, self.state_topic)
        self._pose = PoseInput(port, given)
        port.every(1.0 / given.rate, self._on_cycle)
        port.watch_inputs(given.stop_after, self._watch)

    def begin(self) -> None:
        """Know nothing of before: where the robot is must be told anew."""
        self._pose.begin()
        self._last_cycle = None
        self._twist, self._farewell = REST, 0.0
        self.guard.release()

    def halt(self) -> None:
        """Send the last word, no motion, and say so: who comes later hears what was said last."""
        self._send(REST)
        self.tell(INACTIVE)

    @property
    def lost(self) -> str:
        """Why the pose cannot be used; empty if it can."""
        return self._pose.lost

    @property
    def told(self) -> str:
        """The state told last."""
        return self._state.state

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
        self._state.note(*self.activity())
        return self._state.values()

    def tell(self, state: str) -> None:
        """Say what the robot does, where that has changed."""
        self._state.tell(state)

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
        return self._pose.now(self._twist)

    def require_pose(self) -> Pose:
        """Return where the robot is now.

        Raises:
            SignalError: Nobody knows.

        """
        return self._pose.require(self._twist)

    def require_frame(self, frame: str) -> None:
        """Raise unless ``frame`` is the one in which this node drives.

        Raises:
            ConfigurationError: It is another.

        """
        self._pose.require_frame(frame)

    def require_frame_of_all(self, path: Any) -> None:
        """Raise unless a nav_msgs/Path and each of its poses are in that frame.

        Raises:
            ConfigurationError: One is in another.

        """
        for frame in dict.fromkeys(
            [path.header.frame_id, *(p.header.frame_id for p in path.poses)]
        ):
            self.require_frame(frame)

    def _on_cycle(self) -> None:
        now = self.port.seconds()
        dt = 0.0 if self._last_cycle is None else max(now - self._last_cycle, 0.0)
        dt = min(dt, LONGEST_STEP / self.parameters.rate)
        self._last_cycle = now
        self.guard.look(self.parameters.blocked, self._pose.measured, self._twist)
        self.cycle(dt)

    def _watch(self) -> None:
        """Stop where the pose is lost; again and again where no cycle will, as the clock stands."""
        if self._pose.look() and self._farewell > 0.0:
            self._send(REST)

    def _send(self, twist: Twist) -> None:
        self._twist = twist
        self._command(twist)
