"""The time of a recording: that of `/clock` where it tells another one than the arrivals."""

from __future__ import annotations

from itertools import islice
from struct import Struct, error
from typing import TYPE_CHECKING

from agv_motion.errors import SourceError

if TYPE_CHECKING:
    from agv_motion.bag.connection import Message
    from agv_motion.bag.reader import BagReader

CLOCK = '/clock'
LOOK = 1000
"""Ticks at the beginning by which a clock is judged."""
SAME = 100_000_000
"""[ns] by which the stamps of a recording may differ from the clock that they were taken from"""
_TIME = Struct('<iI'), Struct('>iI')


class BagClock:
    """Tells the time of each message: nodes that ran beside a simulation lived by its clock."""

    def __init__(self, bag: BagReader) -> None:
        """Look whether there is a clock that tells another time than the messages came at.

        Where the recording itself was stamped by the clock, its stamps are finer than the ticks.

        Raises:
            SourceError: One of the first messages of the clock is no time.

        """
        ticks = list(islice(bag.messages([CLOCK]), LOOK)) if CLOCK in bag.topics else []
        another = any(abs(_time(tick) - tick.stamp) > SAME for tick in ticks)
        self.topics = {CLOCK} if another else set()
        """to be read beside the inputs"""
        self.start = _time(ticks[0]) if another else bag.start
        """[ns]"""
        self._now = self.start
        self._log_end = bag.end

    def time_of(self, message: Message) -> int:
        """Return the time [ns] at which the next message of the bag was heard.

        Raises:
            SourceError: The clock goes back.

        """
        if not self.topics:
            return message.stamp
        if message.connection.topic == CLOCK:
            now = _time(message)
            if now < self._now:
                msg = (
                    f'{CLOCK} goes back from {self._now} to {now} ns, at {message.stamp} ns of the '
                    'bag: the simulation began anew; a recording of each run can be reprocessed'
                )
                raise SourceError(msg)
            self._now = now
        return self._now

    def end(self) -> int:
        """Return the last time [ns], once all messages were heard."""
        return self._now if self.topics else self._log_end


def _time(message: Message) -> int:
    try:
        seconds, rest = _TIME[not message.data[1] & 1].unpack_from(message.data, 4)
    except (IndexError, error):
        msg = f'{CLOCK}: the message at {message.stamp} ns is no time'
        raise SourceError(msg) from None
    return int(seconds * 1_000_000_000 + rest)
