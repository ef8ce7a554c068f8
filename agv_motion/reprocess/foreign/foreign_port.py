"""Where somebody's node is on the graph, and how its callbacks are called."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any

from rclpy.time import Time

from agv_motion.errors import AgvMotionError
from agv_motion.reprocess.foreign.refusal import refuse
from agv_motion.ros.in_process_port import Place

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.ros.in_process_graph import InProcessGraph


class ForeignPort:
    """Where a node is on the graph, and what it is given of it."""

    def __init__(self, graph: InProcessGraph) -> None:
        """Join the graph."""
        self.graph = graph
        self.active = True
        self.name = ''
        self.place = Place('', '/', {})
        self.clock: Any = None
        self.message_of: Callable[[AgvMotionError], str] = str

    def refuse(self, reason: str) -> None:
        """Count an input that was not used."""
        self.graph.note_complaint(f'{self.name}: refused: {reason}')

    def tell_time(self) -> None:
        """Set the clock of the node to that of the graph."""
        if self.clock is not None:
            self.clock.set_ros_time_override(
                Time(nanoseconds=self.graph.now, clock_type=self.clock.clock_type)
            )

    def guarded(self, callback: Callable[..., Any]) -> Callable[..., None]:
        """Return a callback that knows the time; what it raises ends the run, with the name."""
        _require_plain(callback)

        def act(*told: Any) -> None:
            self.tell_time()
            try:
                result = callback(*told)
            except AgvMotionError:
                raise
            except Exception as error:
                msg = f'{self.name} failed at {self.graph.now} ns: {where(error)}'
                raise RuntimeError(msg) from error
            if hasattr(result, '__await__'):
                refuse('has an asynchronous callback', 'make it a plain function')

        return act


def where(error: BaseException) -> str:
    """Return an error with the place where it was raised."""
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    place = ''
    if trace is not None:
        place = f' ({trace.tb_frame.f_code.co_filename}, line {trace.tb_lineno})'
    return f'{type(error).__name__}: {error}{place}'


def _require_plain(callback: Any) -> None:
    """Refuse a callback that is none of a message alone."""
    if inspect.iscoroutinefunction(callback):
        refuse('has an asynchronous callback', 'make it a plain function')
