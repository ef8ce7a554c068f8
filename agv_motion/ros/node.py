"""The lifecycle of every node here: topics that exist while configured, and act while active.

What rclpy leaves open is closed here, once: an exception in a transition vanishes there without a
word, subscriptions of an inactive node keep running, and a message that cannot be used must be
refused with its reason while the node lives on.
"""

from __future__ import annotations

import time
import traceback
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.qos import DurabilityPolicy, QoSProfile

from agv_motion.errors import AgvMotionError, ConfigurationError, shortened
from agv_motion.motion.clock_watch import STANDS_AFTER, ClockWatch
from agv_motion.ros.graph_guard import GraphGuard
from agv_motion.ros.graph_watch import GRAPH_PERIOD
from agv_motion.ros.parameters import DeclaredParameters
from agv_motion.ros.quotation import told
from agv_motion.ros.rclpy_services import answer_all
from agv_motion.ros.refusals import Refusals

if TYPE_CHECKING:
    from collections.abc import Callable

    from _typeshed import DataclassInstance
    from rclpy.lifecycle import LifecycleState
    from rclpy.parameter import Parameter

    from agv_motion.motion.watchdog import Watchdog

P = TypeVar('P', bound='DataclassInstance')

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR

COMPLAINT_LIFETIME = 10.0
"""[s] How long a refused input keeps the diagnostics at WARN."""


DEFECT_TRACE = 2000
"""Characters of the trace of a defect that are logged, from its end."""

LAST_WORD = 1.0
"""[s] that a stopping node waits until its listeners have acknowledged its last messages."""


LOOK_PERIOD = 0.1
"""[s] between two looks at the node's clock."""

CLOCK_TOPIC = '/clock'

SELDOM = 5.0
"""[s] between two words in the log on what is wrong with the clock."""

PATIENCE = 2.0
"""[s] for which a node that has just begun waits for the first /clock without a word."""


class Diagnosis(NamedTuple):
    """How a node is, in words and numbers, for ``/diagnostics``."""

    level: bytes
    message: str
    values: dict[str, str]


