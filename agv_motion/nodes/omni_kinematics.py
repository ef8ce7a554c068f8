"""Node `omni_kinematics`: twist in, rates of omni wheels out; their encoders in, odometry out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

from agv_motion.kinematics.omni_platform import OmniBaseParameters
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.nodes.wheels import WheelsNode
from agv_motion.nodes.wheels_parameters import WheelsParameters
from agv_motion.odometry.omni_odometry import OmniOdometry
from agv_motion.odometry.wheel_monitor import SOUND, WheelMonitor
from agv_motion.parameters import Spec
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.qos import SENSOR
from agv_motion.ros.run import run
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.continuity import Succession
    from agv_motion.odometry.wheel_fault import WheelDiagnosis
    from agv_motion.planar import Twist
    from agv_motion.ros.port import Port


@dataclass(frozen=True)
class OmniKinematicsParameters(WheelsParameters, OmniBaseParameters):
    """The base, its limits, what makes it stop, and how far its encoders are trusted."""

    residual_warning: Annotated[
        float, Spec('wheels slip against each other: warn above', 'm/s', (0.0, 50.0), dynamic=True)
    ] = 0.1

    def __post_init__(self) -> None:
        """Check the limits and the base."""
        WheelsParameters.__post_init__(self)
        OmniBaseParameters.__post_init__(self)


class OmniKinematics(WheelsNode[OmniKinematicsParameters]):
    """`cmd_vel` -> `wheels/command`, `cmd_vel/limited`; `wheels/state` -> `odom`, ...

    Odometry does without a wheel that is missing or, of four or more, faulty, and says so.
    """

    name = 'omni_kinematics'
    takes = OmniKinematicsParameters

    def __init__(self, port: Port, parameters: OmniKinematicsParameters) -> None:
        """Build the kinematics and the odometry, and open the topics."""
        super().__init__(port, parameters)
        given = parameters
        self._wheels = OmniWheels.of(given)
        self._odometry = OmniOdometry(self._wheels, given.wheel_radii, given.odometry)
        self._monitor = WheelMonitor(self._wheels, given.wheel_radii, given.odometry)
        self._diagnosis: WheelDiagnosis = SOUND
        self._free = port.publisher(JointState, 'wheels/free_speed', SENSOR)
        self._slip = port.publisher(Float64, 'wheels/residual', SENSOR)
        self.open_wheels(
            given.joint_names,
            given.wheel_radii,
            self._odometry.reckoning,
            self._wheels.matrix.tolist(),
        )
        port.every(1.0, self._look_for_faults)

    def diagnose(self) -> Diagnosis:
        """Tell of a stop, of silence, of slip and of wheels that odometry does without."""
        silence, stopped = self.guard.command.silence(), self.why_stopped()
        values = {
            'cmd_vel': silence.value,
            'odometry': self.states.last_step.value,
            'residual [m/s]': f'{self._odometry.reckoning.residual:.5f}',
            'wheels left out': ', '.join(self._names(self._odometry.left_out)) or 'none',
        } | self.held_values()
        if stopped:
            return Diagnosis(ERROR, stopped, values)
        if self._odometry.left_out:
            msg = f'odometry goes on without {values["wheels left out"]}: repair it'
            return Diagnosis(ERROR, msg, values)
        warning = self._warning(silence)
        doing = 'standing' if self.standing else 'driving'
        return Diagnosis(WARN if warning else OK, warning or doing, values)

    def rates(self, twist: Twist) -> list[float]:
        """Return the rate of each wheel [rad/s]."""
        given = self.parameters
        speeds = self._wheels.command(twist, given.max_wheel_speed).speed
        return [speed / r for speed, r in zip(speeds, given.wheel_radii, strict=True)]

    def carry(self, stamp: float, angles: Sequence[float | None], *, by_rate: bool) -> Succession:
        """Carry the odometry on, and watch the wheels."""
        step = self._odometry.update(stamp, angles, by_rate=by_rate)
        if step.used:
            self._monitor.add(stamp, angles)
        return step

    def tell_more(self, stamp: Any) -> None:
        """Publish slip, and how fast the rollers turn."""
        reckoning = self._odometry.reckoning
        self._slip.publish(Float64(data=reckoning.residual))
        rollers = self.joints.message(self._wheels.free_roller_speeds(reckoning.twist))
        rollers.header.stamp, rollers.header.frame_id = stamp, self.parameters.base_frame
        self._free.publish(rollers)

    def _warning(self, silence: Silence) -> str:
        """Return what is not as it should be though the robot drives; empty if nothing."""
        if not self._diagnosis.consistent:
            suspects = ' or '.join(self._names(self._diagnosis.suspects)) or 'several'
            return f'the wheels do not agree: look at {suspects}'
        if silence is not Silence.FRESH and not self.standing:
            return f'cmd_vel is {silence.value}'
        if self._odometry.reckoning.residual > self.parameters.residual_warning:
            return 'the wheels slip against each other'
        return ''

    def _look_for_faults(self) -> None:
        """Leave out the one wheel of four or more that measures what the others do not."""
        self._diagnosis = self._monitor.diagnosis()
        blamed = self._diagnosis.faulty
        faulty = frozenset[int]() if blamed is None else frozenset([blamed])
        if faulty != self._odometry.faulty:
            self._odometry.faulty = faulty
            for name in self._names(faulty):
                self.port.error(
                    f'{name} measures what the others do not: odometry goes on without it'
                )
            if not faulty:
                self.port.info('all wheels agree again: odometry uses each of them')

    def _names(self, wheels: Any) -> tuple[str, ...]:
        return tuple(self.parameters.joint_names[wheel] for wheel in sorted(wheels))


def main() -> None:
    """Run the node."""
    run(OmniKinematics)


if __name__ == '__main__':
    main()
