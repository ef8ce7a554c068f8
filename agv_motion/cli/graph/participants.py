"""Whether all on this machine have been heard: DDS participants hold ports that can be counted.

A participant takes the ports ``7400 + 250 domain + 10 + 2 i`` and the next one up, with the first
``i`` that is free on its machine (DDSI-RTPS 2.5, section 9.6.2). So the kernel's table of sockets
says how many there are before any of them has been heard.
"""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Any

PORT_BASE, DOMAIN_GAIN, UNICAST_OFFSET = 7400, 250, 10
TABLES = '/proc/net/udp', '/proc/net/udp6'
PREFIX = 12
"""Bytes of an endpoint's identity that name its participant"""


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


def heard(node: Any) -> int:
    """Return from how many participants a node knows at least one endpoint, its own among them."""
    ends = (
        end
        for topic, _ in node.get_topic_names_and_types()
        for known in (node.get_publishers_info_by_topic, node.get_subscriptions_info_by_topic)
        for end in known(topic)
    )
    return len({bytes(end.endpoint_gid[:PREFIX]) for end in ends})


def missing(node: Any) -> int:
    """Return how many participants on this machine have not been heard yet."""
    return max(on_this_machine(node.context.get_domain_id()) - heard(node), 0)
