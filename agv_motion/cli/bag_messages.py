"""Messages of a bag as objects that can be printed, by the definition in the bag; without rclpy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.bag.connection import Connection, Message

_ROS_NAMES = {'float32': 'float', 'float64': 'double', 'bool': 'boolean', 'byte': 'octet'}
_BASE, _NAME, _ARRAY = 1, 2, 3


def decoder(connection: Connection) -> Callable[[Message], Any]:
    """Return what decodes the messages of a topic into objects like those of rclpy.

    Raises:
        ConfigurationError: The bag has no definition of the type, or one that cannot be read.

    """
    store = get_typestore(Stores.EMPTY)
    try:
        store.register(get_types_from_msg(connection.definition, connection.type))
    except Exception as error:  # rosbags raises several kinds
        msg = (
            f'{connection.topic}: the definition of {connection.type} in the bag cannot be read '
            f'({error})'
        )
        raise ConfigurationError(msg) from error
    for name, kind in store.types.items():
        types = {field: _type(found) for field, found in store.fielddefs[name][1]}
        kind.get_fields_and_field_types = _constant(types)  # type: ignore[attr-defined] # as rclpy

    def decode(message: Message) -> Any:
        try:
            return store.deserialize_cdr(message.data, connection.type)
        except Exception as error:  # whatever the bytes provoke
            msg = (
                f'{connection.topic}: the message at {message.stamp} ns is no {connection.type} '
                f'({error}); agv bag check tells more'
            )
            raise SourceError(msg) from error

    return decode


def _constant(types: dict[str, str]) -> Any:
    return staticmethod(lambda: types)


def _type(description: Any) -> str:
    """Return a type in the words of rclpy."""
    node, value = description
    if node == _BASE:
        return _ROS_NAMES.get(value[0], str(value[0]))
    if node == _NAME:
        return str(value).replace('/msg/', '/')
    inner, size = value
    return f'{_type(inner)}[{size}]' if node == _ARRAY else f'sequence<{_type(inner)}>'
