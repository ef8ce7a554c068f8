"""A differential robot behind its Ghost, with slip, lag and a noisy pose: how well it follows.

The same trial serves the tests (a few seeds), the endurance run (hundreds) and the benchmark.
"""

from __future__ import annotations

import random
from contextlib import suppress
from dataclasses import dataclass, field, replace
from math import hypot, pi, sqrt
from statistics import fmean
from typing import TYPE_CHECKING, Annotated, NamedTuple

from agv_motion.errors import GeometryError
from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.parameters import Spec, check
from agv_motion.planar import Pose, wrap
from agv_motion.simulation.differential import DifferentialRobot, DifferentialRobotParameters
from agv_motion.trajectory.follower import Follower
from agv_motion.trajectory.follower_parameters import FollowerParameters

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.trajectory.follower_state import FollowerState
    from agv_motion.trajectory.ghost import Ghost
    from agv_motion.trajectory.trajectory import Trajectory

WHEEL_RADIUS = 0.05
"""[m]"""

LONGEST = 300.0
"""[s] A trial that takes longer has hung."""


@dataclass(frozen=True)
class TrackingTrialParameters:
    """The robot, its pose sensor and its cycle."""

    seed: Annotated[int, Spec('of trajectory and noise', '1', (0, 2**31))] = 1
    rate: Annotated[float, Spec('cycles of control per second', 'Hz', (1.0, 1000.0))] = 50.0
    steps: Annotated[int, Spec('of the simulated robot in a cycle', '1', (1, 100))] = 4
    position_noise: Annotated[
        float, Spec('standard deviation of measured x and y', 'm', (0.0, 1.0))
    ] = 0.01
    heading_noise: Annotated[
        float, Spec('standard deviation of the measured heading', 'rad', (0.0, 1.0))
    ] = 0.01
    slip: Annotated[float, Spec('largest share, of each wheel by itself', '1', (0.0, 0.5))] = 0.05
    cruising_speed: Annotated[float, Spec('of the Ghost', 'm/s', (0.01, 5.0))] = 0.5
    speed_ramps: Annotated[float, Spec('of the Ghost', 'm/s2', (0.01, 10.0))] = 0.5
    robot: DifferentialRobotParameters = field(default_factory=DifferentialRobotParameters)
    follower: FollowerParameters = field(default_factory=FollowerParameters)

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class TrackingSample(NamedTuple):
    """One cycle of a trial."""

    time: float
    """[s]"""
    planned: Pose
    """Where the Ghost is"""
    driven: Pose
    """Where the robot really is"""


class TrackingTrial:
    """One random trajectory, driven to its end."""

    def __init__(self, parameters: TrackingTrialParameters) -> None:
        """Draw a trajectory, and stand at its start."""
        self.given = given = parameters
        self._random = random.Random(given.seed)  # noqa: S311 - a simulation, no secret
        self._drive = DifferentialDrive(given.follower.ghost.track, [WHEEL_RADIUS] * 2)
        left, right = (given.slip * self._random.choice((0.0, 0.5, 1.0)) for _ in range(2))
        start = self._somewhere()
        self.robot = DifferentialRobot(
            self._drive, replace(given.robot, slip_left=left, slip_right=right), start, given.seed
        )
        self.follower = Follower(given.follower)
        while True:
            plan = self._plan(start)
            with suppress(GeometryError):  # a cusp: another one then
                self.trajectory = self.follower.depart(start, plan)
                break
        self.samples: list[TrackingSample] = []

    def run(self) -> FollowerState:
        """Drive to the end, and return how it ended."""
        given, follower, robot = self.given, self.follower, self.robot
        period = 1.0 / given.rate
        dt = 0.0
        while not follower.at_rest and len(self.samples) * period < LONGEST:
            twist = follower.step(self._measured(), dt)
            self.samples.append(
                TrackingSample(len(self.samples) * period, follower.ghost.pose, robot.pose)
            )
            speeds = self._drive.command(twist).speed
            for _ in range(given.steps):
                robot.step(speeds, period / given.steps)
            dt = period
        return follower.state

    def deviations(self) -> list[float]:
        """Return how far the robot was from its Ghost in each cycle [m]."""
        return [hypot(p.x - d.x, p.y - d.y) for _, p, d in self.samples]

    def rms(self) -> float:
        """Return the root mean square of that [m]."""
        return sqrt(fmean(deviation**2 for deviation in self.deviations()))

    def _measured(self) -> Pose:
        gauss, given, (x, y, theta) = self._random.gauss, self.given, self.robot.pose
        return Pose(
            x + gauss(0.0, given.position_noise),
            y + gauss(0.0, given.position_noise),
            wrap(theta + gauss(0.0, given.heading_noise)),
        )

    def _plan(self, start: Pose) -> Callable[[Ghost], Trajectory]:
        """Draw one of all that a Ghost can do."""
        draw, pace = self._random, (self.given.speed_ramps, self.given.cruising_speed)
        ramps, cruise = pace
        kind = draw.choice(('curve', 'curve', 'back', 'corners', 'turn', 'arc', 'path'))
        if kind == 'arc':
            angle, diameter = draw.uniform(-2.0 * pi, 2.0 * pi), draw.uniform(0.0, 3.0)
            return lambda ghost: ghost.compute_arc(angle, diameter, ramps, cruise)
        if kind == 'turn':
            goal = start._replace(theta=draw.uniform(-pi, pi))
            return lambda ghost: ghost.compute_trajectory(goal, 0.0, 1.0, 1.0, pure_rotation=True)
        goals = [self._somewhere() for _ in range(draw.randint(2, 4) if kind == 'path' else 1)]
        delta = 0.0 if kind == 'corners' else draw.uniform(0.25, 0.6)
        return lambda ghost: ghost.compute_path(goals, delta, *pace, backward=kind == 'back')

    def _somewhere(self) -> Pose:
        draw = self._random
        return Pose(draw.uniform(-4.0, 4.0), draw.uniform(-4.0, 4.0), draw.uniform(-pi, pi))
