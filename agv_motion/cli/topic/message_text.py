"""Messages as text and back, in the form of `ros2 topic`."""

from __future__ import annotations

import array
import csv
import re
import sys
from io import StringIO
from typing import TYPE_CHECKING, Any

import numpy as np
import yaml

from agv_motion.cli.graph.session import interface_class
from agv_motion.errors import ConfigurationError
from agv_motion.ros.suggestion import meant

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from typing import TypeGuard

Sequence = (list, tuple, array.array, np.ndarray)


def is_message(value: Any) -> TypeGuard[Any]:
    """Return whether ``value`` is a ROS message."""
    return hasattr(value, 'get_fields_and_field_types')


class MessageText:
    """How messages are written: how long, and whether arrays and strings are shown."""

    def __init__(
        self,
        truncate_length: int | None = None,
        *,
        no_arr: bool = False,
        no_str: bool = False,
        flow_style: bool = False,
    ) -> None:
        """Keep the options of ``ros2 topic echo``."""
        self._length = truncate_length
        self._no_arr, self._no_str, self._flow_style = no_arr, no_str, flow_style

    def yaml(self, message: Any) -> str:
        """Return a message as YAML, fields in their order."""
        return yaml.dump(
            self._plain(message),
            allow_unicode=True,
            width=sys.maxsize,
            default_flow_style=self._flow_style,
            sort_keys=False,
        )

    def csv(self, message: Any) -> str:
        """Return all values of a message, separated by commas; those with commas are quoted."""
        return csv_row(self._flat(self._plain(message)))

    def _flat(self, value: Any) -> list[str]:
        if isinstance(value, dict):
            return [text for item in value.values() for text in self._flat(item)]
        if isinstance(value, list):
            return [text for item in value for text in self._flat(item)] or ['']
        return [str(value)]

    def _plain(self, value: Any, field_type: str = '') -> Any:
        """Return ``value`` as what YAML knows."""
        if is_message(value):
            types = value.get_fields_and_field_types()
            return {name: self._plain(getattr(value, name), types[name]) for name in types}
        if isinstance(value, bytes):
            return self._cut(value.decode('latin-1'))
        if isinstance(value, str):
            return f'<string length: <{len(value)}>>' if self._no_str else self._cut(value)
        if isinstance(value, Sequence):
            if self._no_arr and field_type:
                return _abbreviated(value, field_type)
            items = [self._plain(item) for item in value[: self._length]]
            return items if len(items) == len(value) else [*items, '...']
        return value.item() if isinstance(value, np.generic) else value

    def _cut(self, text: str) -> str:
        if self._length is None or len(text) <= self._length:
            return text
        return text[: self._length] + '...'


def csv_row(values: Iterable[object]) -> str:
    """Return values as one record of CSV: what has commas, quotes or lines in it is quoted."""
    row = StringIO()
    csv.writer(row).writerow(values)
    return row.getvalue().removesuffix('\r\n')


def _abbreviated(value: Any, field_type: str) -> str:
    """Return what stands for an array: its type and length."""
    if field_type.startswith('sequence<'):
        inner = re.sub(r'sequence<|[,>].*', '', field_type)
        return f'<sequence type: {inner}, length: {len(value)}>'
    return f'<array type: {field_type}>'


def fill(message: Any, values: Any) -> list[Callable[[Any], None]]:
    """Fill a message from YAML values; return what sets its stamps that were given as `now`.

    A header given as ``auto`` and a time given as ``now`` take the time of publishing.

    Raises:
        ConfigurationError: A field does not exist, or a value does not fit its type.

    """
    if not isinstance(values, dict):
        msg = f"Value '{values}' is expected to be a dictionary but is a {type(values).__name__}"
        raise ConfigurationError(msg)
    stamps: list[Callable[[Any], None]] = []
    types = message.get_fields_and_field_types()
    for name, value in values.items():
        if name not in types:
            msg = (
                f"Failed to populate field: {type(message).__name__} has no field '{name}'"
                f'{meant(str(name), list(types))}; it has {", ".join(types)}'
            )
            raise ConfigurationError(msg)
        field = getattr(message, name)
        if types[name] == 'std_msgs/Header' and value == 'auto':
            stamps.append(_setter(field, 'stamp'))
        elif types[name] == 'builtin_interfaces/Time' and value == 'now':
            stamps.append(_setter(message, name))
        elif is_message(field):
            stamps += fill(field, value)
        else:
            try:
                converted = _converted(field, value, types[name])
                type(message)(check_fields=True, **{name: converted})  # the range of the field
                setattr(message, name, converted)
            except (AssertionError, TypeError, ValueError, OverflowError) as error:
                msg = f"Failed to populate field: {name} ({types[name]}) with '{value}': {error}"
                raise ConfigurationError(msg) from error
    return stamps


def _setter(target: Any, name: str) -> Callable[[Any], None]:
    return lambda stamp: setattr(target, name, stamp)


def _converted(field: Any, value: Any, field_type: str) -> Any:
    """Return ``value`` in the type that a field holds.

    Raises:
        TypeError, ValueError, OverflowError: It would be another value there.

    """
    if isinstance(field, (array.array, np.ndarray)):
        return _numbers(field, value)
    if isinstance(field, list):
        inner = re.sub(r'sequence<|[,>\[].*', '', field_type)
        if '/' not in inner:
            return list(value)
        items = []
        for item in value:
            items.append(interface_class(inner)())
            fill(items[-1], item)
        return items
    if isinstance(field, bytes):
        return bytes([value]) if isinstance(value, int) else value
    if isinstance(field, bool) and value not in {False, True}:
        reason = 'write true or false'
        raise ValueError(reason)
    converted = value if isinstance(value, bool) else type(field)(value)
    if isinstance(field, int) and isinstance(value, float) and converted != value:
        reason = 'write a whole number'
        raise ValueError(reason)
    return converted


def _numbers(field: Any, values: Any) -> Any:
    """Return an array as ``field`` is one, of the very numbers of ``values``."""
    if isinstance(field, array.array):
        found: Any = array.array(field.typecode, values)
    else:
        found = np.array(values, dtype=field.dtype)
    given, held = np.asarray(values, dtype=float), np.asarray(found, dtype=float)
    if not np.allclose(held, given, rtol=1e-6, atol=1e-30, equal_nan=True):
        reason = 'the type does not hold one of these numbers'
        raise ValueError(reason)
    return found
