"""A node that keeps every message of the demo, as bytes: for the bag, the view and the summary."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.lifecycle import LifecycleNode
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message

from agv_motion.bag.writer import BagWriter
from agv_motion.ros.messages import type_name
from agv_motion.ros.qos import LATCHED

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

EVERY = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)


class Topic(NamedTuple):
    """A topic worth keeping."""

    name: str
    kind: Any
    latched: bool = False


class DemoRecorder(LifecycleNode):
    """Writes what it hears into a bag, stamped with simulated time."""

    def __init__(self, bag: Path, topics: list[Topic], now: Callable[[], float]) -> None:
        """Subscribe to all topics.

        Args:
            bag: Folder of the new bag.
            topics: What to keep.
            now: Simulated time [s].

        """
        super().__init__('demo_recorder')
        self._writer = BagWriter(bag)
        self._now = now
        self._kinds = {topic.name: topic.kind for topic in topics}
        self._latest: dict[str, bytes] = {}
        self.counts = {topic.name: 0 for topic in topics}
        self.arrivals: dict[str, list[int]] = {topic.name: [] for topic in topics}
        for topic in topics:
            self._subscribe(topic)

    def _subscribe(self, topic: Topic) -> None:
        handle = self._writer.add_topic(f'/{topic.name.lstrip("/")}', type_name(topic.kind))
        write, latest, counts = self._writer.write, self._latest, self.counts
        arrived, now, key = self.arrivals[topic.name], self._now, topic.name

        def keep(data: bytes) -> None:
            arrived.append(time.perf_counter_ns())
            latest[key] = data
            counts[key] += 1
            write(handle, int(now() * 1e9), data)

        self.create_subscription(
            topic.kind, topic.name, keep, LATCHED if topic.latched else EVERY, raw=True,
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )  # fmt: skip

    def latest(self, topic: str) -> Any | None:
        """Return the last message of a topic, None before the first."""
        data = self._latest.get(topic)
        return None if data is None else deserialize_message(data, self._kinds[topic])

    def close(self) -> None:
        """Finish the bag."""
        self._writer.close()
