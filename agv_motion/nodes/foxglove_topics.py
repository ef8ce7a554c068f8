"""Which topics of a graph the endpoint `/foxglove` serves, and why it does not serve others."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from agv_motion.bag.cdr.definitions import installed
from agv_motion.dashboard.foxglove.channels import GraphTopic
from agv_motion.errors import ConfigurationError
from agv_motion.ros.channel_subscription import terms
from agv_motion.ros.endpoints import message_class

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from rclpy.node import Node

    from agv_motion.dashboard.foxglove.transforms import DerivedTransforms

IN_TURN = 5
"""topics of each look that are asked for though the number of their publishers is the same"""


class ServedTopics:
    """Looked for in the thread of the node; what was found is another object when it changes."""

    def __init__(self, node: Node, transforms: DerivedTransforms) -> None:
        """Know of none yet.

        Args:
            node: Asks the graph.
            transforms: Offers `/tf` where nobody else does.

        """
        self._node, self._transforms = node, transforms
        self.found: Mapping[str, GraphTopic] = {}
        self.derived: Mapping[str, GraphTopic] = {}
        """of those found the ones that are made here"""
        self.complaints: Mapping[str, str] = {}
        self._publishers: dict[str, list[Any]] = {}
        self._turn = 0

    def look(self, names: Sequence[tuple[str, list[str]]]) -> None:
        """Look which of some topics can be served.

        Args:
            names: Topics of the graph, each with its types.

        """
        found: dict[str, GraphTopic] = {}
        complaints: dict[str, str] = {}
        self._turn = (self._turn + IN_TURN) % max(len(names), 1)
        for place, (name, types) in enumerate(names):
            in_turn = (place - self._turn) % len(names) < IN_TURN
            publishers = self._asked(name, again=in_turn)
            if not publishers:
                continue
            try:
                found[name] = _topic(name, types, publishers)
            except ConfigurationError as error:
                complaints[name] = str(error)
        self.derived = self._transforms.offered(found)
        found |= self.derived
        if found != self.found:
            self.found = found
        if complaints != self.complaints:
            self.complaints = complaints

    def publishers(self, name: str) -> list[Any]:
        """Return who publishes a topic that was found, in its type."""
        kind = self.found[name].type
        return [one for one in self._publishers[name] if one.topic_type == kind]

    def _asked(self, name: str, *, again: bool) -> list[Any]:
        """Return who publishes a topic; asked for where their number has changed, or ``again``."""
        count, known = self._node.count_publishers(name), self._publishers.get(name, [])
        if count != len(known) or (again and count):
            known = self._publishers[name] = self._node.get_publishers_info_by_topic(name)
        return known


def _topic(name: str, types: list[str], publishers: list[Any]) -> GraphTopic:
    """Return what clients are told of a topic.

    Raises:
        ConfigurationError: It has several types, or one that is not installed.

    """
    if len(types) != 1:
        msg = f'it has the types {", ".join(sorted(types))}: only one can be served'
        raise ConfigurationError(msg)
    (kind,) = types
    message_class(kind)
    slots, latched = terms(publishers)
    return GraphTopic(name, kind, installed(kind).text, slots, latched)
