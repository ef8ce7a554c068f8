"""A plain node on a ROS graph: its lifecycle, its parameters and its diagnostics.

What rclpy leaves open is closed here, once: an exception in a transition vanishes there without a
word, subscriptions of an inactive node keep running, and a message that cannot be used must be
refused with its reason while the node lives on.
"""

from __future__ import annotations

import time
import traceback
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn

from agv_motion.errors import AgvMotionError, shortened
from agv_motion.model.frames import in_namespace
from agv_motion.ros.clock_guard import CLOCK_TOPIC, LOOK_PERIOD, if_possible
from agv_motion.ros.complaints import Complaints
from agv_motion.ros.diagnosis import ERROR, WARN, Diagnosis
from agv_motion.ros.diagnostics import Diagnostics
from agv_motion.ros.graph_guard import GraphGuard
from agv_motion.ros.graph_watch import GRAPH_PERIOD
from agv_motion.ros.live_port import LivePort
from agv_motion.ros.log_callers import note_log_callers
from agv_motion.ros.parameter_changes import NOTHING, differing, refusal
from agv_motion.ros.parameters import DeclaredParameters
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.quotation import told
from agv_motion.ros.rclpy_services import answer_all
from agv_motion.ros.visible_logger import VisibleLogger

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.lifecycle import LifecycleState
    from rclpy.parameter import Parameter

N = TypeVar('N', bound=PlainNode[Any])

DEFECT_TRACE = 2000
"""Characters of the trace of a defect that are logged, from its end."""

LAST_WORD = 1.0
"""[s] that a stopping node waits until its listeners have acknowledged its last messages."""


