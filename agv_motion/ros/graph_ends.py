"""Ends of topics on the graph: a node's own, and how to name those of others."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rclpy.node import NodeNameNonExistentError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rclpy.node import Node
    from rclpy.qos import QoSProfile
    from rclpy.topic_endpoint_info import TopicEndpointInfo

NAMELESS = '_NODE_NAME_UNKNOWN_'
"""What the middleware calls a node that it has not discovered yet."""
MOST_NAMES = 5
"""Nodes that are named in one message."""


@dataclass(frozen=True, eq=False)
class OwnEnd:
    """One end of a topic that a node has made itself."""

    topic: str
    """As it was made: relative, before remapping."""
    kind: str
    """Such as std_msgs/msg/String."""
    qos: QoSProfile
    publishes: bool
    sole: bool
    """Whether no other node may publish here; of an input, whether it is told if several do."""


def full_name(end: TopicEndpointInfo) -> str:
    """Return the node's name with its namespace."""
    return f'{end.node_namespace.rstrip("/")}/{end.node_name}'


def names(ends: Sequence[TopicEndpointInfo]) -> str:
    """Name the nodes; several of one name are told apart by the numbers of their ends."""
    count = Counter(map(full_name, ends))
    told = [
        'a node without a name'
        if end.node_name == NAMELESS
        else full_name(end)
        if count[full_name(end)] == 1
        else f'{full_name(end)} (GID {".".join(f"{byte:02x}" for byte in end.endpoint_gid)})'
        for end in ends
    ]
    more = f' and {len(told) - MOST_NAMES} more' if len(told) > MOST_NAMES else ''
    return ', '.join(told[:MOST_NAMES]) + more


def is_tool(node: Node, end: TopicEndpointInfo) -> bool:
    """Return whether a person's tool is meant: a hidden node, or one that plays a bag.

    By the convention of ROS, commands such as ``ros2 topic pub`` join under a name that begins
    with an underscore; a player is known by its services, whatever its name.
    """
    if end.node_name == NAMELESS:
        return False
    if end.node_name.startswith('_'):
        return True
    try:
        services = node.get_service_names_and_types_by_node(end.node_name, end.node_namespace)
    except NodeNameNonExistentError:  # it has left meanwhile
        return False
    return f'{full_name(end)}/play_next' in {name for name, _ in services}
