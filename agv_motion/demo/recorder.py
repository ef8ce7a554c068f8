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
from agv_motion.ros.transforms import PUBLISHED

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

EVERY = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)


class RecordedTopic(NamedTuple):
    """A topic worth keeping."""

    name: str
    kind: Any
    latched: bool = False


class DemoRecorder(LifecycleNode):
    """Writes what it hears into a bag, stamped with simulated time."""

    def __init__(
        self, bag: Path, topics: list[RecordedTopic], now: Callable[[], float], **kwargs: Any
    ) -> None:
        """Subscribe to all topics.

        Args:
            bag: Folder of the new bag.
            topics: What to keep.
            now: Simulated time [s].
            **kwargs: For rclpy.

        """
        super().__init__('demo_recorder', **kwargs)
        self.failure = ''
        """why the bag takes no more, so that the demo is to end; empty while it does"""
        self._writer = BagWriter(bag)
        add = self._writer.add_topic
        self._transforms = RecordedTransforms(lambda name, kind, qos: add(name, kind, qos=qos))
        self._now = now
        self._latest: dict[str, bytes] = {}
        self._topics = {topic.name: topic for topic in topics}
        self._handles: dict[str, int] = {}
        """of the topics in the bag: each is added with its first message"""
        self.arrivals: dict[str, list[int]] = {topic.name: [] for topic in topics}
        for topic in topics:
            self._subscribe(topic)

    @property
    def counts(self) -> dict[str, int]:
        """Number of messages of each topic so far."""
        return {topic: len(arrived) for topic, arrived in self.arrivals.items()}

    def _subscribe(self, topic: RecordedTopic) -> None:
        write, latest = self._writer.write, self._latest
        arrived, now, key = self.arrivals[topic.name], self._now, topic.name
        handles, transforms = self._handles, self._transforms
        name, kind = f'/{topic.name.lstrip("/")}', type_name(topic.kind)
        moves = not PUBLISHED and transforms.wants(name, kind)

        def keep(data: bytes) -> None:
            arrived.append(time.perf_counter_ns())
            latest[key] = data
            if self.failure:
                return
            try:
                handle = handles.get(key) or self._add(topic)
                stamp = int(now() * 1e9)
                write(handle, stamp, data)
                for handle, told in transforms.take(name, data) if moves else ():
                    write(handle, stamp, told)
            except OSError as error:
                self._fail(error)

        self.create_subscription(
            topic.kind, topic.name, keep, LATCHED if topic.latched else EVERY, raw=True,
            event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
        )  # fmt: skip

    def _add(self, topic: RecordedTopic) -> int:
        """Add a topic to the bag, with the quality of service of who publishes it by now."""
        name = f'/{topic.name.lstrip("/")}'
        offers = offered(self.get_publishers_info_by_topic(name))
        qos = offers or [offer(LATCHED if topic.latched else EVERY)]
        self._handles[topic.name] = self._writer.add_topic(name, type_name(topic.kind), qos=qos)
        return self._handles[topic.name]

    def latest(self, topic: str) -> Any | None:
        """Return the last message of a topic, None before the first."""
        data = self._latest.get(topic)
        return None if data is None else deserialize_message(data, self._topics[topic].kind)

    def close(self) -> None:
        """Finish the bag; a topic on which nobody spoke is in it, too.

        Raises:
            SourceError: The disk did not take everything; what it took is a whole bag.

        """
        try:
            for topic in self._topics.values() if not (self._writer.closed or self.failure) else ():
                if topic.name not in self._handles:
                    self._add(topic)
            if not (self._writer.closed or self.failure):
                for handle, told in self._transforms.last():
                    self._writer.write(handle, int(self._now() * 1e9), told)
            self._writer.close()
        except OSError as error:
            self._fail(error)
        if self.failure:
            raise SourceError(self.failure)

    def _fail(self, error: OSError) -> None:
        reason = error.strerror or error
        self.failure = f'{self._writer.path} takes no more ({reason}): free the disk, run again'
