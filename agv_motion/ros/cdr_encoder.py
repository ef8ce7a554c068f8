"""Write functions that turn messages into CDR."""

from __future__ import annotations

from struct import Struct
from struct import error as StructError  # noqa: N812 - the module names it in lower case
from typing import TYPE_CHECKING, Any

from rosidl_parser.definition import (
    AbstractNestedType,
    AbstractString,
    Array,
    BasicType,
    NamespacedType,
)

from agv_motion.bag.cdr.primitives import HEADER
from agv_motion.errors import SignalError
from agv_motion.ros.cdr_source import Source, basic, fields, message_class_of

if TYPE_CHECKING:
    from collections.abc import Callable

MOST_LAYOUTS = 1000
"""of one class that are remembered"""

GATHER = 'v = []; k = []'
"""First line where a message has sequences of messages, whose values must be gathered in a loop."""


class Encoder:
    """Writes a function that gathers the values of a message and the lengths of what may vary.

    The layout (a format of `struct`) depends on those lengths alone, so it is worked out once for
    each set of them.
    """

    def __init__(self, kind: type[Any]) -> None:
        """Write for one class."""
        self._kind = kind
        self._source = Source()
        self._simple: list[str] = []
        self._lengths: list[str] = []

    def function(self) -> Callable[[Any], bytes]:
        """Return the encoder; it raises a SignalError on a value that its field cannot hold."""
        kind = self._kind
        self._message(kind, 'm', '')
        lines = self._source.lines
        if GATHER in lines:
            self._tell('')
            lines.append('return v, tuple(k)')
        else:
            lines.append(f'return ({_joined(self._simple)}), ({_joined(self._lengths)})')
        gather = self._source.compiled('def function(m):', f'encode {kind.__name__}')
        layouts: dict[tuple[int, ...], Callable[..., bytes]] = {}

        def encode(message: Any) -> bytes:
            values, lengths = gather(message)
            pack = layouts.get(lengths)
            if pack is None:
                if len(layouts) >= MOST_LAYOUTS:
                    layouts.clear()
                pack = layouts[lengths] = _Layout(kind, lengths).pack
            try:
                return pack(HEADER, *values)
            except StructError as error:
                msg = f'{kind.__name__} {message}: a value does not fit its field ({error})'
                raise SignalError(msg) from error

        return encode

    def _tell(self, indent: str) -> None:
        """Write down the values and lengths that have come together."""
        lines = self._source.lines
        if GATHER not in lines:
            lines.insert(0, GATHER)
        for target, found in (('v', self._simple), ('k', self._lengths)):
            if found:
                lines.append(f'{indent}{target} += ({_joined(found)})')
                found.clear()

    def _message(self, kind: type[Any], name: str, indent: str) -> None:
        for slot, field in fields(kind):
            self._field(f'{name}.{slot}', field, indent)

    def _field(self, value: str, field: Any, indent: str) -> None:
        lines, simple = self._source.lines, self._simple
        if isinstance(field, BasicType):
            simple.append(value)
        elif isinstance(field, NamespacedType):
            inner = self._source.name()
            lines.append(f'{indent}{inner} = {value}')
            self._message(message_class_of(field), inner, indent)
        elif isinstance(field, AbstractString):
            text = self._source.name()
            lines.append(f'{indent}{text} = {value}.encode()')
            self._lengths.append(f'len({text}) + 1')
            simple += [f'len({text}) + 1', text]
        else:
            self._several(value, field, indent)

    def _several(self, value: str, field: AbstractNestedType, indent: str) -> None:
        lines, element = self._source.lines, field.value_type
        if not isinstance(field, Array):
            self._lengths.append(f'len({value})')
            self._simple.append(f'len({value})')
        if isinstance(element, BasicType):
            form = {'boolean': 'bytes({})', 'octet': "b''.join({})"}
            self._simple.append(form.get(element.typename, '{}.tobytes()').format(value))
            return
        self._tell(indent)
        item = self._source.name()
        lines.append(f'{indent}for {item} in {value}:')
        lines.append(f'{indent}    pass')
        self._field(item, element, indent + '    ')
        self._tell(indent + '    ')


def _joined(parts: list[str]) -> str:
    return ''.join(f'{part}, ' for part in parts)


class _Layout:
    """The format of `struct` for a message whose strings and sequences have these lengths."""

    def __init__(self, kind: type[Any], lengths: tuple[int, ...]) -> None:
        self._parts = ['<4s']
        self._position = 0
        self._lengths = iter(lengths)
        self._message(kind)
        self.pack = Struct(''.join(self._parts)).pack

    def _put(self, code: str, size: int, alignment: int) -> None:
        gap = -self._position % alignment
        self._parts.append(f'{gap}x{code}' if gap else code)
        self._position += gap + size

    def _message(self, kind: type[Any]) -> None:
        members = [field for _, field in fields(kind)]
        for field in members:
            self._field(field)
        if not members:
            self._put('x', 1, 1)  # a structure without members is sent as one byte

    def _field(self, field: Any) -> None:
        if isinstance(field, BasicType):
            code, size = basic(field)
            self._put(code, size, size)
        elif isinstance(field, NamespacedType):
            self._message(message_class_of(field))
        elif isinstance(field, AbstractString):
            self._put('I', 4, 4)
            size = next(self._lengths)
            self._put(f'{size}s', size, 1)
        elif isinstance(field, Array):
            self._several(field.value_type, field.size)
        else:
            self._put('I', 4, 4)
            self._several(field.value_type, next(self._lengths))

    def _several(self, element: Any, count: int) -> None:
        if isinstance(element, BasicType):
            _, size = basic(element)
            self._put(f'{count * size}s', count * size, size if count else 1)
        else:
            for _ in range(count):
                self._field(element)
