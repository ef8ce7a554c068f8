"""Node `omni_simulator`: stands in for an omni robot, its encoders, its gyroscope and its UWB."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import Imu, JointState

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.kinematics.omni_platform import OmniBaseParameters
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.nodes.simulated import SimulatedNode, SimulatedParameters, require_possible
from agv_motion.parameters import Spec
from agv_motion.planar import Pose
from agv_motion.ros.covariances import fill_covariance
from agv_motion.ros.messages import fill_pose, stamp_of
from agv_motion.ros.qos import COMMAND, SENSOR
from agv_motion.ros.run import run
from agv_motion.ros.wheel_joints import WheelJoints
from agv_motion.simulation.gyro import Gyro, GyroParameters
from agv_motion.simulation.omni import OmniRobot, OmniRobotParameters
from agv_motion.simulation.uwb import Uwb, UwbParameters

if TYPE_CHECKING:
    from agv_motion.ros.port import Port


@dataclass(frozen=True)
class OmniSimulatorParameters(SimulatedParameters, OmniBaseParameters):
    """The robot as drawn and as it really is, where it starts, and how fast time passes."""

    real_distances: Annotated[
        tuple[float, ...], Spec('of the wheels, where they differ from the drawing', 'm', (0, 100))
    ] = (0.2, 0.2, 0.2)
    real_radii: Annotated[
        tuple[float, ...],
        Spec('of the wheels, where they differ from the drawing', 'm', (0.001, 10)),
    ] = (0.05, 0.05, 0.05)
    rate: Annotated[float, Spec('steps per simulated second', 'Hz', (1.0, 1000.0))] = 20.0
    faulty_wheel: Annotated[
        int, Spec('wheel whose encoder is wrong, from 0; -1: none', '', (-1, 100), dynamic=True)
    ] = -1
    faulty_gain: Annotated[
        float, Spec('what it measures of its motion; 0: dead', '1', (-10.0, 10.0), dynamic=True)
    ] = 0.0
    imu_frame: Annotated[str, Spec('frame of the gyroscope, its z axis upright')] = 'imu_link'
    robot: OmniRobotParameters = field(default_factory=OmniRobotParameters)
    uwb: UwbParameters = field(default_factory=UwbParameters)
    gyro: GyroParameters = field(default_factory=GyroParameters)

    def __post_init__(self) -> None:
        """Check every row, and that every wheel is real."""
        SimulatedParameters.__post_init__(self)
        OmniBaseParameters.__post_init__(self)
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
                for wheel, share in zip(OmniWheels.of(self).wheels, shares, strict=True)
            ]
        )


class SimulatedImu:
    """Publishes `imu`: what a gyroscope measures of the robot's turn."""

    def __init__(self, port: Port, given: OmniSimulatorParameters) -> None:
        """Open the topic."""
        self._given = given
        self._publisher = port.publisher(Imu, 'imu', SENSOR)
        self.reset()

    def reset(self) -> None:
        """Begin anew, with the same noise."""
        self._gyro = Gyro(self._given.gyro, self._given.seed)

    def publish(self, stamp: Any, turn_rate: float) -> None:
        """Publish what is measured of a turn rate [rad/s]."""
        message = Imu()
        message.header.stamp, message.header.frame_id = stamp, self._given.imu_frame
        message.angular_velocity.z = self._gyro.measure(turn_rate, 1.0 / self._given.rate)
        message.orientation_covariance[0] = -1.0  # as REP-145 says of what is not measured
        message.linear_acceleration_covariance[0] = -1.0
        self._publisher.publish(message)


class OmniSimulator(SimulatedNode[OmniSimulatorParameters]):
    """`wheels/command` -> `wheels/state`, `fix`, `imu`, `ground_truth`, `/clock`."""

    name = 'omni_simulator'
    takes = OmniSimulatorParameters

    def __init__(self, port: Port, parameters: OmniSimulatorParameters) -> None:
        """Put the robot at its start and open the topics."""
        self._imu = SimulatedImu(port, parameters)
        super().__init__(port, parameters)
        self._joints = WheelJoints(parameters.joint_names)
        self._state = port.publisher(JointState, 'wheels/state', SENSOR, sole=True)
        self._fix = port.publisher(PoseWithCovarianceStamped, 'fix', SENSOR)
        port.listen(JointState, 'wheels/command', self._on_command, COMMAND)
        port.need('wheels/command')

    def accept(self, parameters: OmniSimulatorParameters) -> None:
        """Break or mend an encoder."""
        self._break(parameters)

    def reset(self) -> OmniRobot:
        """Return a robot at its start, its wheels still."""
        given = self.parameters
        self._robot = OmniRobot(
            given.real_wheels(), given.real_radii, given.robot, given.start(), given.seed
        )
        self._break(given)
        self._uwb = Uwb(given.uwb, given.seed)
        self._imu.reset()
        self._wanted = [0.0] * len(given.wheel_radii)
        return self._robot

    def step(self, duration: float) -> None:
        """Let the wheels follow their commands."""
        self._robot.step(self._wanted, duration)

    def let_go(self) -> None:
        """Stop all wheels."""
        self._wanted = [0.0] * len(self._wanted)

    def show(self, stamp: Any) -> None:
        """Publish what encoders and gyroscope tell, and what comes of the UWB."""
        given = self.parameters
        self._publish_state(stamp)
        self._imu.publish(stamp, self._robot.twist.wz)
        if self.steps % max(round(given.rate / given.uwb.rate), 1) == 0:
            self._uwb.measure(self.elapsed, self._robot.pose)
        for fix in self._uwb.arrivals(self.elapsed):
            self._publish_fix(fix)

    def _break(self, parameters: OmniSimulatorParameters) -> None:
        for wheel, encoder in enumerate(self._robot.encoders):
            encoder.gain = parameters.faulty_gain if wheel == parameters.faulty_wheel else 1.0

    def _on_command(self, message: JointState) -> None:
        rates = self._joints.read(message).rates
        if not rates or None in rates:
            msg = f'joints {list(message.name)}: give the velocity of {self._joints.names}'
            raise SignalError(msg)
        radii = self.parameters.real_radii
        require_possible([rate for rate in rates if rate is not None])
        self._wanted = [rate * r for rate, r in zip(rates, radii, strict=True) if rate is not None]
        self.note_command()

    def _publish_state(self, stamp: Any) -> None:
        radii = self.parameters.real_radii
        rates = [speed / r for speed, r in zip(self._robot.speeds, radii, strict=True)]
        message = self._joints.message(rates)
        message.header.stamp, message.header.frame_id = stamp, self.parameters.base_frame
        message.position = self._robot.angles()
        self._state.publish(message)

    def _publish_fix(self, fix: Any) -> None:
        message = PoseWithCovarianceStamped()
        steps = round(fix.stamp * self.parameters.rate)
        message.header.stamp = stamp_of(self.nanoseconds_at(steps))
        message.header.frame_id = self.parameters.map_frame
        fill_pose(message.pose.pose, Pose(fix.x, fix.y, fix.heading or 0.0))
        fill_covariance(message.pose.covariance, fix.covariance)
        self._fix.publish(message)


def main() -> None:
    """Run the node."""
    run(OmniSimulator)


if __name__ == '__main__':
    main()
