"""Numbers for texts, so that a column of strings is a column of numbers."""

from __future__ import annotations

_MOST = 1 << 16
"""Texts that are looked up; beyond, each new one is kept though it may have come before."""


class TextCodes:
    """Gives every text a number."""

    def __init__(self) -> None:
        """Begin without texts."""
        self.values: list[str] = []
        self._codes: dict[bytes, int] = {}

    def code(self, data: bytes) -> int:
        """Return the number of a text in UTF-8.

        Raises:
            ValueError: It is not UTF-8.

        """
        code = self._codes.get(data)
        if code is None:
            code = len(self.values)
            self.values.append(data.decode())
            if code < _MOST:
                self._codes[data] = code
        return code
