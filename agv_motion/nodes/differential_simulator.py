"""Node `differential_simulator`: stands in for a differential drive and for what sees it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import JointState

from agv_motion.errors import SignalError
from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.kinematics.differential_platform import DifferentialBaseParameters
from agv_motion.nodes.simulated import SimulatedNode, SimulatedParameters, require_possible
from agv_motion.parameters import Spec
from agv_motion.ros.messages import fill_pose
from agv_motion.ros.qos import COMMAND, SENSOR
from agv_motion.ros.run import run
from agv_motion.ros.wheel_joints import WheelJoints
from agv_motion.simulation.differential import DifferentialRobot, DifferentialRobotParameters
from agv_motion.simulation.fixes import FixParameters, FixSensor

if TYPE_CHECKING:
    from agv_motion.ros.port import Port

SUBSTEPS = 4
"""Steps of the motors in one of the node."""


@dataclass(frozen=True)
class CameraParameters(FixParameters):
    """How good the pose is that a camera over the floor tells."""

    rate: Annotated[float, Spec('poses per simulated second', 'Hz', (0.01, 1000.0))] = 50.0
    position_noise: Annotated[float, Spec('standard deviation of x and of y', 'm', (0.0, 10.0))] = (
        0.01
    )
    heading_noise: Annotated[
        float, Spec('standard deviation of the heading', 'rad', (0.0, 3.2))
    ] = 0.01


@dataclass(frozen=True)
class DifferentialSimulatorParameters(SimulatedParameters, DifferentialBaseParameters):
    """The robot as it really is, what sees it, where it starts, and how fast time passes."""

    robot: DifferentialRobotParameters = field(default_factory=DifferentialRobotParameters)
    fixes: CameraParameters = field(default_factory=CameraParameters)

    def __post_init__(self) -> None:
        """Check every row, the start time and the wheels."""
        SimulatedParameters.__post_init__(self)
        DifferentialBaseParameters.__post_init__(self)


class DifferentialSimulator(SimulatedNode[DifferentialSimulatorParameters]):
    """`wheels/command` -> `wheels/state`, `fix`, `ground_truth`, `/clock`."""

    name = 'differential_simulator'
    takes = DifferentialSimulatorParameters

    def __init__(self, port: Port, parameters: DifferentialSimulatorParameters) -> None:
        """Put the robot at its start, and open the topics."""
        super().__init__(port, parameters)
        self._joints = WheelJoints(parameters.joint_names)
        self._state = port.publisher(JointState, 'wheels/state', SENSOR, sole=True)
        self._fix = port.publisher(PoseWithCovarianceStamped, 'fix', SENSOR)
        port.listen(JointState, 'wheels/command', self._on_command, COMMAND)
        port.need('wheels/command')

    def reset(self) -> DifferentialRobot:
        """Return a robot at its start, its wheels still."""
        given = self.parameters
        self._drive = DifferentialDrive.of(given)
        self._robot = DifferentialRobot(self._drive, given.robot, given.start(), given.seed)
        self._camera = FixSensor(given.fixes, given.seed)
        self._wanted = [0.0, 0.0]
        return self._robot

    def step(self, duration: float) -> None:
        """Let the motors follow their commands."""
        for _ in range(SUBSTEPS):
            self._robot.step(self._wanted, duration / SUBSTEPS)

    def let_go(self) -> None:
        """Stop both wheels."""
        self._wanted = [0.0, 0.0]

    def show(self, stamp: Any) -> None:
        """Publish what the encoders tell, and at its rate what the camera sees."""
        message = self._joints.message(self._drive.rates(self._robot.speeds))
        message.header.stamp, message.header.frame_id = stamp, self.parameters.base_frame
        message.position = self._robot.angles()
        self._state.publish(message)
        given = self.parameters
        if self.steps % max(round(given.rate / given.fixes.rate), 1) == 0:
            seen = PoseWithCovarianceStamped()
            seen.header.stamp, seen.header.frame_id = stamp, given.map_frame
            fill_pose(seen.pose.pose, self._camera.measure(self._robot.pose))
            seen.pose.covariance = self._camera.covariance()
            self._fix.publish(seen)

    def _on_command(self, message: JointState) -> None:
        rates = [rate for rate in self._joints.read(message).rates if rate is not None]
        if len(rates) != len(self._joints.names):
            msg = f'joints {list(message.name)}: give the velocity of {self._joints.names}'
            raise SignalError(msg)
        require_possible(rates)
        self._wanted = list(self._drive.speeds(rates))
        self.note_command()


def main() -> None:
    """Run the node."""
    run(DifferentialSimulator)


if __name__ == '__main__':
    main()
