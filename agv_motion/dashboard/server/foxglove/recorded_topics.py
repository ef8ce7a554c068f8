"""What a bag has for the clients of the endpoint: topics that it holds, and those made of them."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.cdr.definitions import installed
from agv_motion.bag.reader import BagReader
from agv_motion.dashboard.foxglove import protocol
from agv_motion.dashboard.foxglove.channels import GraphTopic
from agv_motion.dashboard.foxglove.transforms import DerivedTransforms
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.bag.connection import Connection


class RecordedTopics(NamedTuple):
    """What a bag has for its clients."""

    span: tuple[int, int]
    """times of its first and of its last message [ns]"""
    topics: dict[str, GraphTopic]
    """all that are served"""
    recorded: frozenset[str]
    """those that are in the bag; the others are made"""
    complaints: dict[str, str]
    """why some are not served"""


def recorded_topics(path: Path) -> RecordedTopics:
    """Return what is in a bag.

    Raises:
        AgvMotionError: There is no bag, or it cannot be read at all.

    """
    topics, complaints = dict[str, GraphTopic](), dict[str, str]()
    with BagReader(path) as bag:
        span = bag.start, bag.end
        for name, connection in bag.topics.items():
            try:
                topics[name] = _topic(connection)
            except ConfigurationError as error:  # noqa: PERF203 - the others are served
                complaints[name] = str(error)
    made = DerivedTransforms(inf).offered(topics)
    return RecordedTopics(span, topics | made, frozenset(topics), complaints)


def _topic(connection: Connection) -> GraphTopic:
    """Return what clients are told of a topic of a bag.

    Raises:
        ConfigurationError: Neither the bag nor this machine knows its definition.

    """
    if connection.encoding not in {'', protocol.CDR}:
        msg = f'its messages are {connection.encoding}, not {protocol.CDR}'
        raise ConfigurationError(msg)
    definition, encoding = connection.definition, connection.definition_encoding
    if not definition:
        definition, encoding = installed(connection.type).text, protocol.DEFINITION
    return GraphTopic(
        connection.topic, connection.type, definition.encode(errors='replace').decode(),
        definition_encoding=encoding or protocol.DEFINITION,
    )  # fmt: skip
