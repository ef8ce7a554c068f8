"""Time of a bag against the time of the clock on the wall: rate, pause, jump. Reads no clock."""

from __future__ import annotations


class Timeline:
    """Where playback stands; every method is told the present time ``now`` [s]."""

    def __init__(self, stamp: int, rate: float) -> None:
        """Stand still at ``stamp``.

        Args:
            stamp: [ns] of the bag.
            rate: Seconds of the bag per second, once it goes.

        """
        self.rate = rate
        self.paused = True
        self._stamp, self._since = stamp, 0.0

    def position(self, now: float) -> int:
        """Return the time of the bag [ns]."""
        if self.paused:
            return self._stamp
        return self._stamp + int((now - self._since) * self.rate * 1e9)

    def due(self, stamp: int) -> float:
        """Return when ``stamp`` [ns] is reached [s], if nothing changes; only while it goes."""
        return self._since + (stamp - self._stamp) * 1e-9 / self.rate

    def pause(self, now: float) -> None:
        """Stand still."""
        self._stamp, self.paused = self.position(now), True

    def resume(self, now: float) -> None:
        """Go on."""
        if self.paused:
            self._since, self.paused = now, False

    def set_rate(self, rate: float, now: float) -> None:
        """Go faster or slower from here."""
        self.jump(self.position(now), now)
        self.rate = rate

    def jump(self, stamp: int, now: float) -> None:
        """Be at ``stamp`` [ns], going or standing as before."""
        self._stamp, self._since = stamp, now
