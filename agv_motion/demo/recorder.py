"""A node that keeps every message of the demo, as bytes: for the bag, the view and the summary."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.lifecycle import LifecycleNode
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message

from agv_motion.bag.recording.recorded_transforms import RecordedTransforms
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import SourceError
from agv_motion.ros.endpoints import offer, offered
from agv_motion.ros.messages import type_name
from agv_motion.ros.qos import LATCHED

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from pathlib import Path

    from agv_motion.bag.quality_of_service import OfferedQos

EVERY = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)


class RecordedTopic(NamedTuple):
    """A topic worth keeping."""

    name: str
    kind: Any
    latched: bool = False

    @property
    def full_name(self) -> str:
        """Its name on the graph."""
        return f'/{self.name.lstrip("/")}'


class _Bag:
    """The bag of a demo: each topic is in it from its first message on."""

    def __init__(self, path: Path, offers: Callable[[RecordedTopic], list[OfferedQos]]) -> None:
        """Create it; ``offers`` tells the quality of service of who publishes a topic by now."""
        self.failure = ''
        """why it takes no more, so that the demo is to end; empty while it does"""
        self._writer, self._offers = BagWriter(path), offers
        add = self._writer.add_topic
        self._transforms = RecordedTransforms(lambda name, kind, qos: add(name, kind, qos=qos))
        self._handles: dict[str, int] = {}

    def moves(self, topic: RecordedTopic) -> bool:
        """Return whether transforms are made of a topic: the bag hears none that are published."""
        return self._transforms.wants(topic.full_name, type_name(topic.kind))

    def write(self, topic: RecordedTopic, stamp: int, data: bytes, *, moves: bool) -> None:
        """Write a message [ns], and the transforms that come of one that ``moves`` something."""
        if self.failure:
            return
        write = self._writer.write
        try:
            write(self._handles.get(topic.name) or self._add(topic), stamp, data)
            for handle, told in self._transforms.take(topic.full_name, data) if moves else ():
                write(handle, stamp, told)
        except OSError as error:
            self._fail(error)

    def close(self, topics: Iterable[RecordedTopic], stamp: int) -> None:
        """Finish it; a topic on which nobody spoke is in it, too."""
        try:
            if not (self._writer.closed or self.failure):
                for topic in topics:
                    if topic.name not in self._handles:
                        self._add(topic)
                for handle, told in self._transforms.last():
                    self._writer.write(handle, stamp, told)
            self._writer.close()
        except OSError as error:
            self._fail(error)

    def _add(self, topic: RecordedTopic) -> int:
        handle = self._writer.add_topic(
            topic.full_name, type_name(topic.kind), qos=self._offers(topic)
        )
        self._handles[topic.name] = handle
        return handle

    def _fail(self, error: OSError) -> None:
        reason = error.strerror or error
        self.failure = f'{self._writer.path} takes no more ({reason}): free the disk, run again'


class DemoRecorder(LifecycleNode):
    """Writes what it hears into a bag, stamped with simulated time."""

    def __init__(
        self, bag: Path, topics: list[RecordedTopic], now: Callable[[], int], **kwargs: Any
    ) -> None:
        """Subscribe to all topics.

        Args:
            bag: Folder of the new bag.
            topics: What to keep.
            now: Simulated time [ns].
            **kwargs: For rclpy.

        """
        super().__init__('demo_recorder', **kwargs)
        self._bag = _Bag(bag, self._offers)
        self._now = now
        self._latest: dict[str, bytes] = {}
        self._topics = {topic.name: topic for topic in topics}
        self.arrivals: dict[str, list[int]] = {topic.name: [] for topic in topics}
        for topic in topics:
            self._subscribe(topic)

    @property
    def failure(self) -> str:
        """Why the bag takes no more, so that the demo is to end; empty while it does."""
        return self._bag.failure

    @property
    def counts(self) -> dict[str, int]:
        """Number of messages of each topic so far."""
        return {topic: len(arrived) for topic, arrived in self.arrivals.items()}

    def _subscribe(self, topic: RecordedTopic) -> None:
        write, moves, latest = self._bag.write, self._bag.moves(topic), self._latest
        arrived, now, key = self.arrivals[topic.name], self._now, topic.name

        def keep(data: bytes) -> None:
            arrived.append(time.perf_counter_ns())
            latest[key] = data
            write(topic, now(), data, moves=moves)

        self.create_subscription(
            topic.kind, topic.name, keep, LATCHED if topic.latched else EVERY, raw=True,
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )  # fmt: skip

    def _offers(self, topic: RecordedTopic) -> list[OfferedQos]:
        """Return the quality of service of who publishes a topic by now, or a likely one."""
        offers = offered(self.get_publishers_info_by_topic(topic.full_name))
        return offers or [offer(LATCHED if topic.latched else EVERY)]

    def latest(self, topic: str) -> Any | None:
        """Return the last message of a topic, None before the first."""
        data = self._latest.get(topic)
        return None if data is None else deserialize_message(data, self._topics[topic].kind)

    def close(self) -> None:
        """Finish the bag; a topic on which nobody spoke is in it, too.

        Raises:
            SourceError: The disk did not take everything; what it took is a whole bag.

        """
        self._bag.close(self._topics.values(), self._now())
        if self.failure:
            raise SourceError(self.failure)
