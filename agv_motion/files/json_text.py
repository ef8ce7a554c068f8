"""JSON (RFC 8259, and NaN as Python writes it) as `Marked` values, within the limits."""

from __future__ import annotations

import json
import re
from bisect import bisect_right
from typing import TYPE_CHECKING, Any, NoReturn

from agv_motion.files import text as files
from agv_motion.files.limits import DEPTH, NUMBER, VALUES
from agv_motion.files.marked import Marked, quoted

if TYPE_CHECKING:
    from pathlib import Path

_WHITE = re.compile(r'[ \t\n\r]*')
_NUMBER = re.compile(r'-?(?:0|[1-9][0-9]*)(\.[0-9]+)?([eE][-+]?[0-9]+)?')
_STRING = re.compile(r'"(?:[^"\\\x00-\x1f]|\\.)*"')
_WORD = re.compile(r'true|false|null|NaN|-?Infinity')


def load(path: Path, what: str = 'the file') -> Marked:
    """Return the content of a file.

    Raises:
        ConfigurationError: It cannot be read, is no JSON, or goes beyond the limits.

    """
    return parse(files.read(path, what), path)


def parse(text: str, path: Path | str, values: int = VALUES) -> Marked:
    """Return what a text says.

    Args:
        text: JSON.
        path: Where it is from, for the errors.
        values: How many it may hold.

    Raises:
        ConfigurationError: It is no JSON, or goes beyond the limits.

    """
    return _Reader(text, path, values).document()


class _Reader:
    """Recursive descent, no deeper than the limit."""

    def __init__(self, text: str, path: Path | str, values: int) -> None:
        self._text, self._path, self._values = text, path, values
        self._at = self._depth = self._count = 0
        self._lines = [0, *(match.end() for match in re.finditer('\n', text))]

    def document(self) -> Marked:
        value = self._value()
        self._skip()
        if self._at < len(self._text):
            self._refuse('expected the end of the file')
        return value

    def _value(self) -> Marked:
        self._skip()
        self._count += 1
        if self._count > self._values:
            self._refuse(f'more than {self._values} values')
        start, first = self._at, self._text[self._at : self._at + 1]
        if first in {'{', '['} and first:
            self._depth += 1
            if self._depth > DEPTH:
                self._refuse(f'nested more than {DEPTH} deep')
            value = self._object(start) if first == '{' else self._array(start)
            self._depth -= 1
            return value
        return self._marked(start, self._string() if first == '"' else self._number())

    def _object(self, start: int) -> Marked:
        entries: dict[str, tuple[Marked, Marked]] = {}
        while self._more('}', bool(entries)):
            self._skip()
            key = self._marked(self._at, self._string())
            if key.value in entries:
                key.refuse(f"'{key.value:.80}' stands twice", 'a key that stands twice')
            self._expect(':')
            entries[key.value] = key, self._value()
        return self._marked(start, None, entries)

    def _array(self, start: int) -> Marked:
        items: list[Marked] = []
        while self._more(']', bool(items)):
            items.append(self._value())
        return self._marked(start, None, None, items)

    def _more(self, end: str, begun: bool) -> bool:  # noqa: FBT001 - reads as it is called
        """Return whether another item follows; pass what opens, parts or ends them."""
        if not begun:
            self._at += 1
        self._skip()
        if self._text[self._at : self._at + 1] == end:
            self._at += 1
            return False
        if begun:
            self._expect(',')
        return True

    def _string(self) -> str:
        found = _STRING.match(self._text, self._at)
        if not found:
            self._refuse('expected text in double quotes')
        try:
            value: str = json.loads(found[0])
            value.encode()
        except ValueError:  # an escape that is none, or half a character
            self._refuse('text with an escape that is none')
        self._at = found.end()
        return value

    def _number(self) -> Any:
        word = _WORD.match(self._text, self._at)
        found = word or _NUMBER.match(self._text, self._at)
        if not found:
            self._refuse('expected a value')
        if len(found[0]) > NUMBER:
            self._refuse(f'a number of {len(found[0])} characters: {NUMBER} are enough')
        self._at = found.end()
        return json.loads(found[0])

    def _expect(self, sign: str) -> None:
        self._skip()
        if self._text[self._at : self._at + 1] != sign:
            self._refuse(f"expected '{sign}'")
        self._at += 1

    def _skip(self) -> None:
        self._at = _WHITE.match(self._text, self._at).end()  # type: ignore[union-attr]

    def _marked(self, at: int, *rest: Any) -> Marked:
        line = bisect_right(self._lines, at)
        return Marked(self._path, line, at - self._lines[line - 1] + 1, *rest)

    def _refuse(self, reason: str) -> NoReturn:
        rest = self._text[self._at : self._at + 20].split('\n')[0]
        got = f', got {quoted(rest)}' if rest else ', got the end'
        self._marked(self._at, None).refuse(f'no JSON: {reason}{got}', f'no JSON: {reason}')
