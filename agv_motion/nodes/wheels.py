"""What nodes share that drive fixed wheels: `cmd_vel` and encoders in, motors and `odom` out.

A change of the twist is ramped within the limits of the wheels, a zero too: it brakes as hard as
the wheels may. Silence of `cmd_vel`, silence of the encoders once they have spoken, `~/stop` and
the end of the node are another matter: an explicit zero at once. Nobody then knows what lies ahead,
a node that ends cannot ramp, and a limit that somebody has set too low must not lengthen the stop;
how hard the wheels can brake their motors know best.
"""

from __future__ import annotations

from array import array
from dataclasses import dataclass, field
from math import inf
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

from geometry_msgs.msg import Twist as TwistMessage
from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from std_srvs.srv import SetBool

from agv_motion.blocked import BlockedGuard, BlockedParameters
from agv_motion.errors import SignalError
from agv_motion.kinematics.twist_ramp import TwistRamp
from agv_motion.kinematics.wheel_limits import WheelLimits
from agv_motion.odometry.continuity import Step
from agv_motion.odometry.covariance import CERTAIN, is_positive_definite
from agv_motion.odometry.parameters import OdometryParameters
from agv_motion.odometry.wheel_angles import WheelAngles
from agv_motion.parameters import Spec
from agv_motion.planar import REST, Twist
from agv_motion.ros.covariances import covariance_of, fill_covariance
from agv_motion.ros.input_watch import Freshness, InputWatch
from agv_motion.ros.messages import (
    fill_pose,
    fill_twist,
    pose_of,
    require_frame,
    seconds_of,
    stamp_of,
    twist_of,
)
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import COMMAND, SENSOR
from agv_motion.ros.twist_rows import TwistRows
from agv_motion.ros.wheel_joints import WheelJoints
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.wheel_odometry import WheelOdometry

RELEASE = 'clear the wheels and see to the motors, then send a zero cmd_vel'
"""What lets blocked wheels go on."""

ARM = 0.2
"""[m] About half the width of a robot, where a turn of it is measured as a motion."""

LONGEST_STEP = 0.2
"""[s] A longer time between two readings counts as so much: nobody has looked meanwhile."""


@dataclass(frozen=True)
class WheelsParameters(WheelLimits):
    """The limits of the wheels, what makes them stop, and how far their encoders are trusted."""

    rate: Annotated[
        float, Spec('commands per second while the speed changes', 'Hz', (1.0, 1000.0))
    ] = 50.0
    report_after: Annotated[float, Spec('silence of cmd_vel to report', 's', (0.01, 3600))] = 0.3
    stop_after: Annotated[
        float, Spec('silence of cmd_vel, or of wheels/state, to stop', 's', (0.01, 3600))
    ] = 0.5
    max_age: Annotated[
        float,
        Spec('how far stamps of cmd_vel and wheels/state may lie from now', 's', (0.01, 1e10)),
    ] = 1.0
    stamped: Annotated[bool, Spec('cmd_vel is TwistStamped (else Twist)')] = True
    base_frame: Annotated[str, Spec('frame of the twist and of the wheels')] = 'base_link'
    odom_frame: Annotated[str, Spec('frame in which the wheels carry the base')] = 'odom'
    blocked: BlockedParameters = field(default_factory=BlockedParameters)
    odometry: OdometryParameters = field(default_factory=OdometryParameters)


P = TypeVar('P', bound=WheelsParameters)


