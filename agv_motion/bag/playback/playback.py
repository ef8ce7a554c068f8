"""Play a bag: each message at its time, on a thread that others command."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from agv_motion.bag.playback.excerpt import NO_OFFERS, PlaybackExcerpt
from agv_motion.bag.playback.playback_parameters import PlaybackParameters
from agv_motion.bag.playback.transport import Transport
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from agv_motion.bag.connection import Message
    from agv_motion.bag.playback.delay_histogram import DelayHistogram
    from agv_motion.bag.playback.several_bags import SeveralBags
    from agv_motion.bag.quality_of_service import OfferedQos
    from agv_motion.bag.reader import BagReader


class Playback:
    """Sends the messages of a bag or several; pause, seek, rate: from any thread."""

    def __init__(
        self,
        bag: BagReader | SeveralBags,
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
        self.excerpt = PlaybackExcerpt(bag, given, offers)
        self.finished = threading.Event()
        """set when the last message was sent, until :meth:`seek`, and at :meth:`stop`"""
        self.failure = ''
        """why the playback ended early; empty if it did not"""
        self._given, self._send = given, send
        self._transport = Transport(self.excerpt.begin, given.rate)
        self._thread = threading.Thread(target=self._run, name='playback', daemon=True)

    def start(self) -> None:
        """Begin to send."""
        self._thread.start()

    def stop(self) -> None:
        """Send no more, and wait for the thread."""
        self._transport.stop()
        if self._thread.is_alive():
            self._thread.join()

    @property
    def lag(self) -> DelayHistogram:
        """By how much messages were late."""
        return self._transport.lag

    @property
    def paused(self) -> bool:
        """Whether it waits for :meth:`resume`."""
        return self._transport.paused

    @property
    def rate(self) -> float:
        """Seconds of the bag per second."""
        return self._transport.rate

    def position(self) -> int:
        """Return the time of the bag [ns], between begin and end of what is played."""
        return min(max(self._transport.position(), self.excerpt.begin), self.excerpt.end)

    def pause(self) -> None:
        """Stand still."""
        self._transport.pause()

    def resume(self) -> None:
        """Go on."""
        self._transport.resume()

    def set_rate(self, rate: float) -> None:
        """Go faster or slower, within the range of the parameter.

        Raises:
            ConfigurationError: The rate is out of range.

        """
        PlaybackParameters(rate=rate)
        self._transport.set_rate(rate)

    def seek(self, stamp: int) -> None:
        """Go to a time of the bag [ns]; what is latched there is sent first.

        After the end, it plays on from there.

        Raises:
            ConfigurationError: The time lies outside of what is played, or the playback failed.

        """
        if self.failure:
            raise ConfigurationError(self.failure)
        self.excerpt.require_inside(stamp)
        self._transport.seek(stamp, self.finished)

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
        self._transport.play_next(count)

    def _run(self) -> None:
        transport, given = self._transport, self._given
        try:
            transport.wait(given.delay)
            if not given.start_paused:
                transport.resume()
            while not transport.stopped:
                if self._pass() and not given.loop:
                    transport.wait_at_end(self.finished)
        except Exception as error:  # noqa: BLE001 - there is nobody above to tell
            self.failure = f'playing {self.excerpt.bag.path} ended: {error}'
        self.finished.set()

    def _pass(self) -> bool:
        """Play from the beginning, or where it was sent, on; return whether the end was reached."""
        transport, excerpt = self._transport, self.excerpt
        goal = transport.take_goal()
        start = excerpt.begin if goal is None else goal
        for message in excerpt.latched_before(start):
            self._send(message)
        transport.be_at(start)
        gaps = excerpt.gaps_after(start)
        for message in excerpt.messages(start):
            while gaps and message.stamp >= gaps[0]:
                transport.be_at(gaps.popleft())
            if not transport.wait_until_due(message.stamp):
                return False
            self._send(message)
        return True
