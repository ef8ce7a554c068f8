"""Node `omni_kinematics`: twist in, rates of omni wheels out; their encoders in, odometry out."""

from __future__ import annotations

from array import array
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any

from geometry_msgs.msg import Twist as TwistMessage
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Float64MultiArray
from std_srvs.srv import SetBool

from agv_motion.errors import SignalError
from agv_motion.motion.watchdog import Silence, Watchdog
from agv_motion.nodes.omni_parameters import OmniBaseParameters
from agv_motion.odometry.covariance import CERTAIN, is_positive_definite
from agv_motion.odometry.encoders import Step
from agv_motion.odometry.omni_odometry import OmniOdometry
from agv_motion.odometry.parameters import OdometryParameters
from agv_motion.odometry.rate_encoder import RateEncoder
from agv_motion.odometry.wheel_monitor import SOUND, WheelMonitor
from agv_motion.parameters import Spec
from agv_motion.planar import REST, Twist
from agv_motion.ros.covariances import covariance_of, fill_covariance
from agv_motion.ros.messages import fill_pose, fill_twist, pose_of, seconds_of, twist_of
from agv_motion.ros.node import ERROR, OK, WARN, Diagnosis, ManagedNode
from agv_motion.ros.qos import COMMAND, SENSOR
from agv_motion.ros.run import run
from agv_motion.ros.wheel_joints import WheelJoints

if TYPE_CHECKING:
    from agv_motion.odometry.wheel_fault import WheelDiagnosis


@dataclass(frozen=True)
class OmniKinematicsParameters(OmniBaseParameters):
    """The base, its limits, what makes it stop, and how far its encoders are trusted."""

    max_wheel_speed: Annotated[
        float, Spec('limit of every rim; above it the whole twist is scaled', 'm/s', (1e-4, 50.0))
    ] = 1.0
    report_after: Annotated[float, Spec('silence of cmd_vel to report', 's', (0.01, 3600))] = 0.3
    stop_after: Annotated[
        float, Spec('silence of cmd_vel, or of wheels/state, to stop', 's', (0.01, 3600))
    ] = 0.5
    residual_warning: Annotated[
        float, Spec('wheels slip against each other: warn above', 'm/s', (0.0, 50.0), dynamic=True)
    ] = 0.1
    stamped: Annotated[bool, Spec('cmd_vel is TwistStamped (else Twist)')] = True
    base_frame: Annotated[str, Spec('frame of the twist and of the wheels')] = 'base_link'
    odom_frame: Annotated[str, Spec('frame in which the wheels carry the base')] = 'odom'
    odometry: OdometryParameters = field(default_factory=OdometryParameters)