class WheelsNode(PlainNode[P]):
    """`cmd_vel` -> `wheels/command`; `wheels/state` -> `odom`.

    A node opens with `open_wheels`, and overrides `rates` and `carry`. `cmd_vel/limited` tells what
    is commanded in truth.
    """

    # What a node overrides

    def rates(self, twist: Twist) -> Sequence[float]:
        """Return the rate of each wheel [rad/s] for ``twist``; raise where they cannot make it."""
        raise NotImplementedError

    def carry(self, stamp: float, angles: Sequence[float | None], *, by_rate: bool) -> Step:
        """Carry the odometry on to ``angles`` [rad], None where a wheel tells nothing.

        Args:
            stamp: Time of the reading [s].
            angles: (n,) angle of each wheel [rad].
            by_rate: Whether some are added-up rates.

        """
        raise NotImplementedError

    def tell_more(self, stamp: Any) -> None:
        """Publish what there is beside the odometry."""

    # What a node uses

    def open_wheels(
        self,
        joint_names: Sequence[str],
        wheel_radii: Sequence[float],
        reckoning: WheelOdometry,
        rows: Sequence[Sequence[float]],
    ) -> None:
        """Open the topics and services of the wheels.

        Args:
            joint_names: (n,) of the wheels.
            wheel_radii: (n,) [m].
            reckoning: Their odometry.
            rows: (n, 3) rim speeds [m/s] of unit vx, vy and wz.

        """
        given, port = self.parameters, self.port
        self._ramp = TwistRamp(rows, given)
        self._ramped_at, self._settled = -inf, True
        self.joints = WheelJoints(joint_names)
        self.stopped = self.blind = False
        self.last_step = Step.FIRST
        self._reckoning = reckoning
        odometry = given.odometry
        fastest = odometry.max_wheel_speed / min(wheel_radii)
        self._angles = WheelAngles(len(joint_names), odometry.max_gap, fastest)
        limits = Freshness(given.report_after, given.stop_after, given.max_age)
        self.command_watch = InputWatch(port, 'cmd_vel', limits)
        self._state_watch = InputWatch(port, 'wheels/state', limits, 'look at the encoders')
        self.standing = True
        """Whether the last twist was zero: then nobody needs to drive on."""
        self._extras_wanted = False
        self._guard = BlockedGuard(given.blocked, ARM, RELEASE)
        self._sent, self._looked_at = REST, port.seconds()
        self._command = port.publisher(JointState, 'wheels/command', COMMAND, sole=True)
        self._rates = port.publisher(Float64MultiArray, 'wheels/velocity_commands', COMMAND)
        twists = TwistRows(given.base_frame)
        self._limited = port.row_publisher(twists, 'cmd_vel/limited', COMMAND)
        self._odom = port.publisher(Odometry, 'odom', SENSOR, sole=True)
        if given.stamped:
            port.listen_to_rows(twists, 'cmd_vel', self._on_stamped_twist, COMMAND, sole=True)
        else:
            port.listen(TwistMessage, 'cmd_vel', self._on_twist, COMMAND, sole=True)
        port.listen(JointState, 'wheels/state', self._on_state, SENSOR)
        port.serve(SetBool, '~/stop', self._on_stop)
        port.serve(SetMap, '~/set_odometry', self._on_set_odometry)
        port.every(1.0 / given.rate, self._go_on)
        port.watch_inputs(given.stop_after, self._watch)

    def begin(self) -> None:
        """Stand until a twist comes."""
        self.standing = True
        self._guard.release()

    def halt(self) -> None:
        """Send the last word: no wheel turns."""
        self._stand()

    def silence(self) -> Silence:
        """Return how silent `cmd_vel` is; no more than a fact where the robot was told to stand."""
        return self.command_watch.silence()

    def why_stopped(self) -> str:
        """Return why the wheels are held; empty if they are not."""
        if self.stopped:
            return 'stopped: by request'
        return 'stopped: wheels/state is lost' if self.blind else self._guard.reason

    # cmd_vel -> wheels/command

    def _on_stamped_twist(self, twist: Twist, frame: str, stamp: int) -> None:
        if twist == REST and not self.standing:  # a stop is obeyed however old it is
            self.standing = True
            self._follow(REST)
        require_frame(frame, self.parameters.base_frame)
        if self.command_watch.is_new(stamp):
            self._drive(twist)

    def _on_twist(self, message: TwistMessage) -> None:
        self._drive(twist_of(message))

    def _drive(self, twist: Twist) -> None:
        """Command the wheels, while the clock can be believed."""
        if self.port.clock.fault:
            return
        if twist == REST:
            self._guard.release()
        if self.stopped or self.blind or self._guard.reason:
            self._stand()
        else:
            self._follow(twist)
        self.command_watch.note()
        self.standing = twist == REST

    def _follow(self, twist: Twist) -> None:
        """Go over to ``twist`` as fast as the wheels may, and answer with a command at once."""
        self.rates(twist)  # refuses what the wheels cannot make
        self._ramp.set_target(twist)
        self._advance()

    def _go_on(self) -> None:
        """Command the next step of a ramp, however seldom `cmd_vel` comes."""
        if not self._ramp.settled:
            self._advance()

    def _advance(self) -> None:
        """Command what the ramp has come to; a step counts for no more than its period, or two.

        After a rest one period has passed, however long it was.
        """
        instant = self.port.nanoseconds()  # of what is commanded for it
        now = instant * 1e-9
        period, ramp = 1.0 / self.parameters.rate, self._ramp
        longest = period if self._settled else 2.0 * period
        ramp.update(min(max(now - self._ramped_at, 0.0), longest))
        self._settled, self._ramped_at = ramp.settled, now
        self._send(ramp.twist, instant)

    def _stand(self) -> None:
        """Stop all wheels at once, for safety."""
        self._ramp.stop()
        self._settled = True
        self._send(REST, self.port.nanoseconds())

    def _send(self, twist: Twist, instant: int) -> None:
        """Command the wheels for an instant [ns]; tell the other two only where someone listens."""
        rates, self._sent = self.rates(twist), twist
        message = self.joints.message(rates)
        message.header.stamp = stamp_of(instant)
        message.header.frame_id = self.parameters.base_frame
        self._command.publish(message)
        if self._limited.get_subscription_count():
            self._limited.publish(twist, instant)
        if self._extras_wanted:
            self._rates.publish(Float64MultiArray(data=array('d', rates)))

    def _watch(self) -> None:
        """Stop when `cmd_vel` falls silent, or encoders that have spoken do."""
        self._extras_wanted = bool(self._rates.get_subscription_count())
        self.blind = self._state_watch.tell() is Silence.LOST and self._state_watch.spoken
        command = self.command_watch
        silence = command.silence() if self.standing else command.tell()
        if self.blind or silence is Silence.LOST:
            self._stand()

    def _on_stop(self, request: Any) -> str:
        self.stopped = request.data
        if request.data:
            self._stand()
            return 'stopped; call again with data: false to drive on'
        return 'free to drive'

    # wheels/state -> odom

    def _on_state(self, message: JointState) -> None:
        """Carry the odometry on with angles, or rates where there are none, and tell of it."""
        state, news = self.joints.read(message), self._state_watch.is_news(message.header.stamp)
        stamp = seconds_of(message.header.stamp)
        angles = self._angles.add(stamp, state.angles, state.rates)
        try:
            self.last_step = self.carry(stamp, angles, by_rate=self._angles.by_rate)
        except SignalError as error:
            raise SignalError(f'{state.wrong}; {error}' if state.wrong else str(error)) from error
        if state.wrong:
            self.port.refuse(f'wheels/state: {state.wrong}; going by the rest')
        if not self.last_step.used:
            self._tell_ignored(stamp)
            return
        if news:
            self._state_watch.note()
        if self.last_step in {Step.RESET, Step.LEAP}:
            self.port.warning(
                f'{self.last_step.value}; odometry goes on from where it was, less sure',
                throttle_duration_sec=1.0,
            )
        self._look_for_block()
        self._publish_odometry(message.header.stamp)
        self.tell_more(message.header.stamp)

    def _look_for_block(self) -> None:
        """Stop wheels that do not turn though told to, by their encoders."""
        guard, now = self._guard, self.port.seconds()
        dt, self._looked_at = min(max(now - self._looked_at, 0.0), LONGEST_STEP), now
        guard.watch.parameters = self.parameters.blocked
        if guard.update(self._reckoning.pose, self._sent, dt):
            self.port.error(guard.reason)
            self._stand()

    def _tell_ignored(self, stamp: float) -> None:
        """Tell of readings that cannot be; one that comes late or twice is no news."""
        if self.last_step is Step.DOUBTED:
            limit = self.parameters.odometry.max_wheel_speed
            self.port.refuse(
                f'wheels/state of {stamp:.3f} s {Step.DOUBTED.value}; wheels run {limit:g} m/s at '
                'most (odometry.max_wheel_speed): look at the encoders and their clock'
            )

    def _publish_odometry(self, stamp: Any) -> None:
        given, reckoning = self.parameters, self._reckoning
        message = Odometry(child_frame_id=given.base_frame)
        message.header.stamp, message.header.frame_id = stamp, given.odom_frame
        fill_pose(message.pose.pose, reckoning.pose)
        fill_twist(message.twist.twist, reckoning.twist)
        fill_covariance(message.pose.covariance, reckoning.covariance())
        fill_covariance(message.twist.covariance, reckoning.twist_covariance())
        self._odom.publish(message)

    def _on_set_odometry(self, request: Any) -> str:
        """Go on from the pose of the request; its map is not looked at."""
        given, asked = self.parameters, request.initial_pose
        require_frame(asked.header.frame_id, given.odom_frame)
        pose, covariance = pose_of(asked.pose.pose), covariance_of(asked.pose.covariance)
        if covariance != CERTAIN and not is_positive_definite(covariance):
            msg = (
                f'covariance {tuple(covariance)} (xx, xy, xt, yy, yt, tt) is not positive definite'
            )
            raise SignalError(msg)
        self._reckoning.set_odometry(pose, covariance)
        return f'odometry goes on from ({pose.x:g} m, {pose.y:g} m, {pose.theta:g} rad)'
