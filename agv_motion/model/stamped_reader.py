"""Messages of a topic that differ in stamp and numbers alone: the names between are read once.

A robot tells of the same frames and joints all day. Only where the bytes of the names have changed
is a message read field by field; else all of its numbers are taken at once from where they stand.
"""

from __future__ import annotations

from struct import Struct, error
from typing import TYPE_CHECKING, Generic, TypeVar

from agv_motion.errors import SignalError
from agv_motion.model.cdr_reader import HEADER, SECOND, CdrReader

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

Names = TypeVar('Names')
NAMES = HEADER + 8
"""Where names begin: behind the stamp [bytes]"""
END_OF_TIME = 2**31 * SECOND
"""[ns] The first instant that a builtin_interfaces/Time cannot tell"""


class StampedReader(Generic[Names]):
    """Reads the messages of one topic: a stamp, names, and numbers of double precision.

    ::

        frames = StampedReader(lambda message: (message.text(), 7))  # PoseStamped
        stamp, frame, numbers = frames.read(data)
    """

    def __init__(self, names: Callable[[CdrReader], tuple[Names, int]]) -> None:
        """Have seen no message yet.

        Args:
            names: Reads what stands behind the stamp; returns it, and how many numbers follow.

        """
        self._read_names = names
        self._header = self._alike = b''
        """of the last message that was read field by field: its header, and the bytes of names"""

    def read(self, data: bytes) -> tuple[int, Names, Sequence[float]]:
        """Return the stamp [ns], the names and the numbers of a message in CDR.

        Raises:
            SignalError: It ends too early, a name is no UTF-8, or its stamp is no time.

        """
        if data[:HEADER] != self._header or not data.startswith(self._alike, NAMES):
            self._learn(data)
        try:
            sec, nanosec, *numbers = self._layout.unpack_from(data, HEADER)
        except error as fault:
            msg = f'a message of {len(data)} bytes ends in the midst of its numbers'
            raise SignalError(msg) from fault
        stamp = sec * SECOND + nanosec
        if stamp >= END_OF_TIME:
            msg = f'a stamp of {sec} s and {nanosec} ns is behind the last one there is, 2^31 s'
            raise SignalError(msg)
        return stamp, self._names, numbers

    def _learn(self, data: bytes) -> None:
        """Read names, and find the place of the numbers behind them."""
        message = CdrReader(data)
        message.time()
        names, count = self._read_names(message)
        gap = (HEADER - message.at) % 8 if count else 0
        self._layout = Struct(f'{message.order}iI{message.at - NAMES + gap}x{count}d')
        self._header, self._alike, self._names = data[:HEADER], data[NAMES : message.at], names
