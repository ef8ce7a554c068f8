"""When driven wheels stand: a zero, silence of what they hear, `standstill`, and `~/stop`.

What both kinds of kinematics do about their inputs is here, once. How wheels stop they know best.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from geometry_msgs.msg import Twist as TwistMessage
from geometry_msgs.msg import TwistStamped
from std_msgs.msg import Bool
from std_srvs.srv import SetBool

from agv_motion.activity import HeldBy
from agv_motion.planar import REST, Twist
from agv_motion.ros.input_watch import InputWatch
from agv_motion.ros.messages import require_frame, twist_of
from agv_motion.ros.qos import COMMAND, LATCHED
from agv_motion.ros.twist_rows import TwistRows
from agv_motion.watchdog import Silence

if TYPE_CHECKING:
    from agv_motion.nodes.input_parameters import DrivenParameters
    from agv_motion.ros.port import Port


STANDSTILL = 'standstill: STOP holds, or a dead-man was let go; the topic driver tells which'
"""Why wheels stand that an arbiter holds."""


class DrivenWheels(Protocol):
    """What is guarded."""

    @property
    def standing(self) -> bool:
        """Whether the last twist was zero, and silence is no more than a fact."""

    @property
    def unwinding(self) -> bool:
        """Whether the wheels work though nobody commands them."""

    def aim_at_rest(self) -> None:
        """Come to rest as a zero commands it, which is obeyed however old it is."""

    def drive(self, twist: Twist) -> None:
        """Answer a twist with a command at once; with a standstill while the guard `holds`."""

    def stand(self) -> None:
        """Stop all wheels at once, for safety, with an explicit zero."""

    def start_anew(self) -> None:
        """Be free to drive again, after a stop."""


class CommandGuard:
    """Passes on the twists that are news, and stops the wheels where it must."""

    def __init__(
        self, port: Port, given: DrivenParameters, encoders: str, wheels: DrivenWheels
    ) -> None:
        """Listen to `cmd_vel`, and offer `~/stop`.

        Args:
            port: Of the node.
            given: What the inputs are like, and how long they may be silent.
            encoders: Topic of the encoders; who listens to it feeds `state`.
            wheels: To guard.

        """
        limits, loss = given.freshness(), 'the wheels stop'
        self.command = InputWatch(port, 'cmd_vel', limits, loss=loss)
        self.state = InputWatch(port, encoders, limits, 'look at the encoders', loss)
        self.blind = ''
        """Why nobody knows what the wheels do; empty if somebody does, or never did"""
        self.stopped_by = ''
        """Why the wheels stand until a person releases them; empty if they need not"""
        self._stopper = HeldBy.NOBODY
        self.twist: Twist | None = None
        """The last that was taken; None: none was"""
        self.standstill = False
        """Whether the wheels stand for STOP, or because the arbiter lets them"""
        self._port, self._wheels, self._given = port, wheels, given
        self._lost = f'{encoders} is lost'
        if given.stamped:
            rows = TwistRows(given.base_frame)
            port.listen_to_rows(rows, 'cmd_vel', self._on_stamped_twist, COMMAND, sole=True)
        else:
            port.listen(TwistMessage, 'cmd_vel', self._on_twist, COMMAND, sole=True)
        port.need('cmd_vel')
        kind = TwistStamped if given.stamped else TwistMessage
        port.listen(kind, 'cmd_vel/stop', lambda _: self._hold(held=True), COMMAND)
        port.listen(Bool, 'standstill', self._on_standstill, LATCHED, sole=True)
        port.serve(SetBool, '~/stop', self._on_stop)

    @property
    def reason(self) -> str:
        """Why the wheels are held; empty if they are not."""
        return self.stopped_by or (STANDSTILL if self.standstill else self.blind)

    @property
    def held_by(self) -> HeldBy:
        """What the `reason` goes back to, for programs."""
        if self.stopped_by:
            return self._stopper
        if self.standstill:
            return HeldBy.ARBITER
        return HeldBy.ENCODERS if self.blind else HeldBy.NOBODY

    def values(self) -> dict[str, str]:
        """Return for the diagnostics what holds the wheels, what they hear, and how old that is."""
        now, names = self._port.steady_seconds(), ('vx [m/s]', 'vy [m/s]', 'wz [rad/s]')
        ages = {'cmd_vel': self.command.age(now), 'encoders': self.state.age(now)}
        return (
            {'held by': self.held_by.value}
            | {f'{name} age [s]': f'{age:.2f}' for name, age in ages.items() if age is not None}
            | {name: f'{n:.5f}' for name, n in zip(names, self.twist or (), strict=False)}
        )

    def stop_for(self, reason: str, stopper: HeldBy) -> None:
        """Hold the wheels until a person releases them by `~/stop`."""
        self.stopped_by, self._stopper = reason, stopper
        self._wheels.stand()

    def judge(self) -> None:
        """Stop where an input is lost, again and again; tell of silence before."""
        lost = self.state.tell() is Silence.LOST and self.state.spoken
        self.blind = self._lost if lost else ''
        command, wheels = self.command, self._wheels
        silence = command.silence() if wheels.standing else command.tell()
        silent = silence is Silence.LOST and not wheels.unwinding
        if lost or silent or self._port.clock.fault:
            wheels.stand()

    def _on_stamped_twist(self, twist: Twist, frame: str, stamp: int) -> None:
        if twist == REST:
            self.twist = twist
            self._wheels.aim_at_rest()
        if frame != self._given.base_frame:
            require_frame(self._given.own(frame), self._given.base_frame)
        if self.command.is_new(stamp):
            self._take(twist)

    def _on_twist(self, message: TwistMessage) -> None:
        self._take(twist_of(message))

    def _take(self, twist: Twist) -> None:
        """Drive, while the clock can be believed; only what was of use feeds the watchdog."""
        if not self._port.clock.fault:
            self.twist = twist
            self._wheels.drive(twist)
            self.command.note()

    def _on_standstill(self, message: Bool) -> None:
        self._hold(held=message.data)

    def _hold(self, *, held: bool) -> None:
        """Stand at once, by no ramp; once released, wait for the next twist.

        STOP need not wait for the arbiter, which may be gone; it is the arbiter that releases it.
        """
        before, self.standstill = self.standstill, held
        if held:
            self._wheels.stand()
        elif before:
            self._wheels.start_anew()

    def _on_stop(self, request: Any) -> str:
        if request.data:
            self.stop_for('by request', HeldBy.PERSON)
            return 'stopped; call again with data: false to drive on'
        self.stopped_by = ''
        if not self._port.count_publishers('standstill'):
            self.standstill = False  # no arbiter is there to release it
        self._wheels.start_anew()
        return f'still held: {STANDSTILL}' if self.standstill else 'free to drive'
