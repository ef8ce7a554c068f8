"""Join the ROS graph for a moment: look, listen, send. Imports rclpy only when it is used."""

from __future__ import annotations

import importlib
import os
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import typer

from agv_motion.cli.graph.participants import missing, on_this_machine
from agv_motion.errors import ConfigurationError
from agv_motion.ros.parameter_arguments import meant

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

DISCOVERY = 0.5
"""[s] How long to listen to the graph before telling what is there, as `ros2` does."""

SETTLED, LONGEST = 0.4, 10.0
"""[s] ... and on until nothing new has come for so long, but no longer than this in all."""

ALONE = 4.0
"""[s] Another machine may be there of which nothing was heard: a lost announcement comes again
after three seconds."""

PATIENCE = 5.0
"""[s] That a topic which was named is waited for, where another machine may have it."""


def forever() -> bool:
    """Never end; the default of :func:`spin`."""
    return False


@contextmanager
def joined(
    spin_time: float = DISCOVERY,
    *,
    use_sim_time: bool = False,
    name: str = '',
    whole: bool = False,
    endless: bool = False,
) -> Iterator[Any]:
    """Yield a hidden node that has listened to the graph for ``spin_time`` [s].

    Args:
        spin_time: How long to listen at least [s].
        use_sim_time: Whether the node's clock is `/clock`.
        name: Of the node; empty: a hidden one.
        whole: Whether an answer that lacks a part of the graph is a failure (exit status 1).
        endless: Whether a signal is the usual end of the command (exit status 0), not a failure.

    """
    import rclpy
    from rclpy.parameter import Parameter
    from rclpy.signals import SignalHandlerOptions

    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node(
        name or f'_agv_{os.getpid()}',
        start_parameter_services=False,
        parameter_overrides=[Parameter('use_sim_time', value=use_sim_time)],
    )
    try:
        if spin_time > 0.0:
            _listen(node, spin_time)
        yield node
        if whole and missing(node):
            typer.echo(
                f'warning: {missing(node)} of the DDS participants on this machine were not heard '
                'in time, so something may be missing above: try again with --spin-time 10',
                err=True,
            )
            raise typer.Exit(1)
    except KeyboardInterrupt:
        if not endless:
            raise
        raise typer.Exit from None
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _listen(node: Any, spin_time: float) -> None:
    """Spin for ``spin_time`` [s], then until all have been heard and nothing new comes."""
    start = changed = time.monotonic()
    known: tuple[int, int] = (0, 0)

    def settled() -> bool:
        nonlocal known, changed
        now = time.monotonic()
        found = len(node.get_node_names()), len(node.get_topic_names_and_types())
        if found != known:
            known, changed = found, now
        if now - start < spin_time or now - changed < SETTLED:
            return now - start >= max(LONGEST, spin_time)
        if _heard_all(node):
            return True
        limit = LONGEST if missing(node) else ALONE
        return now - start >= max(limit, spin_time)

    spin(node, settled)


def _heard_all(node: Any) -> bool:
    """Return whether nobody can be there of whom nothing is known."""
    local = os.environ.get('ROS_AUTOMATIC_DISCOVERY_RANGE', '').upper() == 'LOCALHOST'
    others = [one for one in node.get_node_names_and_namespaces() if one[0] != node.get_name()]
    if missing(node) or not (others or (local and on_this_machine(node.context.get_domain_id()))):
        return False
    return _complete(node, others)


def _complete(node: Any, others: list[tuple[str, str]]) -> bool:
    """Return whether something of each of the other nodes is known."""
    from rclpy.node import NodeNameNonExistentError

    try:
        return all(node.get_publisher_names_and_types_by_node(*other) for other in others)
    except NodeNameNonExistentError:  # it has left meanwhile
        return False


def spin(node: Any, until: Callable[[], bool] = forever) -> None:
    """Spin ``node`` until ``until()``, or a signal that ends the command."""
    import rclpy

    while not until():
        rclpy.spin_once(node, timeout_sec=0.05)


def topics(node: Any, *, hidden: bool = False) -> dict[str, list[str]]:
    """Return the types of each topic, by name, in order."""
    from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden

    found = node.get_topic_names_and_types()
    return {name: types for name, types in found if hidden or not topic_or_service_is_hidden(name)}


def interface_class(name: str, kind: str = 'msg') -> Any:
    """Return the class of ``package/Name`` or ``package/msg/Name``.

    Raises:
        ConfigurationError: It is not installed; close names are given.

    """
    package, _, short = name.partition('/')
    short = short.rpartition('/')[2]
    try:
        module = importlib.import_module(f'{package}.{kind}')
    except (ModuleNotFoundError, ValueError) as error:
        msg = f"the passed type '{name}' is invalid: package '{package}' has no {kind}"
        raise ConfigurationError(msg) from error
    if not hasattr(module, short) or not short:
        msg = f"the passed type '{name}' is invalid{meant(short, dir(module))}"
        raise ConfigurationError(msg)
    return getattr(module, short)


def full_name(node: Any, topic: str) -> str:
    """Return ``topic`` with its namespace."""
    from rclpy.expand_topic_name import expand_topic_name

    try:
        return str(expand_topic_name(topic, node.get_name(), node.get_namespace()))
    except ValueError as error:
        raise ConfigurationError(str(error)) from error


def topic_class(node: Any, topic: str, *, wait: bool = False) -> Any:
    """Return the message class of a topic on the graph.

    Raises:
        ConfigurationError: The topic is not there (and ``wait`` is false), or has two types.

    """
    name, warned = full_name(node, topic), False
    _await(node, name)
    while name not in topics(node, hidden=True):
        typer.echo(f'WARNING: topic [{topic}] does not appear to be published yet')
        if not wait or warned:
            msg = f'Could not determine the type for the passed topic{_near(node, name)}'
            raise ConfigurationError(msg)
        warned = True
        spin(node, lambda: name in topics(node, hidden=True))
    types = topics(node, hidden=True)[name]
    if len(types) > 1:
        msg = f"topic '{topic}' has more than one type: [{', '.join(types)}]; name one"
        raise ConfigurationError(msg)
    return interface_class(types[0])


def require_topic(node: Any, topic: str) -> list[str]:
    """Return the types of a topic that must be there.

    Raises:
        ConfigurationError: It is not.

    """
    _await(node, full_name(node, topic))
    types = topics(node, hidden=True).get(full_name(node, topic))
    if types is None:
        msg = f"Unknown topic '{topic}'{_near(node, topic)}"
        raise ConfigurationError(msg)
    return types


def _await(node: Any, name: str) -> None:
    """Give a topic that was named the time to be found, where somebody may not have been heard."""
    end = time.monotonic() + (0.0 if _heard_all(node) else PATIENCE)
    spin(node, lambda: name in topics(node, hidden=True) or time.monotonic() > end)


def _near(node: Any, name: str) -> str:
    return meant(name, list(topics(node, hidden=True)))
