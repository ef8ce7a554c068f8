"""Messages of many topics in the order of their arrival, stamped with simulated time.

Taps are taken from one after the other, and a clock that is simulated stands between two of its
ticks: what a message led to would stand before it. The middleware stamps arrivals by the clock on
the wall, those of `/clock` too; by that the messages are sorted, and each gets the time that the
last tick before it told.
"""

from __future__ import annotations

from struct import Struct
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

_TIME = Struct('<iI'), Struct('>iI')
TICK = 0
"""in place of the handle of a topic: a message of `/clock`"""


class _Arrival(NamedTuple):
    received: int
    """[ns] by the clock on the wall"""
    topic: int
    data: bytes
    sequence: int


class Arrivals:
    """Holds messages until all that came before them are there, too."""

    def __init__(self, put: Callable[[int, int, bytes, int, int], None], now: int) -> None:
        """Start at a simulated time.

        Args:
            put: Called with handle, log time, data, time of sending and number of each message.
            now: [ns] of the simulation.

        """
        self.now = now
        self._put = put
        self._waiting: list[_Arrival] = []

    def add(self, topic: int, data: bytes, info: dict[str, Any]) -> None:
        """Take a message, or a tick of the clock, with rclpy's message info."""
        number = info['publication_sequence_number'] or 0
        self._waiting.append(_Arrival(info['received_timestamp'], topic, data, number))

    def pass_on(self, until: int | None = None) -> None:
        """Hand on what came before a time on the wall [ns]; None: everything."""
        waiting = sorted(self._waiting, key=lambda arrival: arrival.received)
        self._waiting.clear()
        for arrival in waiting:
            if until is not None and arrival.received > until:
                self._waiting.append(arrival)
            elif arrival.topic == TICK:
                seconds, rest = _TIME[not arrival.data[1] & 1].unpack_from(arrival.data, 4)
                self.now = max(seconds * 1_000_000_000 + rest, 0)
            else:
                self._put(arrival.topic, self.now, arrival.data, self.now, arrival.sequence)