class LiveNode(LifecycleNode, Generic[N]):
    """A lifecycle node that runs a plain one, tells why it refuses, and stops it safely."""

    def __init__(self, kind: type[N], **kwargs: Any) -> None:
        """Declare the parameters; the rest waits for `configure`.

        Args:
            kind: Class of the plain node.
            kwargs: Of rclpy's nodes, such as ``parameter_overrides`` and ``context``.

        """
        super().__init__(kind.name, **kwargs)
        self._logger = VisibleLogger(self.get_logger().name)
        self._kind = kind
        self._made: N | None = None
        self.steady = Clock(clock_type=ClockType.STEADY_TIME)
        note_log_callers()
        self.defect = ''
        """What went wrong in a callback by a fault of ours: the node was deactivated for it."""
        complaints = Complaints(self.get_logger(), time.monotonic)
        graph = GraphGuard(self, lambda: self.active, complaints.warn)
        self.port = LivePort(self, graph, complaints, self.message_of, self.stop_for)
        self.declared = DeclaredParameters(self, kind.takes, self._accept)
        self._start_watch(Diagnostics(self.port, self._condition))
        answer_all(self, self.port.refuse)
        for text in self.declared.unknown:
            self.port.refuse(text)

    @property
    def plain(self) -> N:
        """The plain node, as it was configured last."""
        assert self._made is not None, 'not configured yet'
        return self._made

    @property
    def parameters(self) -> Any:
        """The parameters in force."""
        return self.declared.values

    @property
    def active(self) -> bool:
        """Whether the node acts."""
        return self.port.active

    @property
    def complaint(self) -> str:
        """Why the last input that was not used was refused; empty if all were used."""
        return self.port.complaints.last

    def message_of(self, error: AgvMotionError) -> str:
        """Return the message of an error, without a word of a file that is not for everyone."""
        return told(error, self.declared.given)

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """Set parameters; what is wrong is refused with what to write, what is so already taken."""
        parameter_list = [
            self.declared.as_written(one, self.get_parameter_or(one.name, NOTHING).value)
            for one in parameter_list
        ]
        for parameter in parameter_list:
            wrong = self.declared.wrong(parameter.name, parameter.value)
            if wrong:
                return SetParametersResult(successful=False, reason=shortened(wrong))
        changes = differing(self, parameter_list)
        fixed = refusal(self, changes)
        if fixed or not changes:
            return SetParametersResult(successful=not fixed, reason=shortened(fixed))
        return super().set_parameters_atomically(changes)

    def create_subscription(
        self, msg_type: Any, topic: str, callback: Any, *args: Any, **kwargs: Any
    ) -> Any:
        """Create a subscription; a time on /clock that rclpy could not bear ends no node."""
        if topic == CLOCK_TOPIC:
            callback = if_possible(callback, self._distrust_clock)
        return super().create_subscription(msg_type, topic, callback, *args, **kwargs)

    def stop_for(self, where: str, error: Exception) -> str:
        """Deactivate the node for a defect, and return it in words.

        Nobody knows what state its callback has left.

        So the outputs are left safe; and it is told, as what an executor raises may end unheard.
        """
        self.defect = shortened(f'a defect in {where}: {type(error).__name__}: {error}')
        trace = ''.join(traceback.format_exception(error))
        self.get_logger().fatal(
            f'{self.defect}: deactivated, its outputs safe; activate it again, and report this: '
            f'{trace[-DEFECT_TRACE:]}'
        )
        if self.port.active:
            self.trigger_deactivate()
        return self.defect

    # Lifecycle

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Make the plain node with all that it opens, or nothing."""
        result = self._attempt('configure', self._make)
        if result is TransitionCallbackReturn.FAILURE:
            self.on_cleanup(state)
        return result

    def on_activate(self, _: LifecycleState) -> TransitionCallbackReturn:
        """Let the callbacks act, unless another node does; what was heard before counts no more."""
        port = self.port
        if port.graph.rivals:
            self.get_logger().error(f'cannot activate: {port.graph.rivals}')
            return TransitionCallbackReturn.FAILURE
        port.clock_guard.forget_inputs()
        result = self._attempt('activate', self.plain.begin)
        self.defect = ''
        port.active = result is TransitionCallbackReturn.SUCCESS
        port.ends.hear()
        if port.active:
            port.graph.introduce()
        return result

    def on_deactivate(self, _: LifecycleState) -> TransitionCallbackReturn:
        """Leave the outputs safe, then fall silent."""
        if self.port.active:
            self.port.active = False
            self._attempt('halt', self.plain.halt)
            end = self.port.steady_seconds() + LAST_WORD
            for publisher in self.publishers:
                left = max(end - self.port.steady_seconds(), 0.0)
                publisher.wait_for_all_acked(Duration(seconds=left))
        return TransitionCallbackReturn.SUCCESS

    def on_cleanup(self, _: LifecycleState) -> TransitionCallbackReturn:
        """Close the topics."""
        port = self.port
        port.graph.clear()
        port.clock_guard.clear()
        port.ends.forget_unheard()
        while port.ends:
            self._attempt('close', port.ends.pop())
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Leave the outputs safe and close the topics."""
        self.on_deactivate(state)
        return self.on_cleanup(state)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Go back to unconfigured with the outputs safe."""
        return self.on_shutdown(state)

    # Plumbing

    def _make(self) -> None:
        self._made = self._kind(self.port, self._placed(self.declared.values))

    def _start_watch(self, diagnostics: Diagnostics) -> None:
        """Look at clock and graph and publish diagnostics from now on, by the steady clock."""
        port = self.port
        port.clock_guard.look()
        self.create_timer(LOOK_PERIOD, port.clock_guard.look, clock=self.steady)
        self.create_timer(GRAPH_PERIOD, port.graph.check, clock=self.steady)
        self.create_timer(1.0, diagnostics.publish, clock=self.steady)

    def _condition(self) -> Diagnosis:
        """Return what the node says of itself, or why it does not act."""
        if self.port.active:
            try:
                return self.plain.diagnose()
            except Exception as error:  # noqa: BLE001 - a defect
                self.stop_for('the diagnostics', error)
        if self.port.graph.rivals:
            return Diagnosis(ERROR, f'stopped: {self.port.graph.rivals}', {})
        if self.defect:
            return Diagnosis(ERROR, f'stopped by {self.defect}', {})
        return Diagnosis(WARN, 'not active', {})

    def _distrust_clock(self, fault: str) -> None:
        self.port.clock.distrust(fault, self.port.steady_seconds())
        self.port.refuse(f'{fault}: look at who publishes it')

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

    def _accept(self, parameters: Any) -> None:
        if self.port.ends and self._made is not None:
            placed = self._placed(parameters)
            self._made.accept(placed)
            self._made.parameters = placed

    def _placed(self, parameters: Any) -> Any:
        """Return parameters with the names of frames as they are in the node's namespace."""
        return in_namespace(parameters, self.port.namespace)
