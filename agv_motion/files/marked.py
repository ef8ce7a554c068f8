"""A value of a file that knows where it stands, so that an error can say file, line and column."""

from __future__ import annotations

from math import isfinite
from reprlib import Repr
from typing import TYPE_CHECKING, Any, NoReturn

from agv_motion.errors import ConfigurationError, place

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.errors import AgvMotionError

KINDS = {float: 'a number', int: 'a whole number', bool: 'true or false', str: 'text'}
LARGEST = 2**63
"""Whole numbers lie below it, as everywhere in ROS."""

_SHORT = Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = 80


class Marked:
    """One value: a scalar, or a mapping or list of further ones."""

    __slots__ = ('_entries', '_items', 'column', 'line', 'path', 'size', 'value')

    def __init__(  # noqa: PLR0913, PLR0917 - what a value is, and where
        self,
        path: Path | str,
        line: int,
        column: int,
        value: Any,
        entries: dict[str, tuple[Marked, Marked]] | None = None,
        items: list[Marked] | None = None,
    ) -> None:
        """Keep ``value`` (of a mapping or list, made of its parts) and where it stands."""
        self.path, self.line, self.column = path, line, column
        self._entries, self._items = entries, items
        self.value: Any = value
        self.size = 1
        """values in it, itself included; those that an alias repeats count again"""
        if entries is not None:
            self.value = {key: entry.value for key, (_, entry) in entries.items()}
            self.size += sum(entry.size for _, entry in entries.values())
        elif items is not None:
            self.value = [item.value for item in items]
            self.size += sum(item.size for item in items)

    @property
    def where(self) -> str:
        """File, line and column, counted from 1 as editors do."""
        return place(self.path, self.line, self.column)

    def refuse(
        self,
        reason: str,
        unquoted: str = 'it cannot be used as it stands',
        kind: type[AgvMotionError] = ConfigurationError,
    ) -> NoReturn:
        """Raise an error that says where; ``unquoted`` is what may be said over the network."""
        raise kind.at((self.path, self.line, self.column), reason, unquoted)

    def mapping(self, what: str) -> dict[str, tuple[Marked, Marked]]:
        """Return the keys of a mapping, each with itself and its value.

        Raises:
            ConfigurationError: It is no mapping.

        """
        if self._entries is None:
            expected = f'{what}: expected keys and values'
            self.refuse(f'{expected}, got {quoted(self.value)}', expected)
        return self._entries

    def items(self, what: str) -> list[Marked]:
        """Return the items of a list.

        Raises:
            ConfigurationError: It is no list.

        """
        if self._items is None:
            expected = f'{what}: expected a list'
            self.refuse(f'{expected}, each item after a dash, got {quoted(self.value)}', expected)
        return self._items

    def typed(self, what: str, kind: type[Any]) -> Any:
        """Return the value as a finite float, an int of 64 bits, bool or str.

        Raises:
            ConfigurationError: It is of another type, or beyond it.

        """
        value, expected = self.value, f'expected {KINDS[kind]}'
        if kind is float and type(value) is int:
            value = _floating(value)
        fits = type(value) is kind
        if fits and kind is float and not isfinite(value):
            fits, expected = False, 'must be a finite number'
        elif fits and kind is int and not -LARGEST <= value < LARGEST:
            fits, expected = False, f'{expected} of 64 bits'
        if not fits:
            self.refuse(f'{what} = {quoted(value)}: {expected}', f'{what}: {expected}')
        return value

    def point(self, what: str) -> tuple[float, float]:
        """Return two finite numbers.

        Raises:
            ConfigurationError: It holds something else.

        """
        items = self._items
        if items is None or len(items) != 2:
            expected = 'give two numbers, x and y in metres: [x, y]'
            self.refuse(f'{what} is {quoted(self.value)}: {expected}', f'{what}: {expected}')
        x, y = (
            item.typed(f'{what}: {axis}', float) for axis, item in zip('xy', items, strict=True)
        )
        return x, y


def quoted(value: Any) -> str:
    """Return a value as an error quotes it: short, however long or deep it is."""
    return f'{_SHORT.repr(value):.200}'


def _floating(value: int) -> float:
    try:
        return float(value)
    except OverflowError:
        return float('inf')
