"""What of a bag is played: some of its topics, in a span of time."""

from __future__ import annotations

from collections import deque
from fractions import Fraction
from math import inf, nextafter
from typing import TYPE_CHECKING

from agv_motion.bag.quality_of_service import kept
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from agv_motion.bag.connection import Message
    from agv_motion.bag.playback.playback_parameters import PlaybackParameters
    from agv_motion.bag.playback.several_bags import SeveralBags
    from agv_motion.bag.quality_of_service import OfferedQos
    from agv_motion.bag.reader import BagReader

    Played = BagReader | SeveralBags

NO_OFFERS: dict[str, OfferedQos] = {}


class PlaybackExcerpt:
    """Chosen topics of a bag, or of several, between two times."""

    def __init__(
        self,
        bag: Played,
        given: PlaybackParameters,
        offers: Mapping[str, OfferedQos] = NO_OFFERS,
    ) -> None:
        """Choose topics and span.

        Args:
            bag: Where they are.
            given: Which.
            offers: By topic, the quality of service that it is played with, if not the recorded.

        Raises:
            ConfigurationError: A topic is not in the bag, none is chosen, or the span is empty.

        """
        bag.require(given.topics)
        selection = given.selection()
        self.topics = [topic for topic in bag.topics if selection.takes(topic)]
        if not self.topics:
            msg = f'no topic of bag {bag.path} is chosen; it has {", ".join(bag.topics) or "none"}'
            raise ConfigurationError(msg)
        self.bag = bag
        self.begin = bag.start + round(given.start_offset * 1e9)
        self.end = _end(bag, given, self.begin)
        self._leaps = [after for _, after in bag.gaps()] if given.skip_gaps else []
        self._latched = {topic: kept(_profiles(bag, offers, topic)) for topic in self.topics}

    def messages(self, start: int) -> Iterator[Message]:
        """Yield the messages from a time [ns] to the end."""
        return self.bag.messages(self.topics, start=start, stop=self.end + 1)

    def gaps_after(self, start: int) -> deque[int]:
        """Return the times [ns] after ``start`` to which is leapt from a gap between bags."""
        return deque(after for after in self._leaps if after > start)

    def latched_before(self, start: int) -> Iterator[Message]:
        """Yield what latched topics told before ``start``, as a late listener would get it."""
        latched = {topic: self._latched[topic] for topic in self.topics if self._latched[topic]}
        if not latched or start <= self.bag.start:
            return
        latest: dict[str, deque[Message]] = {t: deque(maxlen=n) for t, n in latched.items()}
        for message in self.bag.messages(latched, stop=start):
            latest[message.connection.topic].append(message)
        yield from sorted((m for queue in latest.values() for m in queue), key=lambda m: m.stamp)

    def require_inside(self, stamp: int) -> None:
        """Raise unless a time [ns] lies in the span.

        Raises:
            ConfigurationError: It lies outside.

        """
        if not self.begin <= stamp <= self.end:
            seconds, low, high = (
                (t - self.bag.start) * 1e-9 for t in (stamp, self.begin, self.end)
            )
            msg = f'seek to {seconds:.3f} s: choose a time in [{low:.3f}, {high:.3f}] s of the bag'
            raise ConfigurationError(msg)


def _profiles(bag: Played, offers: Mapping[str, OfferedQos], topic: str) -> tuple[OfferedQos, ...]:
    """Return the quality of service with which a topic is played."""
    if topic in offers:
        return (offers[topic],)
    return tuple(one for c in bag.connections if c.topic == topic for one in c.qos)


def _last_instant(seconds: float) -> int:
    """Return the last nanosecond that reads as this number of seconds.

    Around today's times a float tells a quarter of a microsecond apart, and the message at the
    very time that was given must be among them.
    """
    return int((Fraction(seconds) + Fraction(nextafter(seconds, inf))) / 2 * 1_000_000_000)


def _end(bag: Played, given: PlaybackParameters, begin: int) -> int:
    """Return the log time [ns] of the last message to play."""
    end = bag.end
    if given.playback_duration >= 0.0:
        end = min(end, begin + round(given.playback_duration * 1e9))
    if given.playback_until_nsec >= 0:
        end = min(end, given.playback_until_nsec)
    elif given.playback_until >= 0.0:
        end = min(end, _last_instant(given.playback_until))
    if end < begin:
        length = (bag.end - bag.start) * 1e-9
        msg = (
            f'nothing to play: it begins {(begin - bag.start) * 1e-9:.3f} s into the bag and ends '
            f'at {(end - bag.start) * 1e-9:.3f} s; the bag is {length:.3f} s long'
        )
        raise ConfigurationError(msg)
    return end
