"""The channels of an MCAP file as connections of a bag."""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.bag.connection import Connection
from agv_motion.bag.quality_of_service import OfferedQos

if TYPE_CHECKING:
    from collections.abc import Mapping

    from agv_motion.bag.mcap.records import Channel, Schema
    from agv_motion.bag.mcap.summary import Summary


def connections(found: Summary) -> dict[int, Connection]:
    """Return what a file says of its channels, by their ids."""
    return {
        number: from_channel(channel, found.schemas) for number, channel in found.channels.items()
    }


def from_channel(channel: Channel, schemas: Mapping[int, Schema]) -> Connection:
    """Return what an MCAP file says of a channel; a schema that is missing leaves gaps."""
    schema = schemas.get(channel.schema_id)
    return Connection(
        channel.topic,
        schema.name if schema else '',
        schema.data.decode(errors='surrogateescape') if schema else '',
        schema.encoding if schema else '',
        channel.encoding,
        channel.metadata.get('topic_type_hash', ''),
        OfferedQos.from_yaml(channel.metadata.get('offered_qos_profiles', '')),
        tuple(channel.metadata.items()),
    )
