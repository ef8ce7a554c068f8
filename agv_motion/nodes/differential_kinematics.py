"""Node `differential_kinematics`: twist in, rates of two wheels out; encoders in, odometry out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from agv_motion.errors import SignalError
from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.kinematics.differential_platform import DifferentialBaseParameters
from agv_motion.nodes.wheels import WheelsNode
from agv_motion.nodes.wheels_parameters import WheelsParameters
from agv_motion.odometry.base import DifferentialBase
from agv_motion.odometry.wheel_odometry import WheelOdometry
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.run import run
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.continuity import Succession
    from agv_motion.planar import Twist
    from agv_motion.ros.port import Port


@dataclass(frozen=True)
class DifferentialKinematicsParameters(WheelsParameters, DifferentialBaseParameters):
    """The base, its limits, what makes it stop, and how far its encoders are trusted."""

    def __post_init__(self) -> None:
        """Check the limits and the base."""
        WheelsParameters.__post_init__(self)
        DifferentialBaseParameters.__post_init__(self)


class DifferentialKinematics(WheelsNode[DifferentialKinematicsParameters]):
    """`cmd_vel` -> `wheels/command`, `cmd_vel/limited`; `wheels/state` -> `odom`."""

    name = 'differential_kinematics'
    takes = DifferentialKinematicsParameters

    def __init__(self, port: Port, parameters: DifferentialKinematicsParameters) -> None:
        """Build the kinematics and the odometry, and open the topics."""
        super().__init__(port, parameters)
        given = parameters
        self._wheels = DifferentialDrive.of(given)
        base = DifferentialBase(self._wheels.track)
        self._odometry = WheelOdometry(base, given.wheel_radii, given.odometry)
        self.open_wheels(given.joint_names, given.wheel_radii, self._odometry, self._wheels.matrix)

    def diagnose(self) -> Diagnosis:
        """Tell of a stop and of silence."""
        silence, stopped = self.guard.command.silence(), self.why_stopped()
        values = {'cmd_vel': silence.value, 'odometry': self.states.last_step.value}
        values |= self.held_values()
        if stopped:
            return Diagnosis(ERROR, stopped, values)
        if self.standing:
            return Diagnosis(OK, 'standing', values)
        if silence is not Silence.FRESH:
            return Diagnosis(WARN, f'cmd_vel is {silence.value}', values)
        return Diagnosis(OK, 'driving', values)

    def rates(self, twist: Twist) -> Sequence[float]:
        """Return the rates of the wheels [rad/s], left and right."""
        speeds = self._wheels.command(twist, self.parameters.max_wheel_speed).speed
        return self._wheels.rates(speeds)

    def carry(self, stamp: float, angles: Sequence[float | None], *, by_rate: bool) -> Succession:
        """Carry the odometry on; it needs both wheels."""
        known = [angle for angle in angles if angle is not None]
        if len(known) < len(angles):
            lost = self.joints.names[list(angles).index(None)]
            msg = f'{lost} is missing: the odometry of two wheels needs both'
            raise SignalError(msg)
        return self._odometry.update(stamp, known, by_rate=by_rate)


def main() -> None:
    """Run the node."""
    run(DifferentialKinematics)


if __name__ == '__main__':
    main()
