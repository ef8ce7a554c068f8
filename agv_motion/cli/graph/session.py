"""Join the ROS graph for a moment: look, listen, send. Imports rclpy only when it is used."""

from __future__ import annotations

import faulthandler
import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import typer

from agv_motion.cli.graph.discovery import DISCOVERY, settle
from agv_motion.cli.graph.participants import missing
from agv_motion.errors import ConfigurationError
from agv_motion.ros.suggestion import meant

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

UDP_ALONE = 'FASTDDS_BUILTIN_TRANSPORTS', 'UDPv4'
"""Shared memory that a killed process left behind holds up discovery by a second for each: who
only looks does without"""

LEAVING = 30.0
"""[s] after which a process that cannot leave the graph ends all the same, with status 1, and tells
where it was held up"""


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

    Raises:
        ConfigurationError: ``name`` cannot be that of a node.

    """
    import rclpy
    from rclpy.parameter import Parameter

    from agv_motion.ros.context import begin_context

    if name:
        _require_node_name(name)
    if not endless:
        os.environ.setdefault(*UDP_ALONE)
    begin_context()
    node = rclpy.create_node(
        name or f'_agv_{os.getpid()}',
        start_parameter_services=False,
        parameter_overrides=[
            Parameter('use_sim_time', value=use_sim_time),
            Parameter('start_type_description_service', value=False),  # whose messages want numpy
        ],
    )
    try:
        unheard = settle(node, spin_time) if spin_time > 0.0 else missing(node)
        yield node
        if whole and unheard:
            typer.echo(
                f'warning: {unheard} of the DDS participants on this machine were not heard '
                'in time, so something may be missing above: try again with --spin-time 10',
                err=True,
            )
            raise typer.Exit(1)
    except KeyboardInterrupt:
        if not endless:
            raise
        raise typer.Exit from None
    finally:
        # seen once under load: after Ctrl-C a command stayed for ever, and nothing told where
        faulthandler.dump_traceback_later(LEAVING, exit=True, file=2)
        node.destroy_node()
        rclpy.try_shutdown()
        faulthandler.cancel_dump_traceback_later()


def _require_node_name(name: str) -> None:
    from rclpy.exceptions import NameValidationException
    from rclpy.validate_node_name import validate_node_name

    try:
        validate_node_name(name)
    except NameValidationException as error:
        told, *_ = str(error).splitlines()
        msg = f"{told} '{name}'"
        raise ConfigurationError(msg) from error


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


def services(node: Any, *, hidden: bool = False) -> dict[str, list[str]]:
    """Return the types of each service, by name, in order."""
    from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden

    found = node.get_service_names_and_types()
    return {name: types for name, types in found if hidden or not topic_or_service_is_hidden(name)}


def interface_class(name: str, kind: str = 'msg') -> Any:
    """Return the class of ``package/Name`` or ``package/msg/Name``.

    Raises:
        ConfigurationError: It is not installed; close names are given.

    """
    from agv_motion.ros.endpoints import interface_module

    package, _, short = name.partition('/')
    short = short.rpartition('/')[2]
    try:
        module = interface_module(package, kind)
    except ImportError as error:
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
        raise ConfigurationError(str(error).partition(', at /')[0]) from error


def topic_class(node: Any, topic: str, *, wait: bool = False) -> Any:
    """Return the message class of a topic on the graph.

    Raises:
        ConfigurationError: The topic is not there (and ``wait`` is false), or has two types.

    """
    name, warned = full_name(node, topic), False
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
    types = topics(node, hidden=True).get(full_name(node, topic))
    if types is None:
        msg = f"Unknown topic '{topic}'{_near(node, topic)}"
        raise ConfigurationError(msg)
    return types


def _near(node: Any, name: str) -> str:
    return meant(name, list(topics(node, hidden=True)))
