"""Run nodes until they are told to stop, and let them leave their outputs safe."""

from __future__ import annotations

import signal
import sys
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.executors import SingleThreadedExecutor
from rclpy.experimental import EventsExecutor
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions

from agv_motion.errors import AgvMotionError, ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.context import Context
    from rclpy.executors import Executor
    from rclpy.lifecycle import LifecycleNode

    from agv_motion.ros.node import ManagedNode

EXECUTORS: dict[str, Callable[..., Executor]] = {
    'events': EventsExecutor,
    'single_threaded': SingleThreadedExecutor,
}
SPIN_PERIOD = 0.1
"""[s] EventsExecutor hangs or burns a core when it waits without a limit (rclpy 7.1)."""


class StartError(AgvMotionError):
    """A transition on the way to `active` did not succeed; the node has logged why."""


def start(node: ManagedNode[Any]) -> None:
    """Configure and activate ``node``.

    Raises:
        StartError: One of the two transitions failed.

    """
    for transition in (node.trigger_configure, node.trigger_activate):
        if transition() is not TransitionCallbackReturn.SUCCESS:
            msg = f'{node.get_name()}: {transition.__name__[8:]} failed, see the error logged above'
            raise StartError(msg)


class Stop:
    """Turns true at SIGINT or SIGTERM; the context stays alive, so that a last word can be sent."""

    def __init__(self) -> None:
        """Take over both signals."""
        self.requested = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._on_signal)

    def _on_signal(self, *_: object) -> None:
        self.requested = True


def spin(
    nodes: Sequence[LifecycleNode],
    until: Callable[[], bool],
    executor: str = 'events',
    context: Context | None = None,
) -> None:
    """Spin ``nodes`` until ``until()``, then let each leave its outputs safe, first to last."""
    executor_object = EXECUTORS[executor](context=context)
    for node in nodes:
        executor_object.add_node(node)
    try:
        while rclpy.ok(context=context) and not until():
            executor_object.spin_once(timeout_sec=SPIN_PERIOD)
    finally:
        for node in nodes:
            node.trigger_shutdown()


def run(make_node: Callable[[], ManagedNode[Any]]) -> None:
    """Run one node until it is told to stop: the whole ``main`` of every node of this package.

    The exit status is 0 after SIGINT or SIGTERM, and 1 when the node could not start.
    """
    rclpy.init(args=sys.argv, signal_handler_options=SignalHandlerOptions.NO)
    stop = Stop()
    try:
        node = make_node()
        autostart = bool(node.declare_parameter('autostart', True).value)  # noqa: FBT003
        executor = str(node.declare_parameter('executor', 'events').value)
        if executor not in EXECUTORS:
            msg = f"executor = '{executor}': choose one of {', '.join(EXECUTORS)}"
            raise ConfigurationError(msg)
        if autostart:
            start(node)
        spin([node], lambda: stop.requested, executor)
    except (AgvMotionError, InvalidParameterTypeException, InvalidParameterValueException) as error:
        print(f'error: {error}', file=sys.stderr)  # noqa: T201 - there may be no node to log
        sys.exit(1)
    finally:
        rclpy.try_shutdown()


def overrides(**values: Any) -> list[Parameter]:
    """Return parameter overrides as a YAML file would give them, for nodes made in a program."""
    return [Parameter(name.replace('__', '.'), value=value) for name, value in values.items()]
