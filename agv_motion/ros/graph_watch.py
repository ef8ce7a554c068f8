"""Who else is on a node's topics: rivals that publish what only it may, and ends that never meet.

The graph is asked now and then; the middleware's own events for this crash in rclpy 7.1 when a
publisher or a subscription is destroyed. A question by topic costs 0.1 to 0.2 ms, a count of its
ends 7 us: so ends are counted, and asked for where their number has changed or it is their turn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.ros.graph_ends import OwnEnd, is_tool, names
from agv_motion.ros.mismatch import mismatches

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rclpy.node import Node
    from rclpy.qos import QoSProfile
    from rclpy.topic_endpoint_info import TopicEndpointInfo

GRAPH_PERIOD = 0.4
"""[s] Two looks must agree on a rival; so it is told within 0.8 s of its discovery."""
MOST_TOPICS = 3
"""Topics that are named in one list."""
IN_TURN = 2
"""Topics of each look that are asked for though no number has changed."""


class Found(NamedTuple):
    """What the graph tells about one topic of the node."""

    rivals: str = ''
    """Who publishes together what one node may alone; empty if it does."""
    faults: tuple[str, ...] = ()
    """What keeps ends from meeting, or is not as it should be, and what to do."""
    crowd: str = ''
    """Which nodes publish an input together; empty if one or none."""


class GraphWatch:
    """Looks at the topics of one node."""

    def __init__(self, node: Node) -> None:
        """Know of no topic yet."""
        self.needed: list[str] = []
        """Topics without which the node can do nothing"""
        self._node = node
        self._ends: list[OwnEnd] = []
        self._counts: dict[OwnEnd, tuple[int, int]] = {}
        self._found: dict[OwnEnd, Found] = {}
        self._turn = 0
        self._suspected = False

    def add(
        self, kind: type[Any], topic: str, qos: QoSProfile, *, publishes: bool, sole: bool
    ) -> None:
        """Look at a topic from now on."""
        name = f'{kind.__module__.split(".")[0]}/msg/{kind.__name__}'
        self._ends.append(OwnEnd(topic, name, qos, publishes, sole))

    def clear(self) -> None:
        """Look at nothing any more."""
        self.needed.clear()
        self._ends.clear()
        self._counts.clear()
        self._found.clear()
        self._suspected = False

    def look(self) -> str:
        """Ask the graph; return who was found, twice in a row, to publish what one node may."""
        due = [end for end in self._ends if self._has_changed(end)]
        for _ in range(min(IN_TURN, len(self._ends))):
            self._turn = (self._turn + 1) % len(self._ends)
            due.append(self._ends[self._turn])
        for end in due:
            self._found[end] = self._examine(end)
        rivals = '; '.join(found.rivals for found in self._found.values() if found.rivals)
        before, self._suspected = self._suspected, bool(rivals)
        return rivals if before else ''

    def faults(self) -> tuple[str, ...]:
        """Return what kept ends from meeting at the last look, and what to do."""
        return tuple(fault for found in self._found.values() for fault in found.faults)

    def crowds(self) -> dict[str, str]:
        """Return which nodes published an input together at the last look, by topic."""
        return {end.topic: found.crowd for end, found in self._found.items() if found.crowd}

    def missing(self) -> str:
        """Return which inputs that the node needs nobody publishes; empty if none."""
        return self._listed([one for one in self.needed if not self._publishers(one)])

    def introduction(self) -> str:
        """Return in a short line what the node needs, and what it makes of it."""
        needed = self._listed(self.needed)
        own = [end for end in self._ends if end.publishes]
        drives = [end for end in own if end.topic == 'cmd_vel']
        made = self._listed([e.topic for e in drives or [e for e in own if e.sole] or own])
        ends = f'{needed} -> {made}' if needed and made else needed or made
        return f'active: {ends}' if ends else 'active'

    def _listed(self, topics: Sequence[str]) -> str:
        """Return names of topics, those in the node's own namespace as short as they are there."""
        space = f'{self._node.get_namespace().rstrip("/")}/'
        full = [self._node.resolve_topic_name(topic) for topic in dict.fromkeys(topics)]
        shown = [name.removeprefix(space) for name in full[:MOST_TOPICS]]
        more = f' and {len(full) - MOST_TOPICS} more' if len(full) > MOST_TOPICS else ''
        return ', '.join(shown) + more

    def _publishers(self, topic: str) -> int:
        """Return how many publish a topic, which may be remapped: rclpy counts by full names."""
        return int(self._node.count_publishers(self._node.resolve_topic_name(topic)))

    def _has_changed(self, end: OwnEnd) -> bool:
        """Return whether other ends have come or gone; always so while there are rivals."""
        full = self._node.resolve_topic_name(end.topic)
        listeners = self._node.count_subscribers(full) if end.publishes else 0
        counts = self._publishers(end.topic), listeners
        changed = self._counts.get(end) != counts
        self._counts[end] = counts
        return changed or bool(self._found[end].rivals)

    def _examine(self, end: OwnEnd) -> Found:
        node, topic = self._node, self._node.resolve_topic_name(end.topic)
        several = end.sole and self._counts[end][0] > 1
        if not end.publishes:
            publishers = node.get_publishers_info_by_topic(end.topic)
            crowd = names(publishers) if several else ''
            return Found('', tuple(mismatches(end, topic, publishers)), crowd)
        listeners = node.get_subscriptions_info_by_topic(end.topic)
        faults = tuple(mismatches(end, topic, listeners))
        if not several:
            return Found('', faults)
        publishers = node.get_publishers_info_by_topic(end.topic)
        told = f'{names(publishers)} all publish {topic}, which one node may alone'
        if self._has_rival(publishers):
            return Found(told, faults)
        return Found('', (*faults, told) if len(publishers) > 1 else faults)

    def _has_rival(self, publishers: Sequence[TopicEndpointInfo]) -> bool:
        """Return whether more than one publisher is no tool: the node itself is one."""
        return sum(not is_tool(self._node, one) for one in publishers) > 1
