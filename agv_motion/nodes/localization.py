"""Node `localization`: odometry, position fixes and a gyroscope in, the pose in the map out."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from sensor_msgs.msg import Imu
from std_srvs.srv import Trigger

from agv_motion.errors import SignalError
from agv_motion.nodes.localization_parameters import (
    LocalizationParameters,
    NoiseSource,
    ToldTransforms,
)
from agv_motion.odometry.assumed_noise import AssumedNoise
from agv_motion.odometry.continuity import Succession
from agv_motion.odometry.covariance import CERTAIN, Covariance, shift
from agv_motion.odometry.fix import Fix
from agv_motion.odometry.fusion import PoseFusion
from agv_motion.odometry.fusion_report import Estimate, FixVerdict, FusionState, Health
from agv_motion.odometry.gates import require_within
from agv_motion.odometry.odometry_intake import OdometryIntake, Passage
from agv_motion.odometry.yaw_rate import YawRate
from agv_motion.ros.covariances import covariance_of, fill_covariance
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.input_watch import SECOND, Freshness, InputWatch, require_near
from agv_motion.ros.messages import fill_pose, pose_of, require_frame, seconds_of, twist_of
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import COMMAND, SENSOR
from agv_motion.ros.run import run
from agv_motion.ros.transforms import Transforms
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from agv_motion.odometry.history import Waypoint
    from agv_motion.planar import Pose
    from agv_motion.ros.port import Port


ON_TIME = 0.99
"""[-] Share of the period after which the next pose is due: stamps are rounded."""
AT_REST = 1e-5
"""[m/s, rad/s] Below this the robot stands still, and what the gyroscope tells is its bias."""
ANY_HEADING = 3.0
"""[rad2] Variance of a heading that may be any: pi squared over 3, and what is near it."""
SAID = Covariance(0.25, 0.0, 0.0, 0.25, 0.0, 0.0685)
"""Of a pose that somebody sets without one: half a metre and 15 degrees, as RViz has it."""
LEVELS = {
    FusionState.WAITING: WARN,
    FusionState.SEARCHING: WARN,
    FusionState.TRACKING: OK,
    FusionState.DOUBTFUL: WARN,
    FusionState.ODOMETRY_ONLY: WARN,
}


class Localization(PlainNode[LocalizationParameters]):
    """`odom`, `fix` and `imu` -> `pose`, `odom/filtered` and /tf.

    The pose is told with each odometry message as long as it is known well enough; else the topic
    is silent, so that whoever steers by it stops, and the diagnostics say why.
    """

    name = 'localization'
    takes = LocalizationParameters

    def __init__(self, port: Port, parameters: LocalizationParameters) -> None:
        """Know nothing, and open the topics."""
        super().__init__(port, parameters)
        given = parameters
        self._fusion = PoseFusion(given.fusion)
        self._assumes = NoiseSource(given.odom_covariance) is NoiseSource.ASSUMED
        noise = AssumedNoise(given.odom_noise) if self._assumes else None
        self._tells = ToldTransforms(given.tf)
        self._intake = OdometryIntake(given.fusion, noise)
        self._gyro: YawRate | None = None
        self._at_rest = False
        self._told_at = -inf
        self._last_pose: Pose | None = None
        self._state = FusionState.WAITING
        limits = Freshness(given.odom_timeout, given.odom_timeout, given.max_age)
        self._odom_watch = InputWatch(port, 'odom', limits)
        self._imu_watch = InputWatch(port, 'imu', limits)
        self._pose = port.publisher(PoseWithCovarianceStamped, 'pose', SENSOR, sole=True)
        self._filtered = port.publisher(Odometry, 'odom/filtered', SENSOR)
        self._transforms = None if self._tells is ToldTransforms.NONE else Transforms(port)
        port.listen(Odometry, 'odom', self._on_odometry, SENSOR, sole=True)
        port.listen(PoseWithCovarianceStamped, 'fix', self._on_fix, SENSOR)
        port.need('odom', 'fix')
        port.listen(Imu, 'imu', self._on_imu, SENSOR)
        port.listen(PoseWithCovarianceStamped, 'initialpose', self._on_initial_pose, COMMAND)
        port.listen(PoseWithCovarianceStamped, 'set_pose', self._on_initial_pose, COMMAND)
        port.serve(SetMap, '~/set_pose', lambda request: self._set_pose(request.initial_pose))
        port.serve(Trigger, '~/restart', self._on_restart)

    def diagnose(self) -> Diagnosis:
        """Tell the health of the estimate and the fate of the fixes."""
        health = self._fusion.health()
        values = {
            'state': health.state.name.lower(),
            'odom': self._odom_watch.silence().value,
            'pose told': 'yes' if self._trusted(health) else 'no',
            'position deviation [m]': f'{health.position_deviation:.3f}',
            'heading deviation [rad]': f'{health.heading_deviation:.4f}',
            'since the last good fix [s]': f'{health.since_fix:.1f}',
            'gyroscope': 'none' if self._gyro is None else f'bias {self._gyro.bias:.5f} rad/s',
        }
        values |= {f'fixes {v.name.lower()}': str(n) for v, n in health.verdicts.items() if n}
        if self._odom_watch.silence() is Silence.LOST:
            spoken = self._odom_watch.spoken
            return Diagnosis(*(ERROR, 'odom is lost') if spoken else (WARN, 'no odom yet'), values)
        if health.state is not FusionState.WAITING and not self._trusted(health):
            level = WARN if health.state is FusionState.SEARCHING else ERROR
            return Diagnosis(level, f'pose not told: {health.state.value}', values)
        return Diagnosis(LEVELS[health.state], health.state.value, values)

    # What comes in

    def _on_odometry(self, message: Odometry) -> None:
        given = self.parameters
        require_frame(given.own(message.header.frame_id), given.odom_frame)
        require_frame(given.own(message.child_frame_id), given.base_frame)
        pose, twist = pose_of(message.pose.pose), twist_of(message.twist.twist)
        news = self._odom_watch.is_news(message.header.stamp)
        limits = given.fusion
        require_within('twist', twist[:2], limits.max_speed, 'm/s', 'mend it, or set max_speed')
        require_within('twist', twist[2:], limits.max_turn_rate, 'rad/s', 'or set max_turn_rate')
        stamp = seconds_of(message.header.stamp)
        noise = self._noise_of(pose, message.pose.covariance)
        passage = self._intake.take(stamp, pose, noise, self._gyro)
        if not passage.step.used:
            self._tell_ignored(passage)
            return
        if news:
            self._odom_watch.note()
        self._at_rest = all(abs(component) < AT_REST for component in twist)
        self._fusion.follow(passage)
        if passage.step in {Succession.LEAP, Succession.RESET}:
            self.port.warning(f'odom: {passage.step.value}; less sure of the pose')
        waypoint = passage.waypoint
        if self._filtered.get_subscription_count():
            self._publish_filtered(message, waypoint)
        if abs(stamp - self._told_at) * (given.rate or inf) >= ON_TIME:
            self._told_at = stamp
            self._tell(message.header.stamp, waypoint.pose)

    def _tell_ignored(self, passage: Passage) -> None:
        """Tell of odometry that cannot be; one that comes late or twice is no news."""
        if passage.step is Succession.DOUBTED:
            stamp, (x, y, theta), _ = passage.waypoint
            given = self.parameters.fusion
            self.port.refuse(
                f'odom of {stamp:.3f} s at ({x:g} m, {y:g} m, {theta:g} rad) '
                f'{Succession.DOUBTED.value}; '
                f'limits: {given.max_speed:g} m/s, {given.max_turn_rate:g} rad/s, and a covariance '
                "that grows with the way (else set odom_covariance to 'assumed')"
            )

    def _noise_of(self, pose: Pose, numbers: Any) -> Covariance:
        """Return the covariance of the error about the origin of `odom` as it is told."""
        if self._assumes:
            return CERTAIN
        covariance = covariance_of(numbers)
        before, self._last_pose = self._last_pose, pose
        if covariance == CERTAIN and before not in {None, pose}:
            msg = (
                'odom moves and tells a covariance of 0: '
                "mend it, or set odom_covariance to 'assumed'"
            )
            raise SignalError(msg)
        return shift(covariance, -pose.x, -pose.y)

    def _on_fix(self, message: PoseWithCovarianceStamped) -> None:
        """Take a fix; one whose yaw has no variance, or one of any heading, has no heading."""
        require_frame(message.header.frame_id, self.parameters.map_frame)
        if self.port.clock.fault:  # nobody knows how old it is
            return
        self._require_recent(message.header.stamp)
        covariance = covariance_of(message.pose.covariance)
        pose = pose_of(message.pose.pose)
        unknown = covariance.xt == covariance.yt == covariance.tt == 0.0
        heading = None if unknown or covariance.tt > ANY_HEADING else pose.theta
        fix = Fix(seconds_of(message.header.stamp), pose.x, pose.y, covariance, heading)
        verdict = self._fusion.add_fix(fix)
        text = f'fix ({fix.x:.2f} m, {fix.y:.2f} m) of {fix.stamp:.3f} s {verdict.value}'
        if verdict is FixVerdict.KIDNAPPED:
            self.port.warning(text, throttle_duration_sec=1.0)
        elif verdict in {FixVerdict.EARLY, FixVerdict.LATE}:
            newest, horizon = self._fusion.newest_stamp, self.parameters.fusion.horizon
            self.port.refuse(f'{text}; odom is at {newest:.3f} s, fusion.horizon = {horizon:g} s')

    def _require_recent(self, stamp: Any) -> None:
        """Raise where a fix was taken too far from now, or when is not told.

        Late fixes, in any order, are of use: they take their place in time.
        """
        given, taken = self.parameters, stamp.sec * SECOND + stamp.nanosec
        if taken == 0:
            msg = 'fix with a stamp of 0: tell when it was measured, as the robot moves meanwhile'
            raise SignalError(msg)
        require_near(
            self.port, taken, max(given.max_age, given.fusion.horizon), self.port.nanoseconds()
        )

    def _on_imu(self, message: Imu) -> None:
        given = self.parameters
        require_frame(given.own(message.header.frame_id), given.imu_frame, given.base_frame)
        if message.angular_velocity_covariance[0] < 0.0:  # as sensor_msgs/Imu has it
            msg = 'angular_velocity_covariance[0] is negative: it tells no rate; publish none'
            raise SignalError(msg)
        rate = message.angular_velocity.z
        if not self._imu_watch.is_news(message.header.stamp):
            return
        stamp = seconds_of(message.header.stamp)
        if self._gyro is None:
            self._gyro = YawRate(given.gyro)
        self._gyro.add(stamp, rate, at_rest=self._at_rest)
        self._imu_watch.note()

    def _on_initial_pose(self, message: PoseWithCovarianceStamped) -> None:
        self.port.info(self._set_pose(message))

    def _set_pose(self, message: PoseWithCovarianceStamped) -> str:
        """Believe that the robot is where somebody says."""
        require_frame(message.header.frame_id, self.parameters.map_frame)
        pose, covariance = pose_of(message.pose.pose), covariance_of(message.pose.covariance)
        told = ''
        if covariance == CERTAIN:
            covariance, told = SAID, ', taken to be within about 0.5 m and 15 degrees'
        self._fusion.set_pose(pose, covariance)
        return f'the robot is at ({pose.x:.2f} m, {pose.y:.2f} m, {pose.theta:.2f} rad){told}'

    def _on_restart(self, _: Any) -> str:
        self._fusion.restart()
        return 'all forgotten: searching anew'

    # What goes out

    def _publish_filtered(self, odometry: Odometry, waypoint: Waypoint) -> None:
        """Publish odometry as the gyroscope corrected it, still in `odom`."""
        message = Odometry(header=odometry.header, twist=odometry.twist)
        message.header.frame_id = self.parameters.odom_frame
        message.child_frame_id = self.parameters.base_frame
        fill_pose(message.pose.pose, waypoint.pose)
        fill_covariance(
            message.pose.covariance, shift(waypoint.noise, waypoint.pose.x, waypoint.pose.y)
        )
        if self._gyro is not None:
            message.twist.twist.angular.z = self._gyro.rate
        self._filtered.publish(message)

    def _tell(self, stamp: Any, in_odom: Pose) -> None:
        """Publish pose and transforms while the robot is known to be somewhere."""
        given, estimate, health = self.parameters, self._fusion.estimate(), self._fusion.health()
        if health.state is not self._state:
            self.port.info(health.state.value)
            self._state = health.state
        transforms = []
        if self._tells is ToldTransforms.BOTH:
            transforms.append((given.odom_frame, given.base_frame, in_odom))
        if estimate is not None and self._trusted(health):
            self._publish_pose(stamp, estimate)
            transforms.append((given.map_frame, given.odom_frame, estimate.map_to_odom))
        if self._transforms is not None and transforms:
            self._transforms.publish(stamp, *transforms)

    def _publish_pose(self, stamp: Any, estimate: Estimate) -> None:
        message = PoseWithCovarianceStamped()
        message.header.stamp, message.header.frame_id = stamp, self.parameters.map_frame
        fill_pose(message.pose.pose, estimate.pose)
        fill_covariance(message.pose.covariance, estimate.covariance)
        self._pose.publish(message)

    def _trusted(self, health: Health) -> bool:
        given = self.parameters
        return (
            health.state is not FusionState.SEARCHING
            and health.position_deviation <= given.max_position_deviation
            and health.heading_deviation <= given.max_heading_deviation
        )


def main() -> None:
    """Run the node."""
    run(Localization)


if __name__ == '__main__':
    main()
