"""The first fields of a few messages in CDR, read one after the other without their classes.

Who records or serves what a graph says has bytes, and need not have the packages of their types.

Source: OMG, DDS-XTypes 1.3, 7.4.1: XCDR version 1, plain, of either order of bytes.
"""

from __future__ import annotations

from struct import error, unpack_from
from typing import NoReturn

from agv_motion.errors import SignalError

HEADER = 4
"""Bytes before the first field; the second tells the order of all that follow."""
SECOND = 1_000_000_000


class CdrReader:
    """Reads fields in the order in which a message has them."""

    def __init__(self, data: bytes) -> None:
        """Stand before the first field.

        Raises:
            SignalError: It is too short for any message.

        """
        if len(data) < HEADER:
            msg = f'{len(data)} bytes are no message in CDR'
            raise SignalError(msg)
        self._data, self.at = data, HEADER
        self.order = '<' if data[1] & 1 else '>'
        """of bytes, as `struct` has it"""

    def time(self) -> int:
        """Return a builtin_interfaces/Time [ns]."""
        sec, nanosec = self._take('iI', 8)
        return sec * SECOND + nanosec

    def text(self) -> str:
        """Return a string."""
        length = self.count()
        content = self.octets(length)
        try:
            return content[:-1].decode()
        except UnicodeDecodeError as fault:
            msg = f'a text of the message is no UTF-8 ({fault})'
            raise SignalError(msg) from fault

    def texts(self) -> list[str]:
        """Return a list of strings."""
        count = self.count()
        if count * 4 > len(self._data) - self.at:
            self._end()
        return [self.text() for _ in range(count)]

    def count(self) -> int:
        """Return the length of a list, which stands before it."""
        return self._take('I', 4)[0]

    def octets(self, length: int) -> bytes:
        """Return as many bytes as they are."""
        content = self._data[self.at : self.at + length]
        if len(content) < length:
            self._end()
        self.at += length
        return bytes(content)

    def _take(self, layout: str, size: int) -> tuple[int, ...]:
        at = self.at + (HEADER - self.at) % 4
        try:
            values = unpack_from(self.order + layout, self._data, at)
        except error:
            self._end()
        self.at = at + size
        return values

    def _end(self) -> NoReturn:
        msg = f'a message of {len(self._data)} bytes ends in the midst of a field'
        raise SignalError(msg)
