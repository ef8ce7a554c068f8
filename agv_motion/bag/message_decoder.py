"""Messages of a bag as objects, by the definition in the bag; without rclpy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from agv_motion.bag.connection import Connection, Message


class MessageDecoder:
    """Decodes the messages of a topic."""

    def __init__(self, connection: Connection) -> None:
        """Understand the definition.

        Raises:
            ConfigurationError: The bag has no definition of the type, or one that cannot be read.

        """
        self._connection = connection
        self.store = get_typestore(Stores.EMPTY)
        """knows the type and those that it uses"""
        try:
            self.store.register(get_types_from_msg(connection.definition, connection.type))
        except Exception as error:  # rosbags raises several kinds
            msg = (
                f'{connection.topic}: the definition of {connection.type} in the bag cannot be '
                f'read ({error})'
            )
            raise ConfigurationError(msg) from error

    def __call__(self, message: Message) -> Any:
        """Return a message as an object.

        Raises:
            SourceError: It is not of its type.

        """
        try:
            return self.store.deserialize_cdr(message.data, self._connection.type)
        except Exception as error:  # whatever the bytes provoke
            msg = (
                f'{self._connection.topic}: the message at {message.stamp} ns is no '
                f'{self._connection.type} ({error}); agv bag check tells more'
            )
            raise SourceError(msg) from error
