"""The topics that clients may choose, and the newest messages of each: slots, never a queue.

A topic has a slot for each of its publishers, so that none of several who share one (`/tf`,
`/rosout`, latched descriptions) hides another; one that is latched has as many as its publishers
keep. What came since the last look goes to clients that keep up, whole; one that does not keep up
gets, when it can take something again, what is in the slots.
"""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.dashboard.foxglove.protocol import CDR, DEFINITION, ChannelInfo

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

MOST_SLOTS = 100
"""of one topic"""


class GraphTopic(NamedTuple):
    """A topic as its source tells of it."""

    name: str
    type: str
    definition: str
    slots: int = 1
    """messages of it that are worth keeping"""
    latched: bool = False
    """whether who comes late gets what was said before"""
    definition_encoding: str = DEFINITION


class Said(NamedTuple):
    """One message."""

    number: int
    """counts all messages of all topics"""
    stamp: int
    """when it was received [ns]"""
    data: bytes


class LiveChannel:
    """One topic of one type."""

    def __init__(self, info: ChannelInfo) -> None:
        """Start with nothing said."""
        self.info = info
        self.latched = False
        self.slots: deque[Said] = deque(maxlen=1)
        """the newest, oldest first"""
        self.fresh: list[Said] = []
        """what came at the last look"""

    def fit(self, topic: GraphTopic) -> None:
        """Have as many slots as a topic needs now."""
        self.latched = topic.latched
        slots = min(max(topic.slots, 1), MOST_SLOTS)
        if self.slots.maxlen != slots:
            self.slots = deque(self.slots, maxlen=slots)

    def forget(self) -> None:
        """Keep nothing: nobody listens any more, and what is kept grows old unseen."""
        self.slots.clear()
        self.fresh = []


class Channels:
    """All channels by their number; the same topic of the same type always has the same number."""

    def __init__(self) -> None:
        """Know no topic."""
        self.by_number: dict[int, LiveChannel] = {}
        """those that are there"""
        self.by_topic: dict[str, LiveChannel] = {}
        self.count = 0
        """of all messages so far"""
        self._known: dict[GraphTopic, LiveChannel] = {}
        self._fresh: list[LiveChannel] = []

    def update(self, topics: Mapping[str, GraphTopic]) -> tuple[list[LiveChannel], list[int]]:
        """Take which topics there are now; return new channels, and the numbers of those gone."""
        new, there = [], {}
        for topic in topics.values():
            channel = self._channel(topic)
            channel.fit(topic)
            there[channel.info.id] = channel
            if channel.info.id not in self.by_number:
                new.append(channel)
        gone = [number for number in self.by_number if number not in there]
        for number in gone:
            self.by_number[number].forget()
        self.by_number = there
        self.by_topic = {channel.info.topic: channel for channel in there.values()}
        return new, gone

    def take(self, messages: Iterable[tuple[str, int, bytes]]) -> list[LiveChannel]:
        """Take what came since the last look; return the channels that have news.

        Args:
            messages: GraphTopic, time [ns] and data of each.

        """
        for known in self._fresh:
            known.fresh = []
        fresh, by_topic, count, last = [], self.by_topic, self.count, ''
        channel: LiveChannel | None = None
        for topic, stamp, data in messages:
            if topic != last:  # they come topic by topic
                last, channel = topic, by_topic.get(topic)
                if channel is not None and not channel.fresh:
                    fresh.append(channel)
            if channel is None:
                continue  # it is gone just now
            count += 1
            one = Said(count, stamp, data)
            channel.fresh.append(one)
            channel.slots.append(one)
        self.count, self._fresh = count, fresh
        return fresh

    def _channel(self, topic: GraphTopic) -> LiveChannel:
        key = topic._replace(slots=1, latched=False)
        if key not in self._known:
            info = ChannelInfo(
                len(self._known) + 1, topic.name, topic.type, topic.definition, CDR,
                topic.definition_encoding,
            )  # fmt: skip
            self._known[key] = LiveChannel(info)
        return self._known[key]
