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
        self._data, self._at = data, HEADER
        self._order = '<' if data[1] & 1 else '>'

    def time(self) -> int:
        """Return a builtin_interfaces/Time [ns]."""
        sec, nanosec = self._take('iI', 4, 8)
        return int(sec) * SECOND + int(nanosec)

    def text(self) -> str:
        """Return a string."""
        length = self._count()
        content = self._bytes(length)
        try:
            return content[:-1].decode()
        except UnicodeDecodeError as fault:
            msg = f'a text of the message is no UTF-8 ({fault})'
            raise SignalError(msg) from fault

    def texts(self) -> list[str]:
        """Return a list of strings."""
        count = self._count()
        if count * 4 > len(self._data) - self._at:
            self._end()
        return [self.text() for _ in range(count)]

    def numbers(self, count: int) -> tuple[float, ...]:
        """Return ``count`` numbers of double precision."""
        if count * 8 > len(self._data) - self._at:
            self._end()
        return self._take(f'{count}d', 8, 8 * count) if count else ()

    def list_of_numbers(self) -> tuple[float, ...]:
        """Return a list of numbers of double precision."""
        return self.numbers(self._count())

    def _count(self) -> int:
        return int(self._take('I', 4, 4)[0])

    def _bytes(self, length: int) -> bytes:
        content = self._data[self._at : self._at + length]
        if len(content) < length:
            self._end()
        self._at += length
        return bytes(content)

    def _take(self, layout: str, alignment: int, size: int) -> tuple[float, ...]:
        at = self._at + (HEADER - self._at) % alignment
        try:
            values = unpack_from(self._order + layout, self._data, at)
        except error:
            self._end()
        self._at = at + size
        return values

    def _end(self) -> NoReturn:
        msg = f'a message of {len(self._data)} bytes ends in the midst of a field'
        raise SignalError(msg)
