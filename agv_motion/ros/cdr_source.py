"""What the writers of CDR functions share: the fields of a class, and text that becomes code."""

from __future__ import annotations

import importlib
from array import array
from typing import TYPE_CHECKING, Any

import numpy as np
from rosidl_parser.definition import AbstractWString, BasicType, NamespacedType

from agv_motion.bag.cdr.primitives import PRIMITIVES
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterator

_NAMES = {'boolean': 'bool', 'octet': 'byte', 'float': 'float32', 'double': 'float64'}
"""What ``.msg`` files call the primitives to which rosidl gives another name."""


def fields(kind: type[Any]) -> Iterator[tuple[str, Any]]:
    """Yield attribute and type of each field."""
    for slot, field in zip(kind.__slots__, kind.SLOT_TYPES, strict=False):
        if isinstance(field, AbstractWString):
            msg = f'{kind.__name__}.{slot[1:]} is a wide string: it cannot be reprocessed'
            raise ConfigurationError(msg)
        yield slot, field


def message_class_of(field: NamespacedType) -> type[Any]:
    """Return the message class of a field."""
    kind: type[Any] = getattr(importlib.import_module('.'.join(field.namespaces)), field.name)
    return kind


class Source:
    """Lines of a function in the making, and the objects that they name."""

    def __init__(self) -> None:
        """Start with no line."""
        self.lines: list[str] = []
        self.names: dict[str, Any] = {'array': array, 'np': np}
        self._count = 0

    def name(self, value: Any = None) -> str:
        """Return a new name, for ``value`` if there is one."""
        self._count += 1
        name = f'_{self._count}'
        if value is not None:
            self.names[name] = value
        return name

    def compiled(self, head: str, what: str) -> Any:
        """Return the function of the lines under ``head``."""
        text = '\n'.join([head, *(f'    {line}' for line in self.lines)])
        exec(compile(text, f'<{what}>', 'exec'), self.names)  # noqa: S102 - our own text
        return self.names['function']


def basic(field: BasicType) -> tuple[str, int]:
    """Return letter and size of a primitive type."""
    primitive = PRIMITIVES[_NAMES.get(field.typename, field.typename)]
    return primitive.code, primitive.size
