"""Messages of a bag as objects that can be printed, by the definition in the bag; without rclpy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from agv_motion.bag.cdr.message_decoder import MessageDecoder
from agv_motion.bag.cdr.message_type import NOTHING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from agv_motion.bag.connection import Connection, Message
    from agv_motion.bag.reader import BagReader

_ROS_NAMES = {'float32': 'float', 'float64': 'double', 'bool': 'boolean'}
"""A byte is a uint8 here, since its values are numbers; rclpy's octet is a bytes of one."""
_BASE, _NAME, _ARRAY = 1, 2, 3


def decoder(connection: Connection, bag: Path) -> MessageDecoder:
    """Return what decodes the messages of a topic of a bag into objects like those of rclpy.

    Raises:
        ConfigurationError: The bag has no definition of the type, or one that cannot be read.

    """
    decode = MessageDecoder(connection, bag)
    for name, kind in decode.store.types.items():
        fields = decode.store.fielddefs[name][1]
        types = {field: _type(found) for field, found in fields if field != NOTHING}
        kind.get_fields_and_field_types = _constant(types)  # type: ignore[attr-defined] # as rclpy
    return decode


def decoded(
    bag: BagReader, topics: Iterable[str], start: int | None = None, stop: int | None = None
) -> Iterator[tuple[Message, Any]]:
    """Yield the messages of some topics by log time, as they were recorded and as objects.

    Args:
        bag: To read.
        topics: Their names.
        start: [ns] first log time; None: the beginning.
        stop: [ns] log time before which to stop; None: never.

    Raises:
        ConfigurationError: A topic is not there, or its type cannot be understood.
        SourceError: The bag is damaged, or a message is not of its type.

    """
    wanted = list(topics)
    bag.require(wanted)
    decoders: dict[tuple[str, str, str], MessageDecoder] = {}
    for message in bag.messages(wanted, start, stop) if wanted else ():
        connection = message.connection
        key = connection.topic, connection.type, connection.definition
        if key not in decoders:
            decoders[key] = MessageDecoder(connection, bag.path)
        yield message, decoders[key](message)


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
