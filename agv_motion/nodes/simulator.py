"""Node `simulator`: stands in for the platform, its localisation and the sun over the zone."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import Illuminance, JointState

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.platform import PlatformParameters
from agv_motion.kinematics.turrets import Turrets
from agv_motion.model.rolling import WheelTurns
from agv_motion.nodes.simulated import SimulatedNode, SimulatedParameters, require_possible
from agv_motion.parameters import Spec
from agv_motion.ros.messages import TurretJoints, fill_pose
from agv_motion.ros.qos import COMMAND, SENSOR
from agv_motion.ros.run import run
from agv_motion.simulation.fixes import FixParameters, FixSensor
from agv_motion.simulation.shade import LUX_PER_WATT, Obstacle, irradiance
from agv_motion.simulation.turret_platform import MotorParameters, TurretPlatform
from agv_motion.sun import sun

if TYPE_CHECKING:
    from agv_motion.planar import Pose
    from agv_motion.ros.port import Port


@dataclass(frozen=True)
class SimulatorParameters(SimulatedParameters, PlatformParameters):
    """The platform, the place, the time, and how fast it passes."""

    rate: Annotated[float, Spec('steps per simulated second', 'Hz', (1.0, 1000.0))] = 10.0
    start_x: Annotated[float, Spec('where the platform starts', 'm', (-1e4, 1e4))] = 10.0
    start_y: Annotated[float, Spec('where the platform starts', 'm', (-1e4, 1e4))] = 7.5
    latitude: Annotated[float, Spec('north positive', 'deg', (-90, 90))] = 48.86
    longitude: Annotated[float, Spec('east positive', 'deg', (-180, 180))] = 2.35
    obstacle_x: Annotated[tuple[float, ...], Spec('what throws shadows', 'm', (-1e4, 1e4))] = (
        4.0, 16.0, 10.0,
    )  # fmt: skip
    obstacle_y: Annotated[tuple[float, ...], Spec('what throws shadows', 'm', (-1e4, 1e4))] = (
        -2.0, -2.0, 17.0,
    )  # fmt: skip
    obstacle_radius: Annotated[tuple[float, ...], Spec('half width', 'm', (0, 1e3))] = (
        2.0, 3.0, 2.0,
    )  # fmt: skip
    obstacle_height: Annotated[tuple[float, ...], Spec('height', 'm', (0, 1e3))] = (
        8.0, 10.0, 6.0,
    )  # fmt: skip
    motors: MotorParameters = field(default_factory=MotorParameters)
    fixes: FixParameters = field(default_factory=FixParameters)

    def __post_init__(self) -> None:
        """Check every row, the start time, and that turrets and obstacles are whole."""
        SimulatedParameters.__post_init__(self)
        PlatformParameters.__post_init__(self)
        self.obstacles()

    def obstacles(self) -> list[Obstacle]:
        """Return what throws shadows."""
        columns = self.obstacle_x, self.obstacle_y, self.obstacle_radius, self.obstacle_height
        if len({len(column) for column in columns}) > 1:
            msg = (
                f'obstacle_x, _y, _radius and _height have {[len(c) for c in columns]} values: '
                'give all four of every obstacle'
            )
            raise ConfigurationError(msg)
        return [Obstacle(*row) for row in zip(*columns, strict=True)]


class SimulatedSunlight:
    """Publishes `sunlight`: how light it is where the tree stands."""

    def __init__(self, port: Port, given: SimulatorParameters) -> None:
        """Open the topic."""
        self._given, self._obstacles = given, given.obstacles()
        self._publisher = port.publisher(Illuminance, 'sunlight', SENSOR)

    def publish(self, stamp: Any, time: float, pose: Pose) -> None:
        """Publish the light at a pose and a time [s since 1970]."""
        given = self._given
        direction = sun(time, given.latitude, given.longitude)
        message = Illuminance()
        message.header.stamp, message.header.frame_id = stamp, given.base_frame
        message.illuminance = LUX_PER_WATT * irradiance(pose.x, pose.y, direction, self._obstacles)
        self._publisher.publish(message)


class SimulatedFixes:
    """Publishes `fix`: where a localisation takes the platform to be."""

    def __init__(self, port: Port, given: SimulatorParameters) -> None:
        """Open the topic."""
        self._given = given
        self._publisher = port.publisher(PoseWithCovarianceStamped, 'fix', SENSOR)
        self.reset()

    def reset(self) -> None:
        """Begin anew, with the same noise."""
        self._sensor = FixSensor(self._given.fixes, self._given.seed)

    def publish(self, stamp: Any, pose: Pose) -> None:
        """Publish what is measured of a pose."""
        message = PoseWithCovarianceStamped()
        message.header.stamp, message.header.frame_id = stamp, self._given.map_frame
        fill_pose(message.pose.pose, self._sensor.measure(pose))
        message.pose.covariance = self._sensor.covariance()
        self._publisher.publish(message)


class Simulator(SimulatedNode[SimulatorParameters]):
    """`turrets/command` -> `turrets/state`, `fix`, `ground_truth`, `sunlight` and `/clock`."""

    name = 'simulator'
    takes = SimulatorParameters

    def __init__(self, port: Port, parameters: SimulatorParameters) -> None:
        """Put the platform at its start and open the topics."""
        self._fixes = SimulatedFixes(port, parameters)
        super().__init__(port, parameters)
        self._joints = TurretJoints(len(parameters.turret_x))
        self._state = port.publisher(JointState, 'turrets/state', SENSOR, sole=True)
        self._sunlight = SimulatedSunlight(port, parameters)
        port.listen(JointState, 'turrets/command', self._on_command, COMMAND)
        port.need('turrets/command')

    def reset(self) -> TurretPlatform:
        """Return a platform at its start, its turrets straight."""
        given = self.parameters
        self._platform = TurretPlatform(Turrets.of(given), given.motors, given.start())
        self._turned = WheelTurns(len(given.turret_x))
        self._fixes.reset()
        self._wanted = list(self._platform.angles), list(self._platform.speeds)
        return self._platform

    def step(self, duration: float) -> None:
        """Let the motors follow their commands."""
        before, half = self._platform.speeds, 0.5 * duration / self.parameters.wheel_radius
        self._platform.step(*self._wanted, duration)
        pairs = zip(before, self._platform.speeds, strict=True)
        self._turned.add([half * (a + b) for a, b in pairs])

    def let_go(self) -> None:
        """Stop the wheels, and hold the turrets where they are."""
        self._wanted = list(self._platform.angles), [0.0] * len(self._platform.speeds)

    def show(self, stamp: Any) -> None:
        """Publish what the encoders tell, and at its rate where the tree is, and in what light."""
        given = self.parameters
        self._publish_state(stamp)
        if self.steps % max(round(given.rate / given.fixes.rate), 1) == 0:
            self._fixes.publish(stamp, self._platform.pose)
            self._sunlight.publish(stamp, self.time, self._platform.pose)

    def _on_command(self, message: JointState) -> None:
        if self._joints.is_standstill(message):
            self._wanted = self._wanted[0], [0.0] * len(self._wanted[0])
            self.note_command()
            return
        angles, rates = self._joints.read(message)
        require_possible(rates, angles)
        self.note_command()
        self._wanted = angles, [rate * self.parameters.wheel_radius for rate in rates]

    def _publish_state(self, stamp: Any) -> None:
        message = self._joints.message()
        message.header.stamp, message.header.frame_id = stamp, self.parameters.base_frame
        rates = [speed / self.parameters.wheel_radius for speed in self._platform.speeds]
        self._joints.fill(message, self._platform.angles, rates, self._turned.angles())
        self._state.publish(message)


def main() -> None:
    """Run the node."""
    run(Simulator)


if __name__ == '__main__':
    main()
