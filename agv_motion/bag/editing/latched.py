"""What latched topics had told before a moment: what a late listener would have received."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING

from agv_motion.bag.last_messages import latest_before
from agv_motion.bag.quality_of_service import kept

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.bag.connection import Connection, Message
    from agv_motion.bag.reader import BagReader
    from agv_motion.bag.selection import Selection

MOST = 100
"""messages of a topic"""
STATIC = 'tf_static'
"""Latched by convention: older bags do not tell of its quality of service."""


def latched_before(
    bags: Iterable[BagReader], topics: Selection, stamp: int, since: int = 0
) -> list[Message]:
    """Return what latched topics had told before a moment, in order and stamped with it.

    Of each topic as many messages as its publishers keep; the times of sending stay.

    Args:
        bags: Open.
        topics: Which topics.
        stamp: The moment [ns].
        since: [ns] what was told before that is known already.

    Raises:
        SourceError: A bag is damaged.

    """
    found: list[Message] = []
    for bag in bags:
        wanted: dict[str, int] = {}
        for connection in bag.connections:
            if topics.takes(connection.topic):
                count = wanted.get(connection.topic, 0) + _kept(connection)
                wanted[connection.topic] = min(count, MOST)
        wanted = {topic: count for topic, count in wanted.items() if count}
        found += (m for m in latest_before(bag, wanted, stamp) if m.stamp >= since)
    return [m._replace(stamp=stamp) for m in sorted(found, key=attrgetter('stamp'))]


def _kept(connection: Connection) -> int:
    static = connection.topic.rpartition('/')[2] == STATIC
    return kept(connection.qos) or (MOST if static else 0)
