"""The newest message of one topic, decoded only when somebody looks at it."""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

_numbers = count(1)
_NOTHING: Any = object()


class Entry:
    """A message, as it came: bytes with what decodes them, or an object."""

    __slots__ = (
        '_conversion', '_data', '_decode', '_message', '_needs', 'at', 'number',
    )  # fmt: skip

    def __init__(
        self, at: float, data: Any, decode: Callable[[Any], Any] | None = None,
        needs: tuple[str, ...] = (),
    ) -> None:  # fmt: skip
        """Keep a message.

        Args:
            at: When it came [s], on the clock of the board.
            data: The message, or its bytes.
            decode: Makes a message of ``data``; None where it is one.
            needs: Fields without which it is no message.

        """
        self.at, self._data, self._decode, self._needs = at, data, decode, needs
        self.number = next(_numbers)
        """greater than that of every message that came before"""
        self._message: Any = _NOTHING
        self._conversion: tuple[Callable[[Any], Any] | None, Any] = None, None
        """the last one asked for, and what it made of the message"""

    @property
    def message(self) -> Any:
        """The message; None if it cannot be decoded, or is none."""
        if self._message is _NOTHING:
            found = self._decoded()
            whole = all(hasattr(found, field) for field in self._needs)
            self._message = found if whole else None
            self._data = self._decode = None
        return self._message

    def converted(self, convert: Callable[[Any], Any]) -> Any:
        """Return what ``convert`` makes of the message, which there must be; made only once.

        Whoever gets it leaves it as it is: others get the same.
        """
        if self._conversion[0] is not convert:
            self._conversion = convert, convert(self.message)
        return self._conversion[1]

    def _decoded(self) -> Any:
        if self._decode is None:
            return self._data
        try:
            return self._decode(self._data)
        except Exception:  # noqa: BLE001 - whatever the bytes of a stranger provoke
            return None
