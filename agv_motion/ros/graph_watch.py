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
MOST_TOPICS = 8
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

    def introduction(self) -> str:
        """Return in one line what the node listens to, what it publishes, and what nobody tells."""
        heard = [end.topic for end in self._ends if not end.publishes]
        told = [end.topic for end in self._ends if end.publishes]
        missing = [topic for topic in heard if not self._node.count_publishers(topic)]
        listens = f'listens to {self._listed(heard)}' if heard else 'listens to nothing'
        publishes = f'publishes {self._listed(told)}' if told else 'publishes nothing'
        without = f'nobody publishes {self._listed(missing)} yet' if missing else 'all are there'
        return f'active: {listens}; {publishes}' + f'; {without}' * bool(heard)

    def _listed(self, topics: Sequence[str]) -> str:
        full = [self._node.resolve_topic_name(topic) for topic in dict.fromkeys(topics)]
        more = f' and {len(full) - MOST_TOPICS} more' if len(full) > MOST_TOPICS else ''
        return ', '.join(full[:MOST_TOPICS]) + more

    def _has_changed(self, end: OwnEnd) -> bool:
        """Return whether other ends have come or gone; always so while there are rivals."""
        counts = (
            self._node.count_publishers(end.topic),
            self._node.count_subscribers(end.topic) if end.publishes else 0,
        )
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
