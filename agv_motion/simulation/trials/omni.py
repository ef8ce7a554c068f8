"""An omni robot roaming a zone with wheel odometry, UWB and their fusion: truth beside estimate.

The same trial serves the tests (minutes, many seeds), the endurance run (a day) and the demo.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from math import cos, hypot, pi, sin
from typing import TYPE_CHECKING, Annotated

from agv_motion.kinematics.omniwheel_placement import wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.odometry.base import OmniBase
from agv_motion.odometry.fusion import PoseFusion
from agv_motion.odometry.fusion_parameters import FusionParameters
from agv_motion.odometry.parameters import OdometryParameters
from agv_motion.odometry.wheel_odometry import WheelOdometry
from agv_motion.parameters import Spec, check
from agv_motion.planar import Pose, Twist
from agv_motion.simulation.omni import OmniRobot, OmniRobotParameters
from agv_motion.simulation.uwb import Uwb, UwbParameters

if TYPE_CHECKING:
    from agv_motion.odometry.fix import Fix

RADIUS = 0.05
"""[m] of the three wheels, at 30, 150 and 270 degrees."""
DISTANCE = 0.2
"""[m] of the wheels from the centre."""


@dataclass(frozen=True)
class TrialParameters:
    """The zone, the drive and the measurements."""

    seed: Annotated[int, Spec('of drive and noise', '1', (0, 2**31))] = 1
    rate: Annotated[float, Spec('readings of the encoders per second', 'Hz', (1.0, 1000.0))] = 20.0
    length: Annotated[float, Spec('of the zone along x', 'm', (1.0, 1e3))] = 20.0
    width: Annotated[float, Spec('of the zone along y', 'm', (1.0, 1e3))] = 15.0
    speed: Annotated[float, Spec('of the robot', 'm/s', (0.001, 5.0))] = 0.5
    turning: Annotated[float, Spec('fastest it turns meanwhile', 'rad/s', (0.0, 5.0))] = 0.5
    robot: OmniRobotParameters = field(default_factory=OmniRobotParameters)
    uwb: UwbParameters = field(default_factory=UwbParameters)
    fusion: FusionParameters = field(default_factory=FusionParameters)

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class OmniTrial:
    """One run; each step is one reading of the encoders."""

    def __init__(self, parameters: TrialParameters) -> None:
        """Put the robot somewhere in its zone, looking anywhere."""
        self.given = given = parameters
        self._random = random.Random(given.seed)  # noqa: S311 - a simulation, no secret
        self._wheels = OmniWheels(
            wheels_on_circle([pi / 6, 5 * pi / 6, 3 * pi / 2], [DISTANCE] * 3)
        )
        x, y = self._somewhere()
        start = Pose(x, y, self._random.uniform(-pi, pi))
        self.robot = OmniRobot(self._wheels, [RADIUS] * 3, given.robot, start, given.seed)
        self.uwb = Uwb(given.uwb, given.seed)
        noise = OdometryParameters(wheel_noise=max(given.robot.wheel_noise, 1e-6))
        self.odometry = WheelOdometry(OmniBase(self._wheels), [RADIUS] * 3, noise)
        self.fusion = PoseFusion(given.fusion)
        self.fixes: list[Fix] = []
        """Those that arrived in the last step"""
        self._goal, self._turning = self._somewhere(), 0.0
        self._steps = 0
        self._fix_every = max(round(given.rate / given.uwb.rate), 1)
        self._read()

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self._steps / self.given.rate

    def step(self) -> None:
        """Drive on a little, measure, and let the fusion know."""
        self.robot.step(self._wheels.command(self._wanted()).speed, 1.0 / self.given.rate)
        self._steps += 1
        if self._steps % self._fix_every == 0:
            self.uwb.measure(self.time, self.robot.pose)
        self._read()
        self.fixes = self.uwb.arrivals(self.time)
        for fix in self.fixes:
            self.fusion.add_fix(fix)

    def _read(self) -> None:
        odometry = self.odometry
        odometry.update(self.time, self.robot.angles())
        self.fusion.add_odometry(self.time, odometry.pose, odometry.origin_covariance)

    def _wanted(self) -> Twist:
        """Return the twist towards the goal, turning as one likes: that is what omni is for."""
        pose, given = self.robot.pose, self.given
        x, y = self._goal[0] - pose.x, self._goal[1] - pose.y
        distance = hypot(x, y)
        if distance < 0.3:
            self._goal = self._somewhere()
            self._turning = self._random.uniform(-given.turning, given.turning)
        c, s = cos(pose.theta), sin(pose.theta)
        speed = given.speed / max(distance, 1e-9)
        return Twist(speed * (c * x + s * y), speed * (c * y - s * x), self._turning)

    def _somewhere(self) -> tuple[float, float]:
        return (
            self._random.uniform(0.0, self.given.length),
            self._random.uniform(0.0, self.given.width),
        )