class OmniKinematics(ManagedNode[OmniKinematicsParameters]):
    """`cmd_vel` -> `wheels/command`; `wheels/state` -> `odom`, `wheels/free_speed`.

    Silence of `cmd_vel`, silence of the encoders once they have spoken, `~/stop` and the end of
    the node all end in an explicit zero. Odometry does without a wheel that is missing or, of four
    or more, faulty, and says so.
    """

    def __init__(self, **kwargs: Any) -> None:
        """Declare the parameters."""
        super().__init__('omni_kinematics', OmniKinematicsParameters, **kwargs)

    def open(self) -> None:
        """Build the kinematics and the odometry, and open the topics."""
        given = self.parameters
        self._wheels = given.wheels()
        self._odometry = OmniOdometry(self._wheels, given.wheel_radii, given.odometry)
        self._monitor = WheelMonitor(self._wheels, given.wheel_radii, given.odometry)
        self._diagnosis: WheelDiagnosis = SOUND
        self._rate_encoder = RateEncoder(len(self._wheels))
        self._joints = WheelJoints(given.joint_names)
        self._watchdog = Watchdog(given.report_after, given.stop_after)
        self._state_watchdog = Watchdog(given.report_after, given.stop_after)
        self._stopped = self._blind = self._extras_wanted = False
        self._last_step = Step.FIRST
        self._open_topics(given)

    def _open_topics(self, given: OmniKinematicsParameters) -> None:
        self._command = self.publisher(JointState, 'wheels/command', COMMAND)
        self._rates = self.publisher(Float64MultiArray, 'wheels/velocity_commands', COMMAND)
        self._free = self.publisher(JointState, 'wheels/free_speed', SENSOR)
        self._slip = self.publisher(Float64, 'wheels/residual', SENSOR)
        self._odom = self.publisher(Odometry, 'odom', SENSOR)
        if given.stamped:
            self.listen(TwistStamped, 'cmd_vel', self._on_stamped_twist, COMMAND)
        else:
            self.listen(TwistMessage, 'cmd_vel', self._on_twist, COMMAND)
        self.listen(JointState, 'wheels/state', self._on_state, SENSOR)
        self.serve(SetBool, '~/stop', self._on_stop)
        self.serve(SetMap, '~/set_odometry', self._on_set_odometry)
        self.every(min(0.1, given.stop_after / 4.0), self._watch)
        self.every(1.0, self._look_for_faults)

    def halt(self) -> None:
        """Send the last word: no wheel turns."""
        self._send(REST, self.get_clock().now().to_msg())

    def diagnose(self) -> Diagnosis:
        """Tell of a stop, of silence, of slip and of wheels that odometry does without."""
        silence = self._watchdog.judge(self.seconds())
        values = {
            'cmd_vel': silence.value,
            'odometry': self._last_step.value,
            'residual [m/s]': f'{self._odometry.reckoning.residual:.5f}',
            'wheels left out': ', '.join(self._names(self._odometry.left_out)) or 'none',
        }
        if self._stopped or self._blind:
            why = 'by request' if self._stopped else 'wheels/state is lost'
            return Diagnosis(ERROR, f'stopped: {why}', values)
        if self._odometry.left_out:
            msg = f'odometry goes on without {values["wheels left out"]}: repair it'
            return Diagnosis(ERROR, msg, values)
        warning = self._warning(silence)
        return Diagnosis(WARN if warning else OK, warning or 'driving', values)

    def _warning(self, silence: Silence) -> str:
        """Return what is not as it should be though the robot drives; empty if nothing."""
        if not self._diagnosis.consistent:
            suspects = ' or '.join(self._names(self._diagnosis.suspects)) or 'several'
            return f'the wheels do not agree: look at {suspects}'
        if silence is not Silence.FRESH:
            return f'cmd_vel is {silence.value}'
        if self._odometry.reckoning.residual > self.parameters.residual_warning:
            return 'the wheels slip against each other'
        return ''

    # cmd_vel -> wheels/command

    def _on_stamped_twist(self, message: TwistStamped) -> None:
        self._drive(twist_of(message.twist), message.header.stamp)

    def _on_twist(self, message: TwistMessage) -> None:
        self._drive(twist_of(message), self.get_clock().now().to_msg())

    def _drive(self, twist: Twist, stamp: Any) -> None:
        self._watchdog.feed()
        self._send(REST if self._stopped or self._blind else twist, stamp)

    def _send(self, twist: Twist, stamp: Any) -> None:
        """Command the wheels; the plain array only where someone listens."""
        given = self.parameters
        speeds = self._wheels.command(twist, given.max_wheel_speed).speed
        rates = [speed / r + 0.0 for speed, r in zip(speeds, given.wheel_radii, strict=True)]
        message = self._joints.message(rates)
        message.header.stamp, message.header.frame_id = stamp, given.base_frame
        self._command.publish(message)
        if self._extras_wanted:
            self._rates.publish(Float64MultiArray(data=array('d', rates)))

    def _watch(self) -> None:
        """Stop when `cmd_vel` falls silent, or encoders that have spoken do."""
        now = self.seconds()
        self._extras_wanted = bool(self._rates.get_subscription_count())
        silence = self._watchdog.judge(now)
        eyes = self._state_watchdog.judge(now)
        self._blind = eyes is Silence.LOST and self._state_watchdog.age(now) is not None
        if self._blind:
            self.get_logger().error(
                f'no wheels/state for {self._state_watchdog.age(now):.1f} s: stopped; '
                'look at the encoders', throttle_duration_sec=5.0,
            )  # fmt: skip
        elif silence is not Silence.FRESH and self._watchdog.age(now) is not None:
            told = 'stopped' if silence is Silence.LOST else 'still driving'
            self.get_logger().warning(
                f'no cmd_vel for {self._watchdog.age(now):.1f} s: {told}',
                throttle_duration_sec=5.0,
            )
        if self._blind or silence is Silence.LOST:
            self._send(REST, self.get_clock().now().to_msg())

    def _on_stop(self, request: Any) -> str:
        self._stopped = request.data
        if request.data:
            self._send(REST, self.get_clock().now().to_msg())
            return 'stopped; call again with data: false to drive on'
        return 'free to drive'

    # wheels/state -> odom

    def _on_state(self, message: JointState) -> None:
        """Carry the odometry on with angles, or rates where there are none, and tell of it."""
        state, stamp = self._joints.read(message), seconds_of(message.header.stamp)
        angles = state.angles or self._rate_encoder.add(stamp, state.rates)
        self._last_step = self._odometry.update(stamp, angles)
        if self._last_step is Step.DUPLICATE or self._last_step is Step.LATE:
            return
        self._state_watchdog.feed()
        self._monitor.add(stamp, angles)
        if self._last_step is Step.RESET:
            self.get_logger().warning(
                f'{Step.RESET.value}; odometry goes on from where it was, less sure',
                throttle_duration_sec=1.0,
            )
        self._publish_odometry(message.header.stamp)

    def _publish_odometry(self, stamp: Any) -> None:
        given, reckoning = self.parameters, self._odometry.reckoning
        twist = reckoning.twist
        message = Odometry(child_frame_id=given.base_frame)
        message.header.stamp, message.header.frame_id = stamp, given.odom_frame
        fill_pose(message.pose.pose, reckoning.pose)
        fill_twist(message.twist.twist, twist)
        fill_covariance(message.pose.covariance, reckoning.covariance())
        fill_covariance(message.twist.covariance, reckoning.twist_covariance())
        self._odom.publish(message)
        self._slip.publish(Float64(data=reckoning.residual))
        rollers = self._joints.message(self._wheels.free_roller_speeds(twist))
        rollers.header.stamp, rollers.header.frame_id = stamp, given.base_frame
        self._free.publish(rollers)

    def _look_for_faults(self) -> None:
        """Leave out the one wheel of four or more that measures what the others do not."""
        self._diagnosis = self._monitor.diagnosis()
        blamed = self._diagnosis.faulty
        faulty = frozenset[int]() if blamed is None else frozenset([blamed])
        if faulty != self._odometry.faulty:
            self._odometry.faulty = faulty
            (name,) = self._names(faulty) or ('every wheel',)
            self.get_logger().error(
                f'{name} measures what the others do not: odometry goes on without it'
                if faulty
                else 'all wheels agree again: odometry uses each of them'
            )

    def _names(self, wheels: Any) -> tuple[str, ...]:
        return tuple(self.parameters.joint_names[wheel] for wheel in sorted(wheels))

    def _on_set_odometry(self, request: Any) -> str:
        """Go on from the pose of the request; its map is not looked at."""
        given, asked = self.parameters, request.initial_pose
        if asked.header.frame_id not in {'', given.odom_frame}:
            msg = f"frame '{asked.header.frame_id}': expected '{given.odom_frame}'"
            raise SignalError(msg)
        pose, covariance = pose_of(asked.pose.pose), covariance_of(asked.pose.covariance)
        if covariance != CERTAIN and not is_positive_definite(covariance):
            msg = (
                f'covariance {tuple(covariance)} (xx, xy, xt, yy, yt, tt) is not positive definite'
            )
            raise SignalError(msg)
        self._odometry.reckoning.set_odometry(pose, covariance)
        return f'odometry goes on from ({pose.x:g} m, {pose.y:g} m, {pose.theta:g} rad)'


def main() -> None:
    """Run the node."""
    run(OmniKinematics)


if __name__ == '__main__':
    main()
