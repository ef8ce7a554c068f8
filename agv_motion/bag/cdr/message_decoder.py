"""Messages of a bag as objects, by the definition in the bag; without rclpy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_typestore

from agv_motion.bag.cdr.layout import layout
from agv_motion.bag.cdr.message_type import NOTHING, declared, short, unfold
from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.bag.cdr.message_type import Field
    from agv_motion.bag.connection import Connection, Message

LONGEST_REASON = 300
"""Characters"""


class MessageDecoder:
    """Decodes the messages of a topic."""

    def __init__(self, connection: Connection, bag: Path | str = '') -> None:
        """Understand the definition.

        Args:
            connection: The topic.
            bag: Whose it is, for errors.

        Raises:
            ConfigurationError: The bag has no definition of the type, or one that cannot be read,
                or messages that are no CDR.

        """
        self._connection = connection
        self._where = f'bag {bag}, topic {connection.topic}' if bag else connection.topic
        self.store = get_typestore(Stores.EMPTY)
        """knows the type and those that it uses"""
        try:
            self.store.register(_types(connection))
        except Exception as error:  # rosbags raises several kinds
            msg = (
                f'{self._where}: messages of {connection.type} cannot be decoded '
                f'({str(error)[:LONGEST_REASON]})'
            )
            raise ConfigurationError(msg) from error
        self._type = _full(short(connection.type))

    def __call__(self, message: Message) -> Any:
        """Return a message as an object.

        Raises:
            SourceError: It is not of its type.

        """
        try:
            return self.store.deserialize_cdr(message.data, self._type)
        except Exception as error:  # whatever the bytes provoke
            msg = (
                f'{self._where}: the message at {message.stamp} ns is no '
                f'{self._connection.type} ({error}); agv bag check tells more'
            )
            raise SourceError(msg) from error


def _types(connection: Connection) -> dict[str, Any]:
    """Return the type of a topic, and those that it uses, in the words of rosbags."""
    if connection.encoding != 'cdr':
        msg = f'they are encoded in {connection.encoding!r}; only CDR is understood'
        raise ConfigurationError(msg)
    described = connection.type, connection.definition, connection.definition_encoding
    layout(unfold(*described))  # no trap, and all that it has can be read
    return {
        _full(name): ([], [(field.name, _described(field)) for field in fields] or _EMPTY)
        for name, fields in declared(*described).items()
    }


def _full(name: str) -> str:
    """Return PACKAGE/msg/NAME of PACKAGE/NAME."""
    package, _, last = name.partition('/')
    return f'{package}/msg/{last}'


def _described(field: Field) -> Any:
    # a byte of ROS is an octet, which rosbags takes for a signed number
    kind = 'uint8' if field.type == 'byte' else field.type
    one = (Nodetype.NAME, _full(kind)) if '/' in kind else (Nodetype.BASE, (kind, 0))
    if not field.array:
        return one
    return (
        (Nodetype.SEQUENCE, (one, 0)) if field.size is None else (Nodetype.ARRAY, (one, field.size))
    )


_EMPTY = [(NOTHING, (Nodetype.BASE, ('uint8', 0)))]