class ManagedNode(LifecycleNode, Generic[P]):
    """A lifecycle node that tells why it refuses, and leaves its outputs safe when it stops.

    A node overrides `open` (build the core, open the topics), `begin`, `halt` (leave the outputs
    safe), `accept` (a dynamic change of parameters) and `diagnose`. Topics, timers and services
    made with `publisher`, `listen`, `every` and `serve` live from configure to cleanup, and
    their callbacks are silent while the node is inactive.
    """

    def __init__(self, name: str, parameters: type[P], **kwargs: Any) -> None:
        """Declare the parameters; the rest waits for `configure`."""
        super().__init__(name, **kwargs)
        self.active = False
        self._entities: list[Callable[[], Any]] = []
        self._unheard: dict[str, Callable[[], None]] = {}
        """Latched messages that came while inactive, by topic"""
        self._now = self.get_clock().handle.get_now
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.complaint = ''
        """Why the last input that was not used was refused."""
        self._complained_at = -COMPLAINT_LIFETIME
        self._refused = 0
        self._refusals = Refusals()
        self.defect = ''
        """What went wrong in a callback by a fault of ours: the node was deactivated for it."""
        self._graph = GraphGuard(self)
        self._declared = DeclaredParameters(self, parameters, self._accept)
        self._diagnostics = self._create_publisher(
            DiagnosticArray, '/diagnostics', QoSProfile(depth=10)
        )
        self.clock = ClockWatch()
        """Whether the node's clock can be believed; while it has a fault, inputs are lost"""
        self._watchdogs: list[Watchdog] = []
        self._on_fault: list[Callable[[], None]] = []
        self._clock_told, self._clock_told_at = False, self.steady_seconds() + PATIENCE - SELDOM
        self._start_watch()
        answer_all(self)
        for text in self._declared.unknown:
            self.refuse(text)

    # What a node overrides

    def open(self) -> None:
        """Build the core objects from `parameters` and open the topics; may raise."""

    def begin(self) -> None:
        """Start to act."""

    def halt(self) -> None:
        """Leave every output safe; the topics are still open."""

    def accept(self, parameters: P) -> None:
        """Take over dynamic parameters; raise an `AgvMotionError` to refuse them."""

    def diagnose(self) -> Diagnosis:
        """Return how the node is while active."""
        return Diagnosis(OK, 'running', {})

    # What a node uses

    @property
    def parameters(self) -> P:
        """The parameters in force."""
        return self._declared.values

    def nanoseconds(self) -> int:
        """Return the time of the node's clock [ns], simulated where `use_sim_time` is set."""
        return int(self._now().nanoseconds)

    def seconds(self) -> float:
        """Return the time of the node's clock [s], simulated where `use_sim_time` is set."""
        return float(self._now().nanoseconds) * 1e-9

    def steady_seconds(self) -> float:
        """Return the time of a clock that never leaps, stands or is simulated [s]."""
        return time.monotonic()

    def watch_over(self, watchdog: Watchdog) -> None:
        """Take an input for lost until it comes again, whenever the clock has a fault."""
        self._watchdogs.append(watchdog)
        limit = min(each.stop_after for each in self._watchdogs)
        self.clock.stands_after = max(limit - LOOK_PERIOD, 0.5 * limit)

    def stamp(self, message: Any) -> float:
        """Set the stamp of a message's header to now, without a new object; return now [s]."""
        stamp, now = message.header.stamp, self._now().nanoseconds
        stamp.sec, stamp.nanosec = divmod(now, 1_000_000_000)
        return float(now) * 1e-9

    def create_subscription(
        self, msg_type: Any, topic: str, callback: Any, *args: Any, **kwargs: Any
    ) -> Any:
        """Create a subscription; a time on /clock that rclpy could not bear ends no node."""
        if topic == CLOCK_TOPIC:
            callback = self._if_possible(callback)
        return super().create_subscription(msg_type, topic, callback, *args, **kwargs)

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """Set parameters; names and types that are wrong are refused with what to write."""
        for parameter in parameter_list:
            wrong = self._declared.wrong(parameter.name, parameter.value)
            if wrong:
                return SetParametersResult(successful=False, reason=shortened(wrong))
        return super().set_parameters_atomically(parameter_list)

    def publisher(self, kind: type[Any], topic: str, qos: QoSProfile, *, sole: bool = False) -> Any:
        """Return a publisher that lives until cleanup.

        Where it is the ``sole`` one that a robot may have, the node acts only as long as there is
        no other on the graph; tools of a person, such as `agv topic pub`, are told but let be.
        """
        publisher = self._create_publisher(kind, topic, qos)
        self._graph.add(kind, topic, qos, publishes=True, sole=sole)
        self._entities.append(lambda: self.destroy_publisher(publisher))
        return publisher

    def listen(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], qos: QoSProfile,
        *, sole: bool = False,
    ) -> None:  # fmt: skip
        """Call ``callback`` with each message while active; what it raises is told, not fatal.

        Nobody says again what is latched: what comes while inactive is heard at the activation.
        Where the messages should come from a ``sole`` node, it is told when several publish them.
        """
        latched = qos.durability is DurabilityPolicy.TRANSIENT_LOCAL

        def guarded(message: Any) -> None:
            if not self.active:
                if latched:
                    self._unheard[topic] = lambda: guarded(message)
                return
            try:
                callback(message)
            except AgvMotionError as error:
                self.refuse(f'{topic}: {self.message_of(error)}')
            except Exception as error:  # noqa: BLE001 - a defect
                self.stop_for(topic, error)

        subscription = self.create_subscription(
            kind, topic, guarded, qos,
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )  # fmt: skip
        self._graph.add(kind, topic, qos, publishes=False, sole=sole)
        self._entities.append(lambda: self.destroy_subscription(subscription))

    def every(
        self, seconds: float, callback: Callable[[], None], clock: Clock | None = None
    ) -> None:
        """Call ``callback`` periodically on the node's clock (or another) while active."""

        def guarded() -> None:
            if self.active:
                try:
                    callback()
                except AgvMotionError as error:
                    self.refuse(self.message_of(error))
                except Exception as error:  # noqa: BLE001 - a defect
                    self.stop_for('a timer', error)

        timer = self.create_timer(seconds, guarded, clock=clock)
        self._entities.append(lambda: self.destroy_timer(timer))

    def watch_inputs(self, stop_after: float, act: Callable[[], None]) -> None:
        """Call ``act``, which stops where an input is lost, at once when the clock has a fault.

        And else several times within ``stop_after`` [s], by the steady clock.
        """
        self.every(min(0.1, stop_after / 4.0), act, self._steady)
        self._on_fault.append(act)

    def serve(self, kind: type[Any], name: str, act: Callable[[Any], str]) -> None:
        """Offer a service whose answer is `success`, and `message` where its type has that.

        ``act`` returns what was done, or raises why not.
        """

        def guarded(request: Any, response: Any) -> Any:
            try:
                self._require_active()
                message, response.success = act(request), True
            except AgvMotionError as error:
                message = f'refused: {self.message_of(error)}'
            except Exception as error:  # noqa: BLE001 - a defect
                self.stop_for(name, error)
                message = f'refused: {self.defect}'
            if hasattr(response, 'message'):
                response.message = message.removeprefix('refused: ')
            line = self._refusals.line(f'{name}: {shortened(message)}', self.steady_seconds())
            if line:
                self.get_logger().info(line)
            return response

        service = self.create_service(kind, name, guarded)
        self._entities.append(lambda: self.destroy_service(service))

    def message_of(self, error: AgvMotionError) -> str:
        """Return the message of an error, without a word of a file that is not for everyone."""
        return told(error, self._declared.given)

    def refuse(self, reason: str) -> None:
        """Tell of an input that was not used, in the log and in the diagnostics."""
        self._refused += 1
        self.complaint, self._complained_at = shortened(reason), self.steady_seconds()
        self.warn(f'refused: {self.complaint}')

    def warn(self, text: str) -> None:
        """Log a warning; of repeats only some, with their number."""
        line = self._refusals.line(text, self.steady_seconds())
        if line:
            self.get_logger().warning(line)

    def stop_for(self, where: str, error: Exception) -> None:
        """Deactivate the node for a defect: nobody knows what state its callback has left.

        So the outputs are left safe; and it is told, as what an executor raises may end unheard.
        """
        self.defect = shortened(f'a defect in {where}: {type(error).__name__}: {error}')
        trace = ''.join(traceback.format_exception(error))
        self.get_logger().fatal(
            f'{self.defect}: deactivated, its outputs safe; activate it again, and report this: '
            f'{trace[-DEFECT_TRACE:]}'
        )
        if self.active:
            self.trigger_deactivate()

    # Lifecycle

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Open everything, or nothing."""
        result = self._attempt('configure', self.open)
        if result is TransitionCallbackReturn.FAILURE:
            self.on_cleanup(state)
        return result

    def on_activate(self, _: LifecycleState) -> TransitionCallbackReturn:
        """Let the callbacks act, unless another node does; what was heard before counts no more."""
        if self._graph.rivals:
            self.get_logger().error(f'cannot activate: {self._graph.rivals}')
            return TransitionCallbackReturn.FAILURE
        self._forget_inputs()
        result = self._attempt('activate', self.begin)
        self.defect = ''
        self.active = result is TransitionCallbackReturn.SUCCESS
        while self.active and self._unheard:
            self._unheard.popitem()[1]()
        return result

    def on_deactivate(self, _: LifecycleState) -> TransitionCallbackReturn:
        """Leave the outputs safe, then fall silent."""
        if self.active:
            self.active = False
            self._attempt('halt', self.halt)
            end = self.steady_seconds() + LAST_WORD
            for publisher in self.publishers:
                left = max(end - self.steady_seconds(), 0.0)
                publisher.wait_for_all_acked(Duration(seconds=left))
        return TransitionCallbackReturn.SUCCESS

    def on_cleanup(self, _: LifecycleState) -> TransitionCallbackReturn:
        """Close the topics."""
        self._graph.clear()
        self._watchdogs.clear()
        self._on_fault.clear()
        self._unheard.clear()
        self.clock.stands_after = STANDS_AFTER
        while self._entities:
            self._attempt('close', self._entities.pop())
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Leave the outputs safe and close the topics."""
        self.on_deactivate(state)
        return self.on_cleanup(state)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Go back to unconfigured with the outputs safe."""
        return self.on_shutdown(state)

    # Plumbing

    def _start_watch(self) -> None:
        """Look at clock and graph and publish diagnostics from now on, by the steady clock."""
        self._look_at_clock()
        self.create_timer(LOOK_PERIOD, self._look_at_clock, clock=self._steady)
        self.create_timer(GRAPH_PERIOD, self._graph.check, clock=self._steady)
        self.create_timer(1.0, self._publish_diagnostics, clock=self._steady)

    def _look_at_clock(self) -> None:
        """Take all inputs for lost while the clock has a fault, and tell of it."""
        clock, steady = self.clock, self.steady_seconds()
        clock.look(self.seconds(), steady)
        if clock.fault:
            self._forget_inputs()
            for act in self._on_fault if self.active else ():
                act()
        if clock.fault and not self._clock_told and steady - self._clock_told_at >= SELDOM:
            self._clock_told = True
            self.get_logger().error(f'{clock.fault}: standing still until it runs well')
        elif self._clock_told and not clock.fault:
            self._clock_told, self._clock_told_at = False, steady
            self.get_logger().info('the clock runs well: going on')

    def _forget_inputs(self) -> None:
        for watchdog in self._watchdogs:
            watchdog.forget()

    def _if_possible(self, callback: Callable[[Any], None]) -> Callable[[Any], None]:
        """Return ``callback`` for times that can be; a negative one raises in rclpy's own."""

        def guarded(message: Any) -> None:
            if message.clock.sec >= 0:
                callback(message)
                return
            fault = f'{CLOCK_TOPIC} told {message.clock.sec} s, and no time is negative'
            self.clock.distrust(fault, self.steady_seconds())
            self.refuse(f'{fault}: look at who publishes it')

        return guarded

    def _create_publisher(self, kind: type[Any], topic: str, qos: QoSProfile) -> Any:
        """Create a publisher without event callbacks: destroying those crashes EventsExecutor."""
        return self.create_publisher(
            kind, topic, qos, event_callbacks=PublisherEventCallbacks(use_default_callbacks=False)
        )

    def _attempt(self, transition: str, act: Callable[[], Any]) -> TransitionCallbackReturn:
        """Run one step of a transition; rclpy would swallow its exception without a word."""
        try:
            act()
        except AgvMotionError as error:
            self.get_logger().error(f'cannot {transition}: {self.message_of(error)}')
        except Exception:  # noqa: BLE001 - a defect: told with its trace, the node stays up
            self.get_logger().fatal(f'cannot {transition}: {traceback.format_exc()}')
        else:
            return TransitionCallbackReturn.SUCCESS
        return TransitionCallbackReturn.FAILURE

    def _require_active(self) -> None:
        if not self.active:
            msg = f'{self.get_name()} is not active: activate it first'
            raise ConfigurationError(msg)

    def _accept(self, parameters: P) -> None:
        if self._entities:
            self.accept(parameters)

    def _condition(self) -> Diagnosis:
        if self.active:
            try:
                return self.diagnose()
            except Exception as error:  # noqa: BLE001 - a defect
                self.stop_for('the diagnostics', error)
        if self._graph.rivals:
            return Diagnosis(ERROR, f'stopped: {self._graph.rivals}', {})
        if self.defect:
            return Diagnosis(ERROR, f'stopped by {self.defect}', {})
        return Diagnosis(WARN, 'not active', {})

    def _publish_diagnostics(self) -> None:
        level, message, values = self._condition()
        faults = self._graph.faults()
        values = values | self._graph.values()
        if level == OK and faults:
            level, message = WARN, faults[0]
        if self.clock.fault:
            level, message = ERROR, f'{self.clock.fault}: standing still'
        if self._refused:
            values = values | {'refused inputs': str(self._refused), 'last': self.complaint}
        if level == OK and self.steady_seconds() - self._complained_at < COMPLAINT_LIFETIME:
            level, message = WARN, f'refused: {self.complaint}'
        report = DiagnosticArray()
        self.stamp(report)
        name = f'{self.get_namespace()}/{self.get_name()}'.replace('//', '/')
        pairs = [KeyValue(key=key, value=value) for key, value in values.items()]
        report.status = [
            DiagnosticStatus(
                level=level, name=name, message=message, hardware_id=name, values=pairs
            )
        ]
        self._diagnostics.publish(report)
