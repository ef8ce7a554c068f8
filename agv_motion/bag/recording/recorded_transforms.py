"""`/tf` and `/tf_static` in a bag, where nobody publishes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.bag.quality_of_service import OfferedQos
from agv_motion.errors import SourceError
from agv_motion.model.graph_transforms import GraphTransforms
from agv_motion.model.transform_message import TF, TF_STATIC, TYPE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

QOS = {
    TF: [OfferedQos(depth=100)],
    TF_STATIC: [OfferedQos(depth=1, durability='transient_local')],
}
"""As tf2 offers them; what is latched begins each file of a bag."""


class RecordedTransforms:
    """Makes the transforms that follow from what is recorded, and topics of the bag for them."""

    def __init__(self, add_topic: Callable[[str, str, Sequence[OfferedQos]], int]) -> None:
        """Have no topic yet.

        Args:
            add_topic: Returns the handle of a topic of the bag, by its name, type, and quality of
                service.

        """
        self._add_topic = add_topic
        self._handles: dict[str, int] = {}
        self._left: set[str] = set()
        self._transforms = GraphTransforms()

    def leave(self, topic: str) -> int | None:
        """Make a topic no more: it has a publisher, or is not wanted; return its handle if any."""
        self._left.add(topic)
        return self._handles.get(topic)

    def wants(self, topic: str, message_type: str) -> bool:
        """Return whether transforms follow from a topic; one that is recorded, from now on."""
        wanted = self._transforms.wants(topic, message_type)
        if wanted:
            self._transforms.expect(topic)
        return wanted

    def take(self, topic: str, data: bytes) -> list[tuple[int, bytes]]:
        """Return handle and bytes of each message that follows from one on a topic."""
        if len(self._left) == len(QOS):
            return []
        return self._handled(self._transforms.take(topic, data))

    def last(self) -> list[tuple[int, bytes]]:
        """Return what is to be written at the end of the bag."""
        return self._handled(self._transforms.last())

    def _handled(self, told: Iterable[tuple[str, bytes]]) -> list[tuple[int, bytes]]:
        try:
            return [(self._handle(topic), data) for topic, data in told if topic not in self._left]
        except SourceError:  # the disk is full, and the recording has told so
            return []

    def _handle(self, topic: str) -> int:
        if topic not in self._handles:
            self._handles[topic] = self._add_topic(topic, TYPE, QOS[topic])
        return self._handles[topic]
