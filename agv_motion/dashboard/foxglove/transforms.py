"""`/tf` and `/tf_static` of a graph or a bag without them: tf2_msgs is not installed everywhere."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.bag.cdr.definitions import installed
from agv_motion.dashboard.foxglove.channels import GraphTopic
from agv_motion.errors import ConfigurationError
from agv_motion.model.graph_transforms import GraphTransforms
from agv_motion.model.transform_message import TF, TF_STATIC, TYPE

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from collections.abc import Set as AbstractSet

HOLD = 3.0
"""[s] for which a live robot's last pose counts"""


class DerivedTransforms:
    """Offers the two topics where nobody else does, and makes their messages from others."""

    def __init__(self, hold: float) -> None:
        """Derive nothing yet.

        Args:
            hold: How long the place of `odom` in the map counts after a pose [s].

        """
        self._hold = hold
        self._transforms = GraphTransforms(hold)
        self._sources: frozenset[str] = frozenset()

    def offered(self, topics: Mapping[str, GraphTopic]) -> dict[str, GraphTopic]:
        """Return the topics that are made here, of those of a graph; none where it has them."""
        wants = self._transforms.wants
        sources = frozenset(name for name, one in topics.items() if wants(name, one.type))
        if topics.keys() & {TF, TF_STATIC} or not sources:
            self._sources = frozenset()
            return {}
        try:
            definition = installed(TYPE).text
        except ConfigurationError:
            return {}  # geometry_msgs is not installed either
        self._sources = sources
        for name in sources:
            self._transforms.expect(name)
        return {
            TF: GraphTopic(TF, TYPE, definition, len(sources)),
            TF_STATIC: GraphTopic(TF_STATIC, TYPE, definition, latched=True),
        }

    def needed(self, chosen: AbstractSet[str]) -> frozenset[str]:
        """Return the topics from which the chosen ones of ours are made."""
        return self._sources if chosen & {TF, TF_STATIC} else frozenset()

    def passed(
        self, messages: Iterable[tuple[str, int, bytes]], chosen: AbstractSet[str]
    ) -> Iterator[tuple[str, int, bytes]]:
        """Yield what was chosen of some messages, and what follows from them.

        Args:
            messages: Topic, time [ns] and data of each, those that are `needed` among them.
            chosen: Topics that are yielded.

        """
        sources = self.needed(chosen)
        last, is_chosen, is_source = '', False, False
        for message in messages:
            topic, stamp, data = message
            if topic != last:  # they come topic by topic
                last, is_chosen, is_source = topic, topic in chosen, topic in sources
            if is_chosen:
                yield message
            if is_source:
                for name, made in self._transforms.take(topic, data):
                    if name in chosen:
                        yield name, stamp, made

    def forget(self) -> None:
        """Begin anew, where time has leapt."""
        self._transforms = GraphTransforms(self._hold)
