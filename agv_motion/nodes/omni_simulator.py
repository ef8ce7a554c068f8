"""Node `omni_simulator`: stands in for an omni robot, its encoders, its gyroscope and its UWB."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from rclpy.clock import Clock, ClockType
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock as ClockMessage
from sensor_msgs.msg import Imu, JointState
from std_srvs.srv import SetBool, Trigger

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.nodes.omni_parameters import OmniBaseParameters
from agv_motion.parameters import Spec
from agv_motion.planar import Pose
from agv_motion.ros.covariances import fill_covariance
from agv_motion.ros.messages import fill_pose, fill_twist, pose_of, stamp_of
from agv_motion.ros.node import OK, WARN, Diagnosis, ManagedNode
from agv_motion.ros.qos import COMMAND, SENSOR
from agv_motion.ros.run import run
from agv_motion.ros.wheel_joints import WheelJoints
from agv_motion.simulation.gyro import Gyro, GyroParameters
from agv_motion.simulation.omni import OmniRobot, OmniRobotParameters
from agv_motion.simulation.uwb import Uwb, UwbParameters

CLOCK = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


@dataclass(frozen=True)
class OmniSimulatorParameters(OmniBaseParameters):
    """The robot as drawn and as it really is, where it starts, and how fast time passes."""

    real_distances: Annotated[
        tuple[float, ...], Spec('of the wheels, where they differ from the drawing', 'm', (0, 100))
    ] = (0.2, 0.2, 0.2)
    real_radii: Annotated[
        tuple[float, ...],
        Spec('of the wheels, where they differ from the drawing', 'm', (0.001, 10)),
    ] = (0.05, 0.05, 0.05)
    rate: Annotated[float, Spec('steps per simulated second', 'Hz', (1.0, 1000.0))] = 20.0
    time_factor: Annotated[
        float,
        Spec(
            'simulated seconds per second; less where the machine is too slow', '1', (0.01, 1000.0)
        ),
    ] = 1.0
    start_time: Annotated[
        float, Spec('simulated time at the start, since 1970', 's', (0.0, 4e9))
    ] = 1000.0
    seed: Annotated[int, Spec('of all noise', '1', (0, 2**31))] = 1
    start_x: Annotated[float, Spec('where the robot starts', 'm', (-1e4, 1e4))] = 0.0
    start_y: Annotated[float, Spec('where the robot starts', 'm', (-1e4, 1e4))] = 0.0
    start_heading: Annotated[float, Spec('where it looks', 'rad', (-7.0, 7.0))] = 0.0
    faulty_wheel: Annotated[
        int, Spec('wheel whose encoder is wrong, from 0; -1: none', '', (-1, 100), dynamic=True)
    ] = -1
    faulty_gain: Annotated[
        float, Spec('what it measures of its motion; 0: dead', '1', (-10.0, 10.0), dynamic=True)
    ] = 0.0
    robot: OmniRobotParameters = field(default_factory=OmniRobotParameters)
    uwb: UwbParameters = field(default_factory=UwbParameters)
    gyro: GyroParameters = field(default_factory=GyroParameters)

    def __post_init__(self) -> None:
        """Check every row, and that every wheel is real."""
        super().__post_init__()
        count = len(self.wheel_radii)
        if not len(self.real_distances) == len(self.real_radii) == count:
            msg = (
                f'{len(self.real_distances)} real_distances and {len(self.real_radii)} real_radii '
                f'for {count} wheels: give both of every wheel'
            )
            raise ConfigurationError(msg)
        if self.faulty_wheel >= count:
            msg = f'faulty_wheel = {self.faulty_wheel}: there are wheels 0 to {count - 1}'
            raise ConfigurationError(msg)

    def real_wheels(self) -> OmniWheels:
        """Return the wheels where they really are."""
        shares = [
            real / drawn if drawn > 0.0 else 1.0
            for real, drawn in zip(self.real_distances, self.wheel_distances, strict=True)
        ]
        return OmniWheels(
            [
                wheel._replace(x=wheel.x * share, y=wheel.y * share)
                for wheel, share in zip(self.wheels().wheels, shares, strict=True)
            ]
        )


class OmniSimulator(ManagedNode[OmniSimulatorParameters]):
    """`wheels/command` -> `wheels/state`, `fix`, `imu`, `ground_truth`, `/clock`."""

    def __init__(self, **kwargs: Any) -> None:
        """Declare the parameters."""
        super().__init__('omni_simulator', OmniSimulatorParameters, **kwargs)

    def open(self) -> None:
        """Put the robot at its start and open the topics."""
        given = self.parameters
        self._paused = False
        self._joints = WheelJoints(given.joint_names)
        self._reset()
        self._clock_publisher = self.publisher(ClockMessage, '/clock', CLOCK)
        self._state = self.publisher(JointState, 'wheels/state', SENSOR)
        self._fix = self.publisher(PoseWithCovarianceStamped, 'fix', SENSOR)
        self._imu = self.publisher(Imu, 'imu', SENSOR)
        self._truth = self.publisher(Odometry, 'ground_truth', SENSOR)
        self.listen(JointState, 'wheels/command', self._on_command, COMMAND)
        self.serve(SetBool, '~/pause', self._on_pause)
        self.serve(Trigger, '~/reset', self._on_reset)
        self.serve(SetMap, '~/carry', self._on_carry)
        period = 1.0 / (given.rate * given.time_factor)
        self.every(period, self._step, Clock(clock_type=ClockType.STEADY_TIME))

    def accept(self, parameters: OmniSimulatorParameters) -> None:
        """Break or mend an encoder."""
        self._break(parameters)

    def diagnose(self) -> Diagnosis:
        """Tell the simulated time."""
        level, word = (WARN, 'paused') if self._paused else (OK, 'running')
        return Diagnosis(level, word, {'simulated time [s]': f'{self.elapsed:.1f}'})

    @property
    def elapsed(self) -> float:
        """Simulated time since the start [s]."""
        return self._steps / self.parameters.rate

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self.parameters.start_time + self.elapsed

    def carry_to(self, pose: Pose) -> None:
        """Lift the robot and set it down elsewhere, its wheels still."""
        self._robot.carry_to(pose)

    def _reset(self) -> None:
        given = self.parameters
        start = Pose(given.start_x, given.start_y, given.start_heading)
        self._robot = OmniRobot(
            given.real_wheels(), given.real_radii, given.robot, start, given.seed
        )
        self._break(given)
        self._uwb = Uwb(given.uwb, given.seed, given.start_time)
        self._gyro = Gyro(given.gyro, given.seed)
        self._wanted = [0.0] * len(given.wheel_radii)
        self._steps = 0

    def _break(self, parameters: OmniSimulatorParameters) -> None:
        self._robot.encoder_gains = [
            parameters.faulty_gain if wheel == parameters.faulty_wheel else 1.0
            for wheel in range(len(parameters.wheel_radii))
        ]

    def _on_command(self, message: JointState) -> None:
        rates = self._joints.read(message).rates
        if not rates or None in rates:
            msg = f'joints {list(message.name)}: give the velocity of {self._joints.names}'
            raise SignalError(msg)
        radii = self.parameters.real_radii
        self._wanted = [rate * r for rate, r in zip(rates, radii, strict=True) if rate is not None]

    def _on_pause(self, request: Any) -> str:
        self._paused = request.data
        return 'time stands still' if self._paused else 'time goes on'

    def _on_reset(self, _: Any) -> str:
        self._reset()
        return 'back at the start'

    def _on_carry(self, request: Any) -> str:
        pose = pose_of(request.initial_pose.pose.pose)
        self.carry_to(pose)
        return f'carried to ({pose.x:g} m, {pose.y:g} m, {pose.theta:g} rad), wheels still'

    def _step(self) -> None:
        """Let one step of simulated time pass and publish what there is to see."""
        if self._paused:
            return
        given, robot = self.parameters, self._robot
        robot.step(self._wanted, 1.0 / given.rate)
        self._steps += 1
        nanoseconds = round(given.start_time * 1e9) + round(self._steps * 1e9 / given.rate)
        stamp = stamp_of(nanoseconds)
        self._clock_publisher.publish(ClockMessage(clock=stamp))
        self._publish_state(stamp)
        self._publish_imu(stamp)
        self._publish_truth(stamp)
        if self._steps % max(round(given.rate / given.uwb.rate), 1) == 0:
            self._uwb.measure(nanoseconds * 1e-9, robot.pose)
        for fix in self._uwb.arrivals(nanoseconds * 1e-9):
            self._publish_fix(fix)

    def _publish_state(self, stamp: Any) -> None:
        radii = self.parameters.real_radii
        rates = [speed / r for speed, r in zip(self._robot.speeds, radii, strict=True)]
        message = self._joints.message(rates)
        message.header.stamp, message.header.frame_id = stamp, 'base_link'
        message.position = self._robot.angles()
        self._state.publish(message)

    def _publish_imu(self, stamp: Any) -> None:
        message = Imu()
        message.header.stamp, message.header.frame_id = stamp, 'imu_link'
        message.angular_velocity.z = self._gyro.measure(
            self._robot.twist.wz, 1.0 / self.parameters.rate
        )
        message.orientation_covariance[0] = -1.0  # as REP-145 says of what is not measured
        message.linear_acceleration_covariance[0] = -1.0
        self._imu.publish(message)

    def _publish_truth(self, stamp: Any) -> None:
        message = Odometry(child_frame_id='base_link')
        message.header.stamp, message.header.frame_id = stamp, 'map'
        fill_pose(message.pose.pose, self._robot.pose)
        fill_twist(message.twist.twist, self._robot.twist)
        self._truth.publish(message)

    def _publish_fix(self, fix: Any) -> None:
        message = PoseWithCovarianceStamped()
        message.header.stamp = stamp_of(round(fix.stamp * 1e9))
        message.header.frame_id = 'map'
        fill_pose(message.pose.pose, Pose(fix.x, fix.y, fix.heading or 0.0))
        fill_covariance(message.pose.covariance, fix.covariance)
        self._fix.publish(message)


def main() -> None:
    """Run the node."""
    run(OmniSimulator)


if __name__ == '__main__':
    main()
