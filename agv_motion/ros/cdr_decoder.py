"""Write functions that turn CDR into messages."""

from __future__ import annotations

from struct import Struct
from struct import error as StructError  # noqa: N812 - the module names it in lower case
from typing import TYPE_CHECKING, Any

import numpy as np
from rosidl_parser.definition import AbstractString, Array, BasicType, NamespacedType

from agv_motion.bag.cdr.primitives import HEADER
from agv_motion.errors import SignalError
from agv_motion.ros.cdr_source import Source, basic, fields, message_class_of

if TYPE_CHECKING:
    from collections.abc import Callable


class Decoder:
    """Writes a function that makes a message, taking what lies together in one step."""

    def __init__(self, kind: type[Any]) -> None:
        """Write for one class."""
        self._kind = kind
        self._source = Source()
        self._targets: list[str] = []
        self._codes: list[tuple[str, int]] = []

    def function(self) -> Callable[[bytes], Any]:
        """Return the decoder; it raises a SignalError on bytes that are no such message."""
        kind = self._kind
        message = self._message(kind, '')
        self._take('')
        self._source.lines.append(f'return {message}, p')
        self._source.names['new'] = object.__new__
        make = self._source.compiled('def function(d):\n    p = 4', f'decode {kind.__name__}')

        def decode(data: bytes) -> Any:
            if data[:2] != HEADER[:2]:
                msg = f'{kind.__name__}: CDR header {data[:4].hex()}, expected {HEADER.hex()}'
                raise SignalError(msg)
            try:
                message, end = make(data)
            except (StructError, ValueError) as error:
                msg = f'{kind.__name__} in {len(data)} bytes cannot be decoded: {error}'
                raise SignalError(msg) from error
            if end > len(data):
                msg = f'{kind.__name__} needs {end} bytes, but there are {len(data)}'
                raise SignalError(msg)
            return message

        return decode

    def _take(self, indent: str) -> None:
        """Write down how to unpack the fields that have come together."""
        if not self._codes:
            return
        unpack, size = zip(*(_run(self._codes, start) for start in range(8)), strict=True)
        unpack, size = self._source.name(unpack), self._source.name(size)
        targets = ', '.join(self._targets)
        self._source.lines.append(
            f'{indent}a = p & 7; ({targets},) = {unpack}[a](d, p); p += {size}[a]'
        )
        self._targets, self._codes = [], []

    def _join(self, target: str, code: str, size: int) -> None:
        self._targets.append(target)
        self._codes.append((code, size))

    def _message(self, kind: type[Any], indent: str) -> str:
        """Return the name of a new message whose fields are filled."""
        name = self._source.name()
        made = self._source.name(kind)
        self._source.lines.append(f'{indent}{name} = new({made}); {name}._check_fields = False')
        empty = True
        for slot, field in fields(kind):
            self._field(f'{name}.{slot}', field, indent)
            empty = False
        if empty:
            self._join(self._source.name(), 'B', 1)
        return name

    def _field(self, target: str, field: Any, indent: str) -> None:
        lines = self._source.lines
        if isinstance(field, BasicType):
            self._join(target, *basic(field))
        elif isinstance(field, NamespacedType):
            lines.append(f'{indent}{target} = {self._message(message_class_of(field), indent)}')
        elif isinstance(field, AbstractString):
            self._join('n', 'I', 4)
            self._take(indent)
            lines.append(f'{indent}{target} = d[p:p + n - 1].decode(); p += n')
        elif isinstance(field, Array):
            self._take(indent)
            self._several(target, field.value_type, str(field.size), indent, fixed=True)
        else:
            count = self._source.name()
            self._join(count, 'I', 4)
            self._take(indent)
            self._several(target, field.value_type, count, indent, fixed=False)

    def _several(self, target: str, element: Any, count: str, indent: str, *, fixed: bool) -> None:
        lines = self._source.lines
        if not isinstance(element, BasicType):
            item, sequence = self._source.name(), self._source.name()
            lines.append(f'{indent}{target} = {sequence} = []')
            lines.append(f'{indent}for _ in range({count}):')
            self._field(item, element, indent + '    ')
            self._take(indent + '    ')
            lines.append(f'{indent}    {sequence}.append({item})')
            return
        code, size = basic(element)
        if element.typename == 'boolean':
            lines.append(f'{indent}{target} = [x != 0 for x in d[p:p + {count}]]')
        elif element.typename == 'octet':
            lines.append(f'{indent}{target} = [bytes((x,)) for x in d[p:p + {count}]]')
        elif fixed:
            lines.append(f'{indent}p += (4 - p) & {size - 1}')
            kind = self._source.name(np.dtype(code))
            lines.append(f'{indent}{target} = np.frombuffer(d, {kind}, {count}, p).copy()')
        else:
            lines.append(f'{indent}p += (4 - p) & {size - 1} if {count} else 0')
            lines.append(f"{indent}{target} = array('{code}', d[p:p + {count} * {size}])")
        lines.append(f'{indent}p += {count} * {size}')


def _run(codes: list[tuple[str, int]], start: int) -> tuple[Callable[..., Any], int]:
    """Return what unpacks fields that begin at a place, and how long they are.

    Args:
        codes: Letter and size of each field.
        start: The place modulo 8, counted from the four bytes before the message.

    """
    position = (start - len(HEADER)) % 8
    begin, parts = position, ['<']
    for code, size in codes:
        gap = -position % size
        parts.append(f'{gap}x{code}')
        position += gap + size
    return Struct(''.join(parts)).unpack_from, position - begin
