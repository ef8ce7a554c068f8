"""What nodes share that drive fixed wheels: `cmd_vel` and encoders in, motors and `odom` out.

A change of the twist is ramped within the limits of the wheels, a zero too: it brakes as hard as
the wheels may. Silence of `cmd_vel`, silence of the encoders once they have spoken, `~/stop` and
the end of the node are another matter: an explicit zero at once. Nobody then knows what lies ahead,
a node that ends cannot ramp, and a limit that somebody has set too low must not lengthen the stop;
how hard the wheels can brake their motors know best.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from agv_motion.activity import HeldBy
from agv_motion.kinematics.paced_ramp import PacedRamp
from agv_motion.kinematics.twist_ramp import TwistRamp
from agv_motion.nodes.blocked_report import BlockedReport
from agv_motion.nodes.command_guard import CommandGuard
from agv_motion.nodes.wheel_commands import WheelCommands
from agv_motion.nodes.wheel_states import WheelStates
from agv_motion.nodes.wheels_parameters import WheelsParameters
from agv_motion.odometry.wheel_angles import WheelAngles
from agv_motion.planar import REST, Twist
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.wheel_joints import WheelJoints

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.continuity import Succession
    from agv_motion.odometry.wheel_odometry import WheelOdometry

RELEASE = 'clear the wheels and see to the motors, then send a zero cmd_vel'
"""What lets blocked wheels go on."""

ARM = 0.2
"""[m] About half the width of a robot, where a turn of it is measured as a motion."""

LONGEST_STEP = 0.2
"""[s] A longer time between two readings counts as so much: nobody has looked meanwhile."""

P = TypeVar('P', bound=WheelsParameters)


class WheelsNode(PlainNode[P]):
    """`cmd_vel` -> `wheels/command`; `wheels/state` -> `odom`.

    A node opens with `open_wheels`, and overrides `rates` and `carry`. `cmd_vel/limited` tells what
    is commanded in truth.
    """

    unwinding = False
    """Fixed wheels have no cables to unwind."""

    # What a node overrides

    def rates(self, twist: Twist) -> Sequence[float]:
        """Return the rate of each wheel [rad/s] for ``twist``; raise where they cannot make it."""
        raise NotImplementedError

    def carry(self, stamp: float, angles: Sequence[float | None], *, by_rate: bool) -> Succession:
        """Carry the odometry on; see `Carrier`."""
        raise NotImplementedError

    def tell_more(self, stamp: Any) -> None:
        """Publish what there is beside the odometry."""

    # What a node uses

    def open_wheels(
        self,
        joint_names: Sequence[str],
        wheel_radii: Sequence[float],
        reckoning: WheelOdometry,
        rows: Sequence[Sequence[float]],
    ) -> None:
        """Open the topics and services of the wheels.

        Args:
            joint_names: (n,) of the wheels.
            wheel_radii: (n,) [m].
            reckoning: Their odometry.
            rows: (n, 3) rim speeds [m/s] of unit vx, vy and wz.

        """
        given, port = self.parameters, self.port
        self._ramp = PacedRamp(TwistRamp(rows, given), 1.0 / given.rate)
        self.reckoning = reckoning
        self.standing = True
        """Whether the last twist was zero: then nobody needs to drive on."""
        self._blocked = BlockedReport(port, given.blocked, ARM, RELEASE, LONGEST_STEP)
        self.commands = WheelCommands(port, WheelJoints(joint_names), given.base_frame)
        self.guard = CommandGuard(port, given, 'wheels/state', self)
        fastest = given.odometry.max_wheel_speed / min(wheel_radii)
        angles = WheelAngles(len(joint_names), given.odometry.max_gap, fastest)
        self.states = WheelStates(port, given, self, angles, self.guard.state)
        port.every(1.0 / given.rate, self._go_on)
        port.watch_inputs(given.stop_after, self._watch)

    @property
    def joints(self) -> WheelJoints:
        """Names of the wheels."""
        return self.commands.joints

    def begin(self) -> None:
        """Stand until a twist comes."""
        self.standing = True
        self._blocked.release()

    def halt(self) -> None:
        """Send the last word: no wheel turns."""
        self.stand()

    def why_stopped(self) -> str:
        """Return why the wheels are held; empty if they are not."""
        return f'stopped: {self.guard.reason}' if self.guard.reason else self._blocked.reason

    def held_values(self) -> dict[str, str]:
        """Return for the diagnostics what holds the wheels, and how fast they are."""
        fastest = self._ramp.ramp.fastest
        values = self.guard.values() | {
            'wheel speed [m/s]': f'{fastest(self.reckoning.twist):.5f}',
            'commanded wheel speed [m/s]': f'{fastest(self.commands.twist):.5f}',
        }
        if not self.guard.reason and self._blocked.reason:
            values['held by'] = HeldBy.BLOCKED.value
        return values

    # cmd_vel -> wheels/command

    def aim_at_rest(self) -> None:
        """Brake, where the wheels do not stand or brake already."""
        if not self.standing:
            self.standing = True
            self._follow(REST)

    def drive(self, twist: Twist) -> None:
        """Command the wheels."""
        if twist == REST:
            self._blocked.release()
        if self.guard.reason or self._blocked.reason:
            self.stand()
        else:
            self._follow(twist)
        self.standing = twist == REST

    def stand(self) -> None:
        """Stop all wheels at once, for safety."""
        self._ramp.stop()
        self._send(REST, self.port.nanoseconds())

    def start_anew(self) -> None:
        """Wait for the next twist."""

    def _follow(self, twist: Twist) -> None:
        """Go over to ``twist`` as fast as the wheels may, and answer with a command at once."""
        self.rates(twist)  # refuses what the wheels cannot make
        self._ramp.ramp.set_target(twist)
        self._advance()

    def _go_on(self) -> None:
        """Command the next step of a ramp, however seldom `cmd_vel` comes."""
        if not self._ramp.ramp.settled:
            self._advance()

    def _advance(self) -> None:
        """Command what the ramp has come to."""
        instant = self.port.nanoseconds()  # of what is commanded for it
        self._send(self._ramp.advance(instant * 1e-9), instant)

    def _send(self, twist: Twist, instant: int) -> None:
        self.commands.send(twist, self.rates(twist), instant)

    def _watch(self) -> None:
        """Look at the inputs, and at who listens."""
        self.commands.look_for_listeners()
        self.guard.judge()

    # wheels/state -> odom

    def note_motion(self) -> None:
        """Stop wheels that do not turn though told to, by their encoders."""
        blocked, commanded = self.parameters.blocked, self.commands.twist
        if self._blocked.look(blocked, self.reckoning.pose, commanded):
            self.stand()
