"""What nodes share that stand in for a robot: time, pause, reset, kidnapping, the truth."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timezone
from enum import Enum
from typing import TYPE_CHECKING, Annotated, Any, Protocol, TypeVar

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from rosgraph_msgs.msg import Clock as ClockMessage
from std_srvs.srv import SetBool, Trigger

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.model.frames import FrameParameters
from agv_motion.nodes.clock_leader import CLOCK, ClockLeader
from agv_motion.parameters import Spec, check
from agv_motion.planar import Pose, Twist
from agv_motion.ros.clock_guard import CLOCK_TOPIC
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.messages import fill_pose, fill_twist, pose_of, require_frame, stamp_of
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import COMMAND, SENSOR

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.ros.port import Port


FASTEST = 1e4
"""[rad/s, rad] Rate of a motor, and angle of a turret, beyond which a command is none."""

LEAP = 60 * 10**9
"""[ns] A clock that goes on by more at once, or back, is not caught up with but taken over."""


class ClockRole(Enum):
    """Who makes simulated time pass."""

    LEAD = 'lead'
    """This simulator, which tells it on /clock"""
    FOLLOW = 'follow'
    """Another one, whose /clock this one heeds"""


@dataclass(frozen=True)
class SimulatedParameters(FrameParameters):
    """Where the robot starts, and how fast time passes."""

    rate: Annotated[float, Spec('steps per simulated second', 'Hz', (1.0, 1000.0))] = 50.0
    time_factor: Annotated[
        float,
        Spec(
            'simulated seconds per second; less where the machine is too slow', '1', (0.01, 1000.0)
        ),
    ] = 1.0
    clock: Annotated[
        str,
        Spec(
            'lead: make time pass and tell it on /clock; follow: another simulator does',
            choices=tuple(each.value for each in ClockRole),
        ),
    ] = ClockRole.LEAD.value
    start_time: Annotated[str, Spec('simulated start, ISO 8601, UTC')] = '2015-06-15T11:00'
    command_timeout: Annotated[
        float,
        Spec(
            'silence of the commands after which the motors stop, as those of real drives must; '
            'in real and in simulated time, whichever is later',
            's',
            (0.01, 3600.0),
        ),
    ] = 0.5
    seed: Annotated[int, Spec('of all noise', '1', (0, 2**31))] = 1
    start_x: Annotated[float, Spec('where the robot starts', 'm', (-1e4, 1e4))] = 0.0
    start_y: Annotated[float, Spec('where the robot starts', 'm', (-1e4, 1e4))] = 0.0
    start_heading: Annotated[float, Spec('where it looks', 'rad', (-7.0, 7.0))] = 0.0
    map_frame: Annotated[str, Spec('frame of fixes and of the truth')] = 'map'

    def __post_init__(self) -> None:
        """Check every row, and the start time."""
        check(self)
        self.start_nanoseconds()

    def start(self) -> Pose:
        """Return where the robot starts."""
        return Pose(self.start_x, self.start_y, self.start_heading)

    def start_nanoseconds(self) -> int:
        """Return the start time since 1970 [ns]."""
        try:
            start = datetime.fromisoformat(self.start_time.replace('Z', '+00:00'))
        except ValueError as error:
            msg = f"start_time = '{self.start_time}': give ISO 8601 such as 2015-06-15T08:00:00"
            raise ConfigurationError(msg) from error
        seconds = start.replace(tzinfo=start.tzinfo or timezone.utc).timestamp()
        return round(seconds * 1e6) * 1000


P = TypeVar('P', bound=SimulatedParameters)


class SimulatedBody(Protocol):
    """The simulated robot."""

    pose: Pose
    twist: Twist

    def carry_to(self, pose: Pose) -> None:
        """Lift it and set it down elsewhere."""


def require_possible(rates: Sequence[float], angles: Sequence[float] = ()) -> None:
    """Raise unless motors could be commanded so.

    Raises:
        SignalError: A rate [rad/s] or an angle [rad] is beyond `FASTEST`, or not finite.

    """
    for value in (*rates, *angles):
        if not abs(value) <= FASTEST:
            msg = f'a command of {value:g}: no motor turns by more than {FASTEST:g} rad, or rad/s'
            raise SignalError(msg)


class SimulatedNode(PlainNode[P]):
    """Lets time pass in steps; a node overrides `reset`, `step`, `let_go` and `show`."""

    # What a node overrides

    def reset(self) -> SimulatedBody:
        """Return a robot at its start."""
        raise NotImplementedError

    def step(self, duration: float) -> None:
        """Let the robot move for ``duration`` [s]."""
        raise NotImplementedError

    def let_go(self) -> None:
        """Stop the motors: nobody commands them."""
        raise NotImplementedError

    def show(self, stamp: Any) -> None:
        """Publish what is measured of it."""
        raise NotImplementedError

    # What a node uses

    def __init__(self, port: Port, parameters: P) -> None:
        """Put the robot at its start, and open the topics."""
        super().__init__(port, parameters)
        given = parameters
        self._paused = False
        self._clock: ClockLeader | None = None
        self._commanded_at: tuple[float, float] | None = None
        self._put_at_start()
        self._truth = port.publisher(Odometry, 'ground_truth', SENSOR, sole=True)
        port.serve(SetBool, '~/pause', self._on_pause)
        port.serve(Trigger, '~/reset', self._on_reset)
        port.listen(PoseWithCovarianceStamped, 'carry', self._on_pose, COMMAND)
        port.serve(SetMap, '~/carry', lambda request: self._carry(request.initial_pose))
        if ClockRole(given.clock) is ClockRole.FOLLOW:
            port.listen(ClockMessage, CLOCK_TOPIC, self._follow, CLOCK)
            port.need(CLOCK_TOPIC)
            return
        period = 1.0 / (given.rate * given.time_factor)
        self._clock = ClockLeader(port, period, self._lead)

    def begin(self) -> None:
        """Stand until a command comes: the last one may be hours old."""
        self._commanded_at = None
        self.let_go()

    def diagnose(self) -> Diagnosis:
        """Tell the simulated time."""
        level, word = (WARN, 'paused') if self._paused else (OK, 'running')
        if self._clock is not None and self._clock.rivals:
            level, word = ERROR, f'{self._clock.rivals} all tell the time on {CLOCK_TOPIC}'
        time = datetime.fromtimestamp(self.time, timezone.utc).isoformat(timespec='seconds')
        commanded = 'no' if self._commanded_at is None else 'yes'
        values = {'simulated time': time, 'commanded': commanded}
        return Diagnosis(level, word, values, self.nanoseconds)

    @property
    def elapsed(self) -> float:
        """Simulated time since the start [s]."""
        return self.steps / self.parameters.rate

    @property
    def nanoseconds(self) -> int:
        """Simulated time, since 1970 [ns]: a float of seconds holds no more than microseconds."""
        return self.nanoseconds_at(self.steps)

    @property
    def time(self) -> float:
        """Simulated time, since 1970 [s]."""
        return self.nanoseconds * 1e-9

    def note_command(self) -> None:
        """Feed the watchdog of the motors."""
        self._commanded_at = self.port.steady_seconds(), self.elapsed

    def carry_to(self, pose: Pose) -> None:
        """Lift the robot and set it down elsewhere, its wheels still."""
        self._body.carry_to(pose)

    def _put_at_start(self) -> None:
        self.steps, self._start = 0, self.parameters.start_nanoseconds()
        self._body, self._commanded_at = self.reset(), None

    def _on_pause(self, request: Any) -> str:
        self._paused = request.data
        return 'time stands still' if self._paused else 'time goes on'

    def _on_reset(self, _: Any) -> str:
        self._put_at_start()
        return f'back at the start, {self.parameters.start_time}'

    def _on_pose(self, message: PoseWithCovarianceStamped) -> None:
        self.port.info(self._carry(message))

    def _carry(self, message: PoseWithCovarianceStamped) -> str:
        require_frame(message.header.frame_id, self.parameters.map_frame)
        pose = pose_of(message.pose.pose)
        self.carry_to(pose)
        return f'carried to ({pose.x:g} m, {pose.y:g} m, {pose.theta:g} rad), wheels still'

    def nanoseconds_at(self, steps: int) -> int:
        """Return the time after this number of steps, since 1970 [ns]."""
        return self._start + round(steps * 1e9 / self.parameters.rate)

    def _lead(self) -> None:
        """Let one step of simulated time pass, and tell it."""
        if self._clock is not None and not self._paused:
            self._clock.tell(self.nanoseconds_at(self.steps + 1))
            self._step()

    def _follow(self, message: ClockMessage) -> None:
        """Take the steps up to the time that another simulator tells."""
        now = message.clock.sec * 10**9 + message.clock.nanosec
        if self._paused or not 0 <= now - self.nanoseconds <= LEAP:
            self._start += now - self.nanoseconds
        while self.nanoseconds_at(self.steps + 1) <= now:
            self._step()

    def _watch_commands(self) -> None:
        """Stop the motors when their commands fall silent."""
        if self._commanded_at is None:
            return
        steady, elapsed = self._commanded_at
        silent = min(self.port.steady_seconds() - steady, self.elapsed - elapsed)
        if silent >= self.parameters.command_timeout:
            self._commanded_at = None
            self.let_go()
            self.port.warning(f'no command for {silent:.2f} s: the motors stop until one comes')

    def _step(self) -> None:
        """Let the robot go on by one step, and publish what there is to see."""
        self._watch_commands()
        self.step(1.0 / self.parameters.rate)
        self.steps += 1
        stamp = stamp_of(self.nanoseconds)
        self.show(stamp)
        message = Odometry(child_frame_id=self.parameters.base_frame)
        message.header.stamp, message.header.frame_id = stamp, self.parameters.map_frame
        fill_pose(message.pose.pose, self._body.pose)
        fill_twist(message.twist.twist, self._body.twist)
        self._truth.publish(message)
