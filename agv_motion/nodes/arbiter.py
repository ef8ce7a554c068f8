"""Node `arbiter`: of all who ask the robot to move one is obeyed; STOP comes before all."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import Twist as TwistMessage
from geometry_msgs.msg import TwistStamped
from std_srvs.srv import SetBool

from agv_motion.arbitration.arbiter import Arbiter
from agv_motion.arbitration.chassis_limits import ChassisLimits
from agv_motion.arbitration.source import DRIVERS, TwistSource
from agv_motion.nodes.arbiter_parameters import ArbiterParameters
from agv_motion.nodes.driver_report import DriverReport, diagnosis
from agv_motion.nodes.hold_keeper import HoldKeeper
from agv_motion.planar import REST, Twist
from agv_motion.ros.input_watch import InputWatch
from agv_motion.ros.messages import require_frame, twist_of
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import COMMAND
from agv_motion.ros.run import run
from agv_motion.ros.twist_rows import TwistRows, twist_publisher

if TYPE_CHECKING:
    from agv_motion.arbitration.choice import Choice, Hold
    from agv_motion.ros.diagnosis import Diagnosis
    from agv_motion.ros.port import Port

REPORT_PERIOD = 1.0
"""[s] after which `driver` is told again though nothing has changed."""


class ArbiterNode(PlainNode[ArbiterParameters]):
    """`cmd_vel/{stop,manual,page,route,sequence,agent}` -> `cmd_vel`, `driver`, `standstill`.

    While active it never falls silent: where nobody drives, it commands zero.
    """

    name = 'arbiter'
    takes = ArbiterParameters

    def __init__(self, port: Port, parameters: ArbiterParameters) -> None:
        """Take up what held before the restart, and open the topics."""
        super().__init__(port, parameters)
        given = parameters
        self._keeper = HoldKeeper(port, given.state_file)
        timeouts = {source: given.timeouts.of(source) for source in DRIVERS}
        self._arbiter = Arbiter(timeouts, self._keeper.before())
        self._limits = ChassisLimits(given.limits)
        self._watches = {
            source: InputWatch(
                port, f'cmd_vel/{source.value}', given.freshness(source), loss='obeyed no more'
            )
            for source in DRIVERS
        }
        self._commanded_at = 0.0
        self._report = DriverReport(port)
        self._publish = twist_publisher(port, given.base_frame, stamped=given.stamped)
        self._listen()
        port.serve(SetBool, '~/stop', self._on_stop)
        for source in DRIVERS:
            port.serve(SetBool, f'~/lock_{source.value}', partial(self._on_lock, source))
        port.every(1.0 / given.rate, self._go_on)
        port.every(REPORT_PERIOD, self._tell_again, steady=True)
        port.watch_inputs(0.5 * min(timeouts.values()), self._watch)

    def _listen(self) -> None:
        """Listen to all sources; STOP is heard whatever the message says."""
        port, given = self.port, self.parameters
        kind = TwistStamped if given.stamped else TwistMessage
        port.listen_always(kind, 'cmd_vel/stop', self._on_stop_message, COMMAND)
        for source in DRIVERS:
            topic = f'cmd_vel/{source.value}'
            if given.stamped:
                rows, take = TwistRows(given.base_frame), partial(self._on_stamped_twist, source)
                port.listen_to_rows(rows, topic, take, COMMAND, sole=True)
            else:
                port.listen(kind, topic, partial(self._on_twist, source), COMMAND, sole=True)

    def begin(self) -> None:
        """Let nothing count that was said before; tell how things stand, and keep it."""
        self._arbiter.forget()
        self._limits.stop()
        self._report.forget()
        self._command(self._choose())
        self._keep()

    def halt(self) -> None:
        """Send the last word: no motion, and nobody drives; what holds goes on holding."""
        self._arbiter.forget()
        choice = self._choose()
        self._report.stand(at_once=choice.at_once)
        self._publish(self._limits.stop())
        self._report.tell_inactive(choice)
        self._keep()

    def diagnose(self) -> Diagnosis:
        """Tell who drives, and what would be lost by a restart."""
        found = diagnosis(self._choose())
        if trouble := self._keeper.trouble:
            values = found.values | {'state_file': trouble}
            found = found._replace(values=values).worsened(trouble)
        if (others := self.port.count_publishers('cmd_vel') - 1) > 0:
            found = found.worsened(PAST_THE_ARBITER.format(others))
        return found

    @property
    def hold(self) -> Hold:
        """What holds until a person releases it."""
        return self._arbiter.hold

    # What the sources say

    def _on_stop_message(self, _: Any) -> None:
        self._stop('asked for on cmd_vel/stop')

    def _on_stamped_twist(self, source: TwistSource, twist: Twist, frame: str, stamp: int) -> None:
        if twist == REST and self._arbiter.rest(source):  # obeyed however old it is
            self._pass_on(source)
        require_frame(self.parameters.own(frame), self.parameters.base_frame)
        watch, port = self._watches[source], self.port
        if watch.is_new(stamp):
            age = (port.nanoseconds() - watch.newest) * 1e-9 / port.clock.speed
            self._take(source, twist, age)

    def _on_twist(self, source: TwistSource, message: TwistMessage) -> None:
        if not self.port.clock.fault:
            self._take(source, twist_of(message), 0.0)

    def _take(self, source: TwistSource, twist: Twist, age: float) -> None:
        """Take a twist that is so old [s], and pass it on at once if its source drives."""
        self._arbiter.receive(source, twist, self.port.steady_seconds() - max(age, 0.0))
        self._watches[source].note()
        self._pass_on(source)

    def _pass_on(self, source: TwistSource) -> None:
        choice = self._choose()
        if source is choice.driver or self._report.is_new(choice):
            self._command(choice)

    # Services

    def _on_stop(self, request: Any) -> str:
        if request.data:
            self._stop('asked for by ~/stop')
            return 'STOP holds; call again with data: false to release it'
        self._arbiter.release()
        self._report.forget()  # wheels may have heard a STOP that never came here
        self._command(self._choose())
        self._keep()
        return 'released: whoever speaks from now on drives'

    def _stop(self, reason: str) -> None:
        """Let the wheels stand first, then keep that."""
        if self._arbiter.hold.stop is None:
            self._arbiter.stop(reason, self.port.seconds())
            self._command(self._choose())
            self.port.warning(f'STOP: {reason}')
        self._keep()

    def _on_lock(self, source: TwistSource, request: Any) -> str:
        if request.data:
            self._arbiter.lock(source)
        else:
            self._arbiter.unlock(source)
        self._command(self._choose())
        self._keep()
        return 'locked: nothing below it drives' if request.data else 'unlocked'

    # cmd_vel

    def _choose(self) -> Choice:
        return self._arbiter.choose(self.port.steady_seconds())

    def _command(self, choice: Choice) -> None:
        """Command what was chosen, the wheels' standstill first; tell of it where it is new."""
        self._report.stand(at_once=choice.at_once)
        now = self.port.seconds()
        # after a rest, or a hiccup, no more time counts than has passed in one step, or two
        period = 1.0 / self.parameters.rate
        longest = period if self._limits.twist == REST else 2.0 * period
        dt = min(max(now - self._commanded_at, 0.0), longest)
        self._commanded_at = self._publish(self._limits.apply(choice.twist, dt))
        if self._report.is_new(choice):
            self._report.tell(choice)

    def _go_on(self) -> None:
        """Command the next step of a ramp, and whenever the driver has not spoken for a while."""
        waited = self.port.seconds() - self._commanded_at
        period = 1.0 / self.parameters.rate
        if not (0.0 <= waited < 1.5 * period and self._limits.settled):
            self._command(self._choose())

    def _watch(self) -> None:
        """Find who has fallen silent; again and again while the clock has a fault, and stands."""
        if self.port.clock.fault:
            self._arbiter.forget()
        choice = self._choose()
        if self._report.is_new(choice) or self.port.clock.fault:
            self._command(choice)
            self._keep()

    def _tell_again(self) -> None:
        self._report.publish(diagnosis(self._choose()))
        self._keep()

    def _keep(self) -> None:
        self._keeper.keep(self._arbiter.hold)


PAST_THE_ARBITER = (
    'cmd_vel has {} more publishers, past the arbiter: remap theirs to cmd_vel/agent or the like'
)


def main() -> None:
    """Run the node."""
    run(ArbiterNode)


if __name__ == '__main__':
    main()
