"""Node `wheel_kinematics`: twist of the body in, angle and speed of each turret out."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

from std_srvs.srv import Trigger

from agv_motion.activity import HeldBy
from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.steering.controller import SteeringController
from agv_motion.kinematics.turrets import Turrets
from agv_motion.nodes.command_guard import CommandGuard
from agv_motion.nodes.steering_parameters import WheelKinematicsParameters
from agv_motion.nodes.turret_commands import LimiterReport, TurretCommands
from agv_motion.nodes.turret_states import TurretStates
from agv_motion.planar import REST, Twist
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.messages import (
    TurretJoints,
)
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.run import run
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from agv_motion.ros.port import Port

SOONEST = 0.4
"""[-] A step shorter than this share of the last one waits: limits of acceleration want even steps.
"""


class WheelKinematics(PlainNode[WheelKinematicsParameters]):
    """`cmd_vel` -> `turrets/command`, `cmd_vel/limited`; `turrets/state` -> `odom`, ...

    The steering planner brings the wheels to the wanted twist with one centre of rotation at every
    step. Where `turrets/state` tells how far the turrets have turned, the wheels roll no faster
    than the cosine of the worst error.

    Silence of `cmd_vel`, turrets that fight, `~/stop` and the end of the node all end in an
    explicit zero speed with the steering angles held.
    """

    standing = False
    """Nobody may leave this node without commands: unwinding and turrets need it."""
    name = 'wheel_kinematics'
    takes = WheelKinematicsParameters

    def __init__(self, port: Port, parameters: WheelKinematicsParameters) -> None:
        """Build the kinematics and open the topics."""
        super().__init__(port, parameters)
        given = parameters
        turrets, joints = Turrets.of(given), TurretJoints(len(given.turret_x))
        period = 1.0 / given.rate
        self._driving = SteeringController(turrets, given, period, given.unwind_after)
        self._residual = 0.0
        self._instant = 0
        """for which the last command was planned [ns]"""
        self._commands = TurretCommands(port, given, joints)
        self._limiter = LimiterReport(port)
        self._guard = CommandGuard(port, given, 'turrets/state', self)
        self._states = TurretStates(port, given, joints, self, self._guard.state)
        port.serve(Trigger, '~/unwind', self._on_unwind)
        port.every(period, self._go_on)
        port.watch_inputs(given.stop_after, self._watch)

    def halt(self) -> None:
        """Send the last word: no wheel turns."""
        self.stand()

    def accept(self, parameters: WheelKinematicsParameters) -> None:
        """Take over new limits; the next step holds them."""
        self._driving.planner.limits = parameters

    def diagnose(self) -> Diagnosis:
        """Tell of a stop, of silence, of turrets that fight, and of what limits the motion."""
        silence = self._guard.command.silence()
        values = {
            'residual [m/s]': f'{self._residual:.5f}',
            'cmd_vel': silence.value,
            'limited by': self._limiter.limiter.value,
            'wheel speed [m/s]': f'{self._states.fastest:.5f}',
            'commanded wheel speed [m/s]': f'{self._fastest_command():.5f}',
        } | self._guard.values()
        if not self._guard.reason and self._driving.unbelievable:
            values['held by'] = HeldBy.ANGLES.value
        if (setpoints := self._driving.setpoints) is not None:
            turns = max(setpoints.angles, key=abs) / (2.0 * pi)
            values['furthest turn of a turret'] = f'{turns:.2f}'
        if error := self._why_stopped():
            return Diagnosis(ERROR, error, values)
        if warning := self._driving.overturned():
            return Diagnosis(WARN, warning, values)
        if silence is not Silence.FRESH:
            return Diagnosis(WARN, f'cmd_vel is {silence.value}', values)
        if self._residual > self.parameters.residual_warning:
            return Diagnosis(WARN, 'the turrets pull against each other', values)
        return Diagnosis(OK, 'driving', values)

    def _fastest_command(self) -> float:
        setpoints = self._driving.setpoints
        if setpoints is None:
            return 0.0
        return float(max(map(abs, setpoints.speeds)) * self._driving.share())

    def _why_stopped(self) -> str:
        """Return why the wheels are held; empty if they are not."""
        reason = self._guard.reason
        return f'stopped: {reason}' if reason else self._driving.unbelievable

    # cmd_vel -> turrets/command

    @property
    def unwinding(self) -> bool:
        """Whether cables are being unwound, for which nobody needs to command."""
        return self._driving.unwinding

    def aim_at_rest(self) -> None:
        """Come to rest, step by step."""
        self._driving.set_target(REST)

    def drive(self, twist: Twist) -> None:
        """Answer a twist with a command at once."""
        self._driving.set_target(twist)
        setpoints = self._driving.setpoints
        if self._guard.reason or setpoints is None:
            self.stand()
            return
        self._step(SOONEST * setpoints.period)
        self._send()

    def start_anew(self) -> None:
        """Go on from where the turrets are."""
        self._driving.start_anew()

    def stand(self) -> None:
        """Command zero to the wheels; turrets that nobody has set or seen yet are left alone."""
        self._driving.stop()
        self._instant = self.port.nanoseconds()
        self._send()

    def _go_on(self) -> None:
        """Bring the wheels nearer to the wanted twist, also between two messages."""
        if self._driving.setpoints is None or self._guard.reason:
            return
        lost = self._guard.command.silence() is Silence.LOST
        if lost and not self._driving.unwinding:
            return  # _watch has stopped the wheels
        if self._step(0.5 / self.parameters.rate):
            self._send()

    def _step(self, soonest: float) -> bool:
        """Plan one step if ``soonest`` [s] have passed since the last; return whether they have."""
        self._instant = self.port.nanoseconds()  # for which it is planned is what a command tells
        if not self._driving.step(self._instant * 1e-9, soonest):
            return False
        setpoints = self._driving.setpoints
        if setpoints is not None:
            self._limiter.update(setpoints.limiter)
        return True

    def _send(self) -> None:
        self._commands.send(self._driving, self._instant)

    def _watch(self) -> None:
        """Look at the inputs, and at who listens."""
        self._commands.arrays.look_for_listeners()
        self._guard.judge()

    def _on_unwind(self, _: Any) -> str:
        if self._guard.reason:
            msg = f'stopped ({self._guard.reason}): release it first'
            raise ConfigurationError(msg)
        return self._driving.unwind()

    def note_angles(self, angles: list[float]) -> None:
        """Take up the angles of the turrets."""
        first = self._driving.measured is None
        self._driving.set_measured(angles)
        self._guard.state.note()
        if first and self._driving.overturned():
            self.port.warning(self._driving.overturned())

    def note_residual(self, residual: float) -> None:
        """Stop when the turrets fight too hard."""
        self._residual = residual
        if residual > self.parameters.residual_stop and not self._guard.stopped_by:
            fight = f'turrets fight by {residual:.4f} m/s'
            self.port.error(
                f'{fight}, limit {self.parameters.residual_stop} m/s: stopped; '
                'look at the turrets, then call ~/stop with data: false'
            )
            self._guard.stop_for(fight, HeldBy.FIGHT)


def main() -> None:
    """Run the node."""
    run(WheelKinematics)


if __name__ == '__main__':
    main()
