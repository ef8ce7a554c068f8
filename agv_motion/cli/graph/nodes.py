"""The nodes of the ROS graph by their full names, and one of them."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from agv_motion.cli.graph.discovery import DISCOVERY, settle
from agv_motion.cli.graph.session import joined
from agv_motion.errors import ConfigurationError
from agv_motion.ros.suggestion import meant

if TYPE_CHECKING:
    from collections.abc import Iterator


def absolute(name: str) -> str:
    """Return the full name of a node that is given without its first slash."""
    return name if name.startswith('/') else f'/{name}'


def node_names(node: Any, *, hidden: bool = False) -> list[str]:
    """Return the full names of all nodes, in order; two of one name are there twice."""
    return sorted(
        f'{namespace.rstrip("/")}/{name}'
        for name, namespace in node.get_node_names_and_namespaces()
        if name and (hidden or not name.startswith('_'))
    )


def lifecycle_nodes(node: Any, *, hidden: bool = False) -> list[str]:
    """Return the full names of the nodes that have a lifecycle, in order."""
    services = dict(node.get_service_names_and_types())
    kind = 'lifecycle_msgs/srv/GetState'
    names = dict.fromkeys(node_names(node, hidden=hidden))
    return [name for name in names if kind in services.get(f'{name}/get_state', ())]


@contextmanager
def joined_to(
    name: str, spin_time: float = DISCOVERY, *, hidden: bool = False, lifecycle: bool = False
) -> Iterator[tuple[Any, str]]:
    """Join the graph until a node is found; yield a node of ours, and the other's full name.

    Args:
        name: Of the other; the first slash may be left out.
        spin_time: How long to look for it at least [s].
        hidden: Whether nodes are looked at whose names begin with an underscore.
        lifecycle: Whether only nodes with a lifecycle count.

    Raises:
        ConfigurationError: It is not there; close names are given.

    """
    names = lifecycle_nodes if lifecycle else node_names
    full = absolute(name)
    with joined(0.0) as node:
        settle(node, spin_time, lambda: full in names(node, hidden=hidden))
        there = names(node, hidden=hidden)
        if full not in there:
            kind = 'lifecycle node' if lifecycle and full in node_names(node, hidden=hidden) else ''
            msg = f"Node not found: '{full}'" + (f' is no {kind}' if kind else meant(full, there))
            raise ConfigurationError(msg)
        yield node, full
