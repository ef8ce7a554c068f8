"""Node `simulator`: stands in for the platform, its localisation and the sun over the zone."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import datetime, timezone
from typing import Annotated, Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.clock import Clock, ClockType
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock as ClockMessage
from sensor_msgs.msg import Illuminance, JointState
from std_srvs.srv import SetBool, Trigger

from agv_motion.errors import ConfigurationError
from agv_motion.nodes.platform_parameters import PlatformParameters
from agv_motion.parameters import Spec, check
from agv_motion.planar import Pose
from agv_motion.ros.messages import TurretJoints, fill_pose, fill_twist, stamp_of
from agv_motion.ros.node import OK, WARN, Diagnosis, ManagedNode
from agv_motion.ros.qos import COMMAND, SENSOR
from agv_motion.ros.run import run
from agv_motion.simulation.fixes import FixParameters, FixSensor
from agv_motion.simulation.shade import LUX_PER_WATT, Obstacle, irradiance
from agv_motion.simulation.sun import sun
from agv_motion.simulation.turret_platform import MotorParameters, TurretPlatform

CLOCK = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


@dataclass(frozen=True)
class SimulatorParameters(PlatformParameters):
    """The platform, the place, the time, and how fast it passes."""

    rate: Annotated[float, Spec('steps per simulated second', 'Hz', (1.0, 1000.0))] = 10.0
    time_factor: Annotated[
        float,
        Spec(
            'simulated seconds per second; less where the machine is too slow', '1', (0.01, 1000.0)
        ),
    ] = 1.0
    start_time: Annotated[str, Spec('simulated start, ISO 8601, UTC')] = '2015-06-15T11:00:00'
    seed: Annotated[int, Spec('of all noise', '1', (0, 2**31))] = 1
    start_x: Annotated[float, Spec('where the platform starts', 'm', (-1e4, 1e4))] = 10.0
    start_y: Annotated[float, Spec('where the platform starts', 'm', (-1e4, 1e4))] = 7.5
    start_heading: Annotated[float, Spec('where it looks', 'rad', (-7.0, 7.0))] = 0.0
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
        """Check every row, the start time, and that each obstacle is whole."""
        super().__post_init__()
        check(self)
        self.start()
        self.obstacles()

    def start(self) -> float:
        """Return the start time in seconds since 1970."""
        try:
            start = datetime.fromisoformat(self.start_time.replace('Z', '+00:00'))
        except ValueError as error:
            msg = f"start_time = '{self.start_time}': give ISO 8601 such as 2015-06-15T08:00:00"
            raise ConfigurationError(msg) from error
        return start.replace(tzinfo=start.tzinfo or timezone.utc).timestamp()

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


class Simulator(ManagedNode[SimulatorParameters]):
    """`turrets/command` -> `turrets/state`, `fix`, `ground_truth`, `sunlight` and `/clock`."""

    def __init__(self, **kwargs: Any) -> None:
        """Declare the parameters."""
        super().__init__('simulator', SimulatorParameters, **kwargs)

    def open(self) -> None:
        """Put the platform at its start and open the topics."""
        given = self.parameters
        self._obstacles = given.obstacles()
        self._joints = TurretJoints(len(given.turret_x))
        self._paused = False
        self._reset()
        self._clock_publisher = self.publisher(ClockMessage, '/clock', CLOCK)
        self._state = self.publisher(JointState, 'turrets/state', SENSOR)
        self._fix = self.publisher(PoseWithCovarianceStamped, 'fix', SENSOR)
        self._truth = self.publisher(Odometry, 'ground_truth', SENSOR)
        self._sunlight = self.publisher(Illuminance, 'sunlight', SENSOR)
        self.listen(JointState, 'turrets/command', self._on_command, COMMAND)
        self.serve(SetBool, '~/pause', self._on_pause)
        self.serve(Trigger, '~/reset', self._on_reset)
        period = 1.0 / (given.rate * given.time_factor)
        self.every(period, self._step, Clock(clock_type=ClockType.STEADY_TIME))

    def diagnose(self) -> Diagnosis:
        """Tell the simulated time."""
        time = datetime.fromtimestamp(self.time, timezone.utc).isoformat(timespec='seconds')
        level, word = (WARN, 'paused') if self._paused else (OK, 'running')
        return Diagnosis(level, word, {'simulated time': time})

    @property
    def elapsed(self) -> float:
        """Simulated time since the start [s]."""
        return self.time - self._start

    def _reset(self) -> None:
        given = self.parameters
        start = Pose(given.start_x, given.start_y, given.start_heading)
        self._platform = TurretPlatform(given.turrets(), given.motors, start)
        self._fix_sensor = FixSensor(given.fixes, given.seed)
        self._wanted = list(self._platform.angles), list(self._platform.speeds)
        self._start, self.steps = given.start(), 0
        self.time = self._start

    def _on_command(self, message: JointState) -> None:
        if self._joints.is_standstill(message):
            self._wanted = self._wanted[0], [0.0] * len(self._wanted[0])
            return
        angles, rates = self._joints.read(message)
        self._wanted = angles, [rate * self.parameters.wheel_radius for rate in rates]

    def _on_pause(self, request: Any) -> str:
        self._paused = request.data
        return 'time stands still' if self._paused else 'time goes on'

    def _on_reset(self, _: Any) -> str:
        self._reset()
        return f'back at the start, {self.parameters.start_time}'

    def _step(self) -> None:
        """Let one step of simulated time pass and publish what there is to see."""
        if self._paused:
            return
        given = self.parameters
        self._platform.step(*self._wanted, 1.0 / given.rate)
        self.steps += 1
        self.time = self._start + self.steps / given.rate
        stamp = stamp_of(round(self._start * 1e6) * 1000 + round(self.steps * 1e9 / given.rate))
        self._clock_publisher.publish(ClockMessage(clock=stamp))
        self._publish_state(stamp)
        self._publish_truth(stamp)
        if self.steps % max(round(given.rate / given.fixes.rate), 1) == 0:
            self._publish_fix(stamp)
            self._publish_sunlight(stamp)

    def _publish_state(self, stamp: Any) -> None:
        message = self._joints.message()
        message.header.stamp, message.header.frame_id = stamp, 'base_link'
        rates = [speed / self.parameters.wheel_radius for speed in self._platform.speeds]
        self._joints.fill(message, self._platform.angles, rates)
        self._state.publish(message)

    def _publish_truth(self, stamp: Any) -> None:
        message = Odometry(child_frame_id='base_link')
        message.header.stamp, message.header.frame_id = stamp, 'map'
        fill_pose(message.pose.pose, self._platform.pose)
        fill_twist(message.twist.twist, self._platform.twist)
        self._truth.publish(message)

    def _publish_fix(self, stamp: Any) -> None:
        message = PoseWithCovarianceStamped()
        message.header.stamp, message.header.frame_id = stamp, 'map'
        fill_pose(message.pose.pose, self._fix_sensor.measure(self._platform.pose))
        message.pose.covariance = self._fix_sensor.covariance()
        self._fix.publish(message)

    def _publish_sunlight(self, stamp: Any) -> None:
        given, pose = self.parameters, self._platform.pose
        direction = sun(self.time, given.latitude, given.longitude)
        message = Illuminance()
        message.header.stamp, message.header.frame_id = stamp, 'base_link'
        message.illuminance = LUX_PER_WATT * irradiance(pose.x, pose.y, direction, self._obstacles)
        self._sunlight.publish(message)


def main() -> None:
    """Run the node."""
    run(Simulator)


if __name__ == '__main__':
    main()
