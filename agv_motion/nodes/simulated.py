"""What nodes share that stand in for a robot: time, pause, reset, kidnapping, the truth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Protocol, TypeVar

from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from rclpy.clock import Clock, ClockType
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock as ClockMessage
from std_srvs.srv import SetBool, Trigger

from agv_motion.parameters import Spec
from agv_motion.planar import Pose, Twist
from agv_motion.ros.messages import fill_pose, fill_twist, pose_of, stamp_of
from agv_motion.ros.node import OK, WARN, Diagnosis, ManagedNode
from agv_motion.ros.qos import SENSOR

CLOCK = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


@dataclass(frozen=True)
class SimulatedParameters:
    """Where the robot starts, and how fast time passes."""

    rate: Annotated[float, Spec('steps per simulated second', 'Hz', (1.0, 1000.0))] = 50.0
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

    def start(self) -> Pose:
        """Return where the robot starts."""
        return Pose(self.start_x, self.start_y, self.start_heading)


P = TypeVar('P', bound=SimulatedParameters)


class Body(Protocol):
    """The simulated robot."""

    pose: Pose
    twist: Twist

    def carry_to(self, pose: Pose) -> None:
        """Lift it and set it down elsewhere."""


class SimulatedNode(ManagedNode[P]):
    """Lets time pass in steps; a node overrides `reset`, `step` and `show`."""

    # What a node overrides

    def reset(self) -> Body:
        """Return a robot at its start."""
        raise NotImplementedError

    def step(self, duration: float) -> None:
        """Let the robot move for ``duration`` [s]."""
        raise NotImplementedError

    def show(self, stamp: Any) -> None:
        """Publish what is measured of it."""
        raise NotImplementedError

    # What a node uses

    def open(self) -> None:
        """Put the robot at its start, and open the topics."""
        given = self.parameters
        self._paused = False
        self.steps = 0
        self._body = self.reset()
        self._clock_publisher = self.publisher(ClockMessage, '/clock', CLOCK)
        self._truth = self.publisher(Odometry, 'ground_truth', SENSOR)
        self.serve(SetBool, '~/pause', self._on_pause)
        self.serve(Trigger, '~/reset', self._on_reset)
        self.serve(SetMap, '~/carry', self._on_carry)
        period = 1.0 / (given.rate * given.time_factor)
        self.every(period, self._step, Clock(clock_type=ClockType.STEADY_TIME))

    def diagnose(self) -> Diagnosis:
        """Tell the simulated time."""
        level, word = (WARN, 'paused') if self._paused else (OK, 'running')
        return Diagnosis(level, word, {'simulated time [s]': f'{self.elapsed:.1f}'})

    @property
    def elapsed(self) -> float:
        """Simulated time since the start [s]."""
        return self.steps / self.parameters.rate

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self.parameters.start_time + self.elapsed

    def carry_to(self, pose: Pose) -> None:
        """Lift the robot and set it down elsewhere, its wheels still."""
        self._body.carry_to(pose)

    def _on_pause(self, request: Any) -> str:
        self._paused = request.data
        return 'time stands still' if self._paused else 'time goes on'

    def _on_reset(self, _: Any) -> str:
        self.steps, self._body = 0, self.reset()
        return 'back at the start'

    def _on_carry(self, request: Any) -> str:
        pose = pose_of(request.initial_pose.pose.pose)
        self.carry_to(pose)
        return f'carried to ({pose.x:g} m, {pose.y:g} m, {pose.theta:g} rad), wheels still'

    def _step(self) -> None:
        """Let one step of simulated time pass and publish what there is to see."""
        if self._paused:
            return
        given = self.parameters
        self.step(1.0 / given.rate)
        self.steps += 1
        nanoseconds = round(given.start_time * 1e9) + round(self.steps * 1e9 / given.rate)
        stamp = stamp_of(nanoseconds)
        self._clock_publisher.publish(ClockMessage(clock=stamp))
        self.show(stamp)
        message = Odometry(child_frame_id='base_link')
        message.header.stamp, message.header.frame_id = stamp, 'map'
        fill_pose(message.pose.pose, self._body.pose)
        fill_twist(message.twist.twist, self._body.twist)
        self._truth.publish(message)
