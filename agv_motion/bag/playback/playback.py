"""Play a bag: each message at its time, on a thread that others command."""

from __future__ import annotations

import threading
from collections import deque
from fractions import Fraction
from math import inf, nextafter
from time import perf_counter
from typing import TYPE_CHECKING

from agv_motion.bag.playback.delay_histogram import DelayHistogram
from agv_motion.bag.playback.playback_parameters import PlaybackParameters
from agv_motion.bag.playback.timeline import Timeline
from agv_motion.bag.quality_of_service import kept
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from agv_motion.bag.connection import Message
    from agv_motion.bag.quality_of_service import OfferedQos
    from agv_motion.bag.reader import BagReader

FOREVER = 2**63 - 1
NO_OFFERS: dict[str, OfferedQos] = {}


class Playback:
    """Sends the messages of one bag; pause, seek, rate and the rest may come from any thread."""

    def __init__(
        self,
        bag: BagReader,
        given: PlaybackParameters,
        send: Callable[[Message], None],
        offers: Mapping[str, OfferedQos] = NO_OFFERS,
    ) -> None:
        """Choose topics and span; nothing is sent before :meth:`start`.

        Args:
            bag: What to play; it is not closed.
            given: How.
            send: Called with each message, on the thread of the playback.
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
        self.begin = bag.start + round(given.start_offset * 1e9)
        self.end = _end(bag, given, self.begin)
        self.lag = DelayHistogram()
        self.finished = threading.Event()
        """set when the last message was sent, until :meth:`seek`, and at :meth:`stop`"""
        self.failure = ''
        """why the playback ended early; empty if it did not"""
        self._bag, self._given, self._send = bag, given, send
        self._latched = {topic: kept(_profiles(bag, offers, topic)) for topic in self.topics}
        self._timeline = Timeline(self.begin, given.rate)
        self._condition = threading.Condition()
        self._stopped, self._single = False, 0
        self._goal: int | None = None
        self._thread = threading.Thread(target=self._run, name='playback', daemon=True)

    def start(self) -> None:
        """Begin to send."""
        self._thread.start()

    def stop(self) -> None:
        """Send no more, and wait for the thread."""
        with self._condition:
            self._stopped = True
            self._condition.notify()
        if self._thread.is_alive():
            self._thread.join()

    @property
    def paused(self) -> bool:
        """Whether it waits for :meth:`resume`."""
        return self._timeline.paused

    @property
    def rate(self) -> float:
        """Seconds of the bag per second."""
        return self._timeline.rate

    def position(self) -> int:
        """Return the time of the bag [ns], between its begin and end."""
        return min(max(self._timeline.position(perf_counter()), self.begin), self.end)

    def pause(self) -> None:
        """Stand still."""
        with self._condition:
            self._timeline.pause(perf_counter())
            self._condition.notify()

    def resume(self) -> None:
        """Go on."""
        with self._condition:
            self._timeline.resume(perf_counter())
            self._condition.notify()

    def set_rate(self, rate: float) -> None:
        """Go faster or slower, within the range of the parameter.

        Raises:
            ConfigurationError: The rate is out of range.

        """
        PlaybackParameters(rate=rate)
        with self._condition:
            self._timeline.set_rate(rate, perf_counter())
            self._condition.notify()

    def seek(self, stamp: int) -> None:
        """Go to a time of the bag [ns]; what is latched there is sent first.

        After the end, it plays on from there.

        Raises:
            ConfigurationError: The time lies outside of what is played, or the playback failed.

        """
        if self.failure:
            raise ConfigurationError(self.failure)
        if not self.begin <= stamp <= self.end:
            seconds = (stamp - self._bag.start) * 1e-9
            low, high = ((t - self._bag.start) * 1e-9 for t in (self.begin, self.end))
            msg = f'seek to {seconds:.3f} s: choose a time in [{low:.3f}, {high:.3f}] s of the bag'
            raise ConfigurationError(msg)
        with self._condition:
            self._goal = stamp
            if not self._stopped:
                self.finished.clear()
            self._timeline.jump(stamp, perf_counter())
            self._condition.notify()

    def play_next(self, count: int = 1) -> None:
        """While paused, send the next ``count`` messages at once.

        Raises:
            ConfigurationError: It is not paused, or at its end.

        """
        if self.finished.is_set():
            msg = 'at the end: there is no next message; seek first'
            raise ConfigurationError(msg)
        if not self.paused:
            msg = 'playing: pause first, then go message by message'
            raise ConfigurationError(msg)
        with self._condition:
            self._single += count
            self._condition.notify()

    def _run(self) -> None:
        try:
            with self._condition:
                self._condition.wait_for(lambda: self._stopped, self._given.delay)
                if not self._given.start_paused:
                    self._timeline.resume(perf_counter())
            while not self._stopped:
                if self._pass() and not self._given.loop:
                    self._wait_at_end()
        except Exception as error:  # noqa: BLE001 - there is nobody above to tell
            self.failure = f'playing {self._bag.path} ended: {error}'
        self.finished.set()

    def _wait_at_end(self) -> None:
        """Be finished, until it is sent elsewhere or stopped."""
        with self._condition:
            if self._goal is None:
                self._single = 0
                self.finished.set()
            self._condition.wait_for(lambda: self._stopped or self._goal is not None)

    def _pass(self) -> bool:
        """Play from the beginning, or where it was sent, on; return whether the end was reached."""
        with self._condition:
            start = self.begin if self._goal is None else self._goal
            self._goal = None
        for message in self._before(start):
            self._send(message)
        with self._condition:
            self._timeline.jump(start, perf_counter())
        for message in self._bag.messages(self.topics, start=start, stop=self.end + 1):
            if not self._await(message.stamp):
                return False
            self._send(message)
        return True

    def _before(self, start: int) -> Iterator[Message]:
        """Yield what latched topics told before ``start``, as a late listener would get it."""
        latched = {topic: number for topic, number in self._latched.items() if number}
        if not latched or start <= self._bag.start:
            return
        latest: dict[str, deque[Message]] = {t: deque(maxlen=n) for t, n in latched.items()}
        for message in self._bag.messages(latched, stop=start):
            latest[message.connection.topic].append(message)
        yield from sorted((m for queue in latest.values() for m in queue), key=lambda m: m.stamp)

    def _await(self, stamp: int) -> bool:
        """Wait until ``stamp`` is due; return False if it was stopped or went elsewhere."""
        timeline, condition = self._timeline, self._condition
        with condition:
            while True:
                if self._stopped or self._goal is not None:
                    return False
                now = perf_counter()
                if self._single:
                    self._single -= 1
                    timeline.jump(stamp, now)
                    return True
                wait = inf if timeline.paused else timeline.due(stamp) - now
                if wait <= 0.0:
                    self.lag.add(-wait)
                    return True
                condition.wait(None if wait == inf else wait)


def _profiles(
    bag: BagReader, offers: Mapping[str, OfferedQos], topic: str
) -> tuple[OfferedQos, ...]:
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


def _end(bag: BagReader, given: PlaybackParameters, begin: int) -> int:
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
