"""Run nodes until they are told to stop, and let them leave their outputs safe."""

from __future__ import annotations

import re
import sys
import time
import traceback
from typing import TYPE_CHECKING, Any

import rclpy
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    NameValidationException,
)
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.experimental import EventsExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.parameter import Parameter

from agv_motion.errors import AgvMotionError, ConfigurationError
from agv_motion.ros.context import begin_context
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.parameter_arguments import check_arguments, overruled, passed_over
from agv_motion.ros.stop import Stop, end_no_more

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.context import Context
    from rclpy.executors import Executor
    from rclpy.lifecycle import LifecycleNode

    from agv_motion.ros.plain_node import PlainNode

EXECUTORS: dict[str, Callable[..., Executor]] = {
    'events': EventsExecutor,
    'single_threaded': SingleThreadedExecutor,
}
SPIN_PERIOD = 0.1
"""[s] EventsExecutor hangs or burns a core when it waits without a limit (rclpy 7.1)."""

HOPELESS = 5.0
"""[s] in which every round of the executor has failed: then it is no single request any more."""

LONGEST_TRACE = 2000
"""Characters of a trace that are logged, from its end."""

OUT_OF_RANGE = re.compile(r'Parameter (\S+) out of range Min: (\S+), Max: (\S+), value: ([^\s:]+)')
"""What rclpy says of a parameter"""

UNUSABLE = (
    AgvMotionError,
    InvalidParameterTypeException,
    InvalidParameterValueException,
    NameValidationException,
    rclpy_implementation.RCLError,
    rclpy_implementation.UnknownROSArgsError,
)
"""What is wrong with what the user gave, told in a line; anything else is a defect of ours."""


class StartError(AgvMotionError):
    """A transition on the way to `active` did not succeed; the node has logged why."""


def start(node: LiveNode[Any], until: Callable[[], bool] = lambda: False) -> None:
    """Configure and activate ``node``, unless ``until()`` turns true meanwhile.

    Raises:
        StartError: One of the two transitions failed.

    """
    for transition in (node.trigger_configure, node.trigger_activate):
        if until():
            return
        if transition() is not TransitionCallbackReturn.SUCCESS:
            msg = f'{node.get_name()}: {transition.__name__[8:]} failed, see the error logged above'
            raise StartError(msg)


def spin(
    nodes: Sequence[LifecycleNode],
    until: Callable[[], bool],
    executor: str = 'events',
    context: Context | None = None,
) -> None:
    """Spin ``nodes`` until ``until()``, then let each leave its outputs safe, first to last.

    What a request to rclpy's own services raises (of nodes, `LiveNode` sees to it) is told, and
    the nodes live on.
    """
    executor_object = EXECUTORS[executor](context=context)
    for node in nodes:
        executor_object.add_node(node)
    sound = time.monotonic()
    try:
        while rclpy.ok(context=context) and not until():
            error = _spin_once(executor_object)
            if error is None:
                sound = time.monotonic()
                continue
            _tell(nodes[0], 'the executor goes on after a failure', error)
            if time.monotonic() - sound > HOPELESS:
                raise error
    finally:
        for node in nodes:
            shut_down(node)


def _spin_once(executor: Executor) -> Exception | None:
    """Let an executor do what is due; return what it raised."""
    try:
        executor.spin_once(timeout_sec=SPIN_PERIOD)
    except ExternalShutdownException:  # the loop that called ends
        return None
    except Exception as error:  # noqa: BLE001 - judged by the caller
        return error
    return None


def shut_down(node: LifecycleNode) -> None:
    """Let a node leave its outputs safe; a failure must not keep the next one from it."""
    try:
        node.trigger_shutdown()
    except rclpy_implementation.RCLError:
        return  # somebody has shut it down before
    except Exception as error:  # noqa: BLE001 - told with its trace
        _tell(node, 'cannot shut down', error)


def _tell(node: LifecycleNode, what: str, error: Exception) -> None:
    """Log an exception with its trace, now and then."""
    trace = ''.join(traceback.format_exception(error))
    node.get_logger().error(f'{what}: {trace[-LONGEST_TRACE:]}', throttle_duration_sec=1.0)


def run(kind: type[PlainNode[Any]]) -> None:
    """Run one node until it is told to stop: the whole ``main`` of every node of this package.

    The exit status is 0 after SIGINT, SIGTERM or SIGHUP, and 1 when the node could not start.
    """
    stop = Stop()
    try:
        check_arguments(sys.argv)
        begin_context(args=sys.argv)
        _run(LiveNode(kind), lambda: stop.requested)
    except UNUSABLE as error:
        print(f'error: {_line(error)}', file=sys.stderr)  # noqa: T201 - there may be no node to log
        sys.exit(1)
    finally:
        rclpy.try_shutdown()
        end_no_more()


def _run(node: LiveNode[Any], until: Callable[[], bool]) -> None:
    autostart, executor = declare(node)
    name = node.get_fully_qualified_name()
    for text in overruled(sys.argv, name):
        raise ConfigurationError(text)
    for text in passed_over(sys.argv, name):
        node.port.refuse(text)
    if autostart:
        start(node, until)
    spin([node], until, executor)


def declare(node: LiveNode[Any]) -> tuple[bool, str]:
    """Declare how a node is run, which counts at its start alone; return `autostart`, `executor`.

    Raises:
        ConfigurationError: There is no such executor.

    """
    autostart = node.declare_parameter(
        'autostart', True,  # noqa: FBT003 - its default
        ParameterDescriptor(description='configure and activate by itself', read_only=True),
    )  # fmt: skip
    executor = node.declare_parameter(
        'executor', 'events',
        ParameterDescriptor(
            description='what runs its callbacks', read_only=True,
            additional_constraints=f'one of {", ".join(EXECUTORS)}',
        ),
    )  # fmt: skip
    if executor.value not in EXECUTORS:
        msg = f"executor = '{executor.value}': choose one of {', '.join(EXECUTORS)}"
        raise ConfigurationError(msg)
    return bool(autostart.value), str(executor.value)


def _line(error: Exception) -> str:
    """Return an error in one line, without where in rcl's C code it was found."""
    text = ' '.join(str(error).split())
    if found := OUT_OF_RANGE.search(text):
        name, lowest, highest, value = found.groups()
        return f'{name} = {value}: must lie in [{lowest}, {highest}]'
    return text.partition(', at /')[0]


def overrides(**values: Any) -> list[Parameter]:
    """Return parameter overrides as a YAML file would give them, for nodes made in a program."""
    return [Parameter(name.replace('__', '.'), value=value) for name, value in values.items()]
