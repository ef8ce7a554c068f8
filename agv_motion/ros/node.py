"""The lifecycle of every node here: topics that exist while configured, and act while active.

What rclpy leaves open is closed here, once: an exception in a transition vanishes there without a
word, subscriptions of an inactive node keep running, and a message that cannot be used must be
refused with its reason while the node lives on.
"""

from __future__ import annotations

import traceback
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from rcl_interfaces.msg import SetParametersResult
from rclpy.duration import Duration
from rclpy.lifecycle import TransitionCallbackReturn

from agv_motion.errors import AgvMotionError, shortened
from agv_motion.ros.clock_guard import LOOK_PERIOD
from agv_motion.ros.complaints import Complaints
from agv_motion.ros.diagnosis import OK, Diagnosis
from agv_motion.ros.diagnostics import Diagnostics
from agv_motion.ros.ends import Ends
from agv_motion.ros.graph_guard import GraphGuard
from agv_motion.ros.graph_watch import GRAPH_PERIOD
from agv_motion.ros.parameters import DeclaredParameters
from agv_motion.ros.quotation import told
from agv_motion.ros.rclpy_services import answer_all
from agv_motion.ros.refusals import Refusals
from agv_motion.ros.timed_node import TimedNode

if TYPE_CHECKING:
    from collections.abc import Callable

    from _typeshed import DataclassInstance
    from rclpy.clock import Clock
    from rclpy.lifecycle import LifecycleState
    from rclpy.parameter import Parameter
    from rclpy.qos import QoSProfile


P = TypeVar('P', bound='DataclassInstance')

DEFECT_TRACE = 2000
"""Characters of the trace of a defect that are logged, from its end."""

LAST_WORD = 1.0
"""[s] that a stopping node waits until its listeners have acknowledged its last messages."""


class ManagedNode(TimedNode, Generic[P]):
    """A lifecycle node that tells why it refuses, and leaves its outputs safe when it stops.

    A node overrides `open` (build the core, open the topics), `begin`, `halt` (leave the outputs
    safe), `accept` (a dynamic change of parameters) and `diagnose`. Topics, timers and services
    made with `publisher`, `listen`, `every` and `serve` live from configure to cleanup, and
    their callbacks are silent while the node is inactive.
    """

    def __init__(self, name: str, parameters: type[P], **kwargs: Any) -> None:
        """Declare the parameters; the rest waits for `configure`."""
        super().__init__(name, **kwargs)
        self._ends = Ends(self)
        self._refusals = Refusals()
        self._complaints = Complaints(self, self._refusals)
        self.defect = ''
        """What went wrong in a callback by a fault of ours: the node was deactivated for it."""
        self._graph = GraphGuard(self)
        self._declared = DeclaredParameters(self, parameters, self._accept)
        self._diagnostics = Diagnostics(self, self._graph, self._complaints)
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

    @property
    def complaint(self) -> str:
        """Why the last input that was not used was refused; empty if all were used."""
        return self._complaints.last

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
        self._graph.add(kind, topic, qos, publishes=True, sole=sole)
        return self._ends.publisher(kind, topic, qos)

    def listen(
        self, kind: type[Any], topic: str, callback: Callable[[Any], None], qos: QoSProfile,
        *, sole: bool = False,
    ) -> None:  # fmt: skip
        """Call ``callback`` with each message while active; what it raises is told, not fatal.

        Nobody says again what is latched: what comes while inactive is heard at the activation.
        Where the messages should come from a ``sole`` node, it is told when several publish them.
        """
        self._graph.add(kind, topic, qos, publishes=False, sole=sole)
        self._ends.listen(kind, topic, callback, qos)

    def every(
        self, seconds: float, callback: Callable[[], None], clock: Clock | None = None
    ) -> None:
        """Call ``callback`` periodically on the node's clock (or another) while active."""
        self._ends.every(seconds, callback, clock)

    def watch_inputs(self, stop_after: float, act: Callable[[], None]) -> None:
        """Call ``act``, which stops where an input is lost, at once when the clock has a fault.

        And else several times within ``stop_after`` [s], by the steady clock.
        """
        self.every(min(0.1, stop_after / 4.0), act, self._steady)
        self._clock_guard.on_fault(act)

    def serve(self, kind: type[Any], name: str, act: Callable[[Any], str]) -> None:
        """Offer a service whose answer is `success`, and `message` where its type has that.

        ``act`` returns what was done, or raises why not.
        """
        self._ends.serve(kind, name, act)

    def close_later(self, close: Callable[[], Any]) -> None:
        """Call ``close`` at the cleanup, after what is opened from now on has been closed."""
        self._ends.add(close)

    def message_of(self, error: AgvMotionError) -> str:
        """Return the message of an error, without a word of a file that is not for everyone."""
        return told(error, self._declared.given)

    def refuse(self, reason: str) -> None:
        """Tell of an input that was not used, in the log and in the diagnostics."""
        self._complaints.refuse(reason)

    def warn(self, text: str) -> None:
        """Log a warning; of repeats only some, with their number."""
        self._complaints.warn(text)

    def inform(self, text: str) -> None:
        """Log what was done; of repeats only some, with their number."""
        self._complaints.inform(text)

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
        self._clock_guard.forget_inputs()
        result = self._attempt('activate', self.begin)
        self.defect = ''
        self.active = result is TransitionCallbackReturn.SUCCESS
        self._ends.hear()
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
        self._clock_guard.clear()
        self._ends.forget_unheard()
        while self._ends:
            self._attempt('close', self._ends.pop())
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
        self._clock_guard.look()
        self.create_timer(LOOK_PERIOD, self._clock_guard.look, clock=self._steady)
        self.create_timer(GRAPH_PERIOD, self._graph.check, clock=self._steady)
        self.create_timer(1.0, self._diagnostics.publish, clock=self._steady)

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

    def _accept(self, parameters: P) -> None:
        if self._ends:
            self.accept(parameters)
