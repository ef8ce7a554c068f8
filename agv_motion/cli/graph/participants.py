"""Whether all on this machine have been heard: DDS participants hold ports that can be counted.

A participant takes the ports ``7400 + 250 domain + 10 + 2 i`` and the next one up, with the first
``i`` that is free on its machine (DDSI-RTPS 2.5, section 9.6.2). So the kernel's table of sockets
says how many there are before any of them has been heard.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeAlias

PORT_BASE, DOMAIN_GAIN, UNICAST_OFFSET = 7400, 250, 10
TABLES = '/proc/net/udp', '/proc/net/udp6'
PREFIX = 12
"""Bytes of an endpoint's identity that name its participant"""

GRAPH_TOPIC = 'ros_discovery_info'
"""Of every participant of ROS 2: which ends belong to which of its nodes"""

Ends: TypeAlias = frozenset[tuple[str, bytes, bool, str]]
"""Of each the topic of DDS, the identity, whether it writes, and the name of its node"""


def on_this_machine(domain: int) -> int:
    """Return how many participants of a domain hold a port here; 0 without a table of ports."""
    first = PORT_BASE + DOMAIN_GAIN * domain + UNICAST_OFFSET
    ports = {
        port
        for table in TABLES
        for port in _ports(Path(table))
        if first <= port < first + DOMAIN_GAIN - UNICAST_OFFSET and not (port - first) % 2
    }
    return len(ports)


def _ports(table: Path) -> list[int]:
    with suppress(OSError):
        rows = table.read_text(encoding='ascii').splitlines()[1:]
        return [int(row.split()[1].rpartition(':')[2], 16) for row in rows]
    return []


def are_all_on_this_machine(domain: int) -> bool:
    """Return whether whoever can be heard holds a port here, so that all can be counted."""
    narrow = os.environ.get('ROS_AUTOMATIC_DISCOVERY_RANGE', '').upper() in {'LOCALHOST', 'OFF'}
    return narrow and not os.environ.get('ROS_STATIC_PEERS') and bool(on_this_machine(domain))


def ends_of(node: Any) -> Ends:
    """Return all ends that a node knows.

    The graph's topic is looked at last: each participant has opened it first, and whoever comes
    meanwhile would seem not to have it.
    """
    names = [name for name, _ in node.get_topic_names_and_types(no_demangle=True)]
    return frozenset(
        (topic, bytes(end.endpoint_gid), writes, end.node_name)
        for topic in [*(name for name in names if name != GRAPH_TOPIC), GRAPH_TOPIC]
        for writes, ends in (
            (True, node.get_publishers_info_by_topic(topic, no_mangle=True)),
            (False, node.get_subscriptions_info_by_topic(topic, no_mangle=True)),
        )
        for end in ends
    )


def heard(ends: Ends) -> int:
    """Return of how many participants anything is known."""
    return len({identity[:PREFIX] for _, identity, *_ in ends})


def missing(node: Any, ends: Ends | None = None) -> int:
    """Return how many participants on this machine have not been heard yet."""
    known = heard(ends_of(node) if ends is None else ends)
    return max(on_this_machine(node.context.get_domain_id()) - known, 0)
