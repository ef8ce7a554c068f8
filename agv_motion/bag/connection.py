"""One topic of a bag as its messages say it: name, type, definition, quality of service."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.bag.quality_of_service import OfferedQos


class Connection(NamedTuple):
    """Messages of one type on one topic; a topic that changed its type has several."""

    topic: str
    type: str
    """such as ``geometry_msgs/msg/TwistStamped``"""
    definition: str
    """full text of the type, '' where the bag has none; bytes that are no text, as surrogates"""
    definition_encoding: str
    """``ros2msg`` or ``ros2idl``, '' where the bag has none"""
    encoding: str
    """of the messages: ``cdr``"""
    hash: str
    """``RIHS01_...``, or '' where unknown"""
    qos: Sequence[OfferedQos]
    """of each publisher"""
    notes: tuple[tuple[str, str], ...] = ()
    """what else an MCAP file says of the channel"""

    @property
    def latched(self) -> bool:
        """Whether a late subscriber would have received the last message."""
        return any(profile.durability == 'transient_local' for profile in self.qos)


class Message(NamedTuple):
    """One message of a bag."""

    connection: Connection
    stamp: int
    """[ns] log time: when it was received"""
    data: bytes
    """in CDR, its four bytes of header included"""
    publish: int
    """[ns] when it was sent"""
    sequence: int
    """number that the sender gave it, 0 where unknown"""
