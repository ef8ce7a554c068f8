"""Some minutes of a bag as a bag of their own, with all that listeners had been told before."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.bag.last_messages import last_before
from agv_motion.bag.metadata import Topic

if TYPE_CHECKING:
    from agv_motion.bag.connection import Connection, Message
    from agv_motion.bag.reader import BagReader
    from agv_motion.bag.writer import BagWriter


def save_excerpt(bag: BagReader, writer: BagWriter, start: int, stop: int) -> int:
    """Copy the messages from ``start`` until before ``stop`` [ns]; return how many.

    What latched topics had said last before is there too, stamped with ``start``: maps, goals and
    states are known from the first moment. A second type of a topic is left out.

    Raises:
        SourceError: The old bag is damaged, or the disk takes no more.

    """
    handles: dict[str, tuple[Connection, int]] = {}

    def write(message: Message, stamp: int) -> int:
        connection = message.connection
        if connection.topic not in handles:
            topic = Topic(
                connection.topic, connection.type, connection.definition, connection.hash,
                tuple(connection.qos),
            )  # fmt: skip
            handles[connection.topic] = connection, writer.add(topic)
        known, handle = handles[connection.topic]
        if known.type != connection.type:
            return 0
        writer.write(handle, stamp, message.data)
        return 1

    latched = [name for name, connection in bag.topics.items() if connection.latched]
    before = last_before(bag, latched, start)
    count = sum(write(message, start) for message in before.values())
    return count + sum(write(message, message.stamp) for message in bag.messages(None, start, stop))
