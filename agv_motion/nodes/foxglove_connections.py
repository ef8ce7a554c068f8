"""Which nodes of a graph speak on a topic, listen to it, or offer a service."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.node import NodeNameNonExistentError

from agv_motion.dashboard.foxglove.protocol import ConnectionGraph
from agv_motion.ros.graph_ends import NAMELESS, full_name

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rclpy.node import Node
    from rclpy.topic_endpoint_info import TopicEndpointInfo


def connections(node: Node, names: Iterable[tuple[str, Any]]) -> ConnectionGraph:
    """Return who speaks with whom; tools' hidden nodes and what has no name yet are left out.

    Args:
        node: Asks the graph.
        names: Of topics, each with its types.

    """
    published: dict[str, tuple[str, ...]] = {}
    subscribed: dict[str, tuple[str, ...]] = {}
    services: dict[str, tuple[str, ...]] = {}
    for topic, _ in names:
        if speakers := _nodes(node.get_publishers_info_by_topic(topic)):
            published[topic] = speakers
        if listeners := _nodes(node.get_subscriptions_info_by_topic(topic)):
            subscribed[topic] = listeners
    for name, namespace in sorted(set(node.get_node_names_and_namespaces())):
        if name.startswith('_'):
            continue
        try:
            offered = node.get_service_names_and_types_by_node(name, namespace)
        except NodeNameNonExistentError:  # it has left meanwhile
            continue
        for service, _ in offered:
            place = f'{namespace.rstrip("/")}/{name}'
            services[service] = (*services.get(service, ()), place)
    return ConnectionGraph(published, subscribed, services)


def _nodes(ends: Iterable[TopicEndpointInfo]) -> tuple[str, ...]:
    found = {
        full_name(end) for end in ends
        if end.node_name != NAMELESS and not end.node_name.startswith('_')
    }  # fmt: skip
    return tuple(sorted(found))
