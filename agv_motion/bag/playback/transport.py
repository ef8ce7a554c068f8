"""The controls of a playback, as of a tape deck: any thread may press them while another plays."""

from __future__ import annotations

import threading
from math import inf
from time import perf_counter

from agv_motion.bag.playback.delay_histogram import DelayHistogram
from agv_motion.bag.playback.timeline import Timeline


class Transport:
    """Says when the next message is due, and whether to go elsewhere instead."""

    def __init__(self, begin: int, rate: float) -> None:
        """Stand still.

        Args:
            begin: Where [ns].
            rate: Seconds of the bag per second, once it goes.

        """
        self.lag = DelayHistogram()
        """by how much messages were late"""
        self.stopped = False
        self._timeline = Timeline(begin, rate)
        self._condition = threading.Condition()
        self._single = 0
        """messages that are to be sent though it stands"""
        self._goal: int | None = None
        """where it was told to go [ns]"""

    # By any thread

    @property
    def paused(self) -> bool:
        """Whether it waits for :meth:`resume`."""
        return self._timeline.paused

    @property
    def rate(self) -> float:
        """Seconds of the bag per second."""
        return self._timeline.rate

    def position(self) -> int:
        """Return the time of the bag [ns]."""
        return self._timeline.position(perf_counter())

    def stop(self) -> None:
        """Play no more."""
        with self._condition:
            self.stopped = True
            self._condition.notify()

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
        """Go faster or slower."""
        with self._condition:
            self._timeline.set_rate(rate, perf_counter())
            self._condition.notify()

    def seek(self, stamp: int, finished: threading.Event) -> None:
        """Go to a time of the bag [ns]: unless it was stopped, it is ``finished`` no more."""
        with self._condition:
            self._goal = stamp
            if not self.stopped:
                finished.clear()
            self._timeline.jump(stamp, perf_counter())
            self._condition.notify()

    def play_next(self, count: int) -> None:
        """While it stands, let the next ``count`` messages go at once."""
        with self._condition:
            self._single += count
            self._condition.notify()

    # By the thread that plays

    def wait(self, delay: float) -> None:
        """Wait for a while [s], or until it is stopped."""
        with self._condition:
            self._condition.wait_for(lambda: self.stopped, delay)

    def wait_at_end(self, finished: threading.Event) -> None:
        """Be ``finished``, until it is sent elsewhere or stopped."""
        with self._condition:
            if self._goal is None:
                self._single = 0
                finished.set()
            self._condition.wait_for(lambda: self.stopped or self._goal is not None)

    def take_goal(self) -> int | None:
        """Return where it was told to go [ns], once; None: nowhere."""
        with self._condition:
            goal, self._goal = self._goal, None
        return goal

    def be_at(self, stamp: int) -> None:
        """Count the time of the bag from ``stamp`` [ns] on."""
        with self._condition:
            self._timeline.jump(stamp, perf_counter())

    def wait_until_due(self, stamp: int) -> bool:
        """Wait until ``stamp`` is due; return False if it was stopped or sent elsewhere."""
        timeline, condition = self._timeline, self._condition
        with condition:
            while True:
                if self.stopped or self._goal is not None:
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
