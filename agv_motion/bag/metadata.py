"""``metadata.yaml`` of a bag, layout version 9 of rosbag2 (ROS 2 Jazzy)."""

from __future__ import annotations

import os
from textwrap import dedent
from typing import TYPE_CHECKING, Any, NamedTuple

from agv_motion.files import yaml_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    from agv_motion.bag.quality_of_service import OfferedQos

FILE_NAME = 'metadata.yaml'
UNFINISHED = f'{FILE_NAME}.tmp'
"""what a killed writer may leave of it; the next one writes over it"""
SIZE, ENTRIES = 64 << 20, 1_000_000
"""[bytes], and values, that a description may have: thousands of topics and files"""
NEVER = 2**63 - 1
"""[ns] Start of a bag without messages, as rosbag2 writes it."""


class Topic(NamedTuple):
    """What a bag says of a topic before its first message."""

    name: str
    type: str
    """such as ``geometry_msgs/msg/TwistStamped``"""
    definition: str
    """the .msg file and those of the types it uses"""
    hash: str
    """``RIHS01_...``, or '' where unknown"""
    qos: Sequence[OfferedQos]
    definition_encoding: str = 'ros2msg'
    """or ``ros2idl``"""
    encoding: str = 'cdr'
    """of the messages"""
    notes: tuple[tuple[str, str], ...] = ()
    """what else an MCAP file is to say of the channel"""


class FileSummary(NamedTuple):
    """What one file of the bag holds."""

    path: str
    """relative to the bag"""
    start: int
    """[ns] log time of the first message"""
    end: int
    """[ns] log time of the last message"""
    messages: int


def describe(
    files: Sequence[FileSummary],
    topics: Iterable[tuple[Topic, int]],
    ros_distro: str = 'jazzy',
    storage: str = 'mcap',
) -> str:
    """Return the metadata of a bag, for its folder or for inside an MCAP file.

    Args:
        files: The files, in the order of time.
        topics: Each topic with the number of its messages.
        ros_distro: Name of the ROS distribution, such as ``jazzy``.
        storage: Format of the files.

    """
    filled = [file for file in files if file.messages]
    start = min((file.start for file in filled), default=NEVER)
    end = max((file.end for file in filled), default=NEVER)
    entries = {
        'version': 9,
        'storage_identifier': storage,
        **_span(start, end),
        'message_count': sum(file.messages for file in files),
        'topics_with_message_count': [_topic(*topic) for topic in topics],
        'compression_format': '',
        'compression_mode': '',
        'relative_file_paths': [file.path for file in files],
        'files': [_file(file) for file in files],
        'custom_data': None,
        'ros_distro': ros_distro,
    }
    return yaml_text.dump({'rosbag2_bagfile_information': entries})


def inside_mcap(description: str) -> str:
    """Return a description as rosbag2 repeats it inside an MCAP file: without its only key."""
    _, _, entries = description.partition('\n')
    return dedent(entries)


def save(bag: Path, description: str) -> None:
    """Put ``metadata.yaml`` into the folder of a bag, whole or not at all."""
    unfinished = bag / UNFINISHED
    try:
        with unfinished.open('w', encoding='utf-8') as file:
            file.write(description)
            file.flush()
            os.fsync(file.fileno())
        unfinished.replace(bag / FILE_NAME)
    except BaseException:
        unfinished.unlink(missing_ok=True)
        raise


def _span(start: int, end: int) -> dict[str, Any]:
    return {
        'duration': {'nanoseconds': end - start},
        'starting_time': {'nanoseconds_since_epoch': start},
    }


def _file(file: FileSummary) -> dict[str, Any]:
    span = _span(file.start, file.end) if file.messages else _span(NEVER, NEVER)
    return {'path': file.path, **span, 'message_count': file.messages}


def _topic(topic: Topic, messages: int) -> dict[str, Any]:
    return {
        'topic_metadata': {
            'name': topic.name,
            'type': topic.type,
            'serialization_format': topic.encoding,
            'offered_qos_profiles': [profile.entries() for profile in topic.qos],
            'type_description_hash': topic.hash,
        },
        'message_count': messages,
    }
