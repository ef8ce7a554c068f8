"""What nodes make of `wheels/state` that drive fixed wheels: `odom`, set by `~/set_odometry`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from sensor_msgs.msg import JointState

from agv_motion.errors import SignalError
from agv_motion.odometry.continuity import Succession
from agv_motion.odometry.covariance import CERTAIN, is_positive_definite
from agv_motion.ros.covariances import covariance_of, fill_covariance
from agv_motion.ros.messages import fill_pose, fill_twist, pose_of, require_frame, seconds_of
from agv_motion.ros.qos import COMMAND, SENSOR

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.nodes.wheels_parameters import WheelsParameters
    from agv_motion.odometry.wheel_angles import WheelAngles
    from agv_motion.odometry.wheel_odometry import WheelOdometry
    from agv_motion.ros.input_watch import InputWatch
    from agv_motion.ros.port import Port
    from agv_motion.ros.wheel_joints import WheelJoints


class Carrier(Protocol):
    """Who carries the odometry on."""

    reckoning: WheelOdometry
    """The odometry"""

    @property
    def joints(self) -> WheelJoints:
        """Names of the wheels."""

    def carry(self, stamp: float, angles: Sequence[float | None], *, by_rate: bool) -> Succession:
        """Carry the odometry on to ``angles`` [rad], None where a wheel tells nothing.

        Args:
            stamp: Time of the reading [s].
            angles: (n,) angle of each wheel [rad].
            by_rate: Whether some are added-up rates.

        """

    def note_motion(self) -> None:
        """Look at how far the wheels came, before it is told."""

    def tell_more(self, stamp: Any) -> None:
        """Publish what there is beside the odometry."""


class WheelStates:
    """Takes the encoders' angles, or rates where there are none, and tells the odometry."""

    def __init__(
        self, port: Port, given: WheelsParameters, carrier: Carrier, angles: WheelAngles,
        watch: InputWatch,
    ) -> None:  # fmt: skip
        """Open the topics.

        Args:
            port: Of the node.
            given: Its parameters.
            carrier: Of the odometry.
            angles: Of the wheels, which add up rates.
            watch: Of the input.

        """
        self.last_step = Succession.FIRST
        self._port, self._given, self._carrier = port, given, carrier
        self._angles, self._watch = angles, watch
        self._odom = port.publisher(Odometry, 'odom', SENSOR, sole=True)
        port.listen(JointState, 'wheels/state', self._on_state, SENSOR)
        port.need('wheels/state')
        port.listen(PoseWithCovarianceStamped, 'set_odometry', self._on_pose, COMMAND)
        port.serve(SetMap, '~/set_odometry', lambda request: self._go_on(request.initial_pose))

    def _on_state(self, message: JointState) -> None:
        """Carry the odometry on, and tell of it."""
        carrier, header = self._carrier, message.header
        state, news = carrier.joints.read(message), self._watch.is_news(header.stamp)
        stamp = seconds_of(header.stamp)
        angles = self._angles.add(stamp, state.angles, state.rates)
        try:
            step = self.last_step = carrier.carry(stamp, angles, by_rate=self._angles.by_rate)
        except SignalError as error:
            raise SignalError(f'{state.wrong}; {error}' if state.wrong else str(error)) from error
        if state.wrong:
            self._port.refuse(f'wheels/state: {state.wrong}; going by the rest')
        if not step.used:
            self._tell_ignored(stamp)
            return
        if news:
            self._watch.note()
        if step in {Succession.RESET, Succession.LEAP}:
            self._port.warning(
                f'{step.value}; odometry goes on from where it was, less sure',
                throttle_duration_sec=1.0,
            )
        carrier.note_motion()
        self._publish(header.stamp)
        carrier.tell_more(header.stamp)

    def _tell_ignored(self, stamp: float) -> None:
        """Tell of readings that cannot be; one that comes late or twice is no news."""
        if self.last_step is Succession.DOUBTED:
            limit = self._given.odometry.max_wheel_speed
            self._port.refuse(
                f'wheels/state of {stamp:.3f} s {Succession.DOUBTED.value}; wheels run '
                f'{limit:g} m/s at most '
                '(odometry.max_wheel_speed): look at the encoders and their clock'
            )

    def _publish(self, stamp: Any) -> None:
        given, reckoning = self._given, self._carrier.reckoning
        message = Odometry(child_frame_id=given.base_frame)
        message.header.stamp, message.header.frame_id = stamp, given.odom_frame
        fill_pose(message.pose.pose, reckoning.pose)
        fill_twist(message.twist.twist, reckoning.twist)
        fill_covariance(message.pose.covariance, reckoning.covariance())
        fill_covariance(message.twist.covariance, reckoning.twist_covariance())
        self._odom.publish(message)

    def _on_pose(self, message: PoseWithCovarianceStamped) -> None:
        self._port.info(self._go_on(message))

    def _go_on(self, asked: PoseWithCovarianceStamped) -> str:
        """Go on from the pose that is ``asked`` for."""
        require_frame(self._given.own(asked.header.frame_id), self._given.odom_frame)
        pose, covariance = pose_of(asked.pose.pose), covariance_of(asked.pose.covariance)
        if covariance != CERTAIN and not is_positive_definite(covariance):
            msg = (
                f'covariance {tuple(covariance)} (xx, xy, xt, yy, yt, tt) is not positive definite'
            )
            raise SignalError(msg)
        self._carrier.reckoning.set_odometry(pose, covariance)
        return f'odometry goes on from ({pose.x:g} m, {pose.y:g} m, {pose.theta:g} rad)'
