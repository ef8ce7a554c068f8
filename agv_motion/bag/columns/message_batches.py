"""Messages of any storage, one after another, taken together in batches."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from agv_motion.bag.cdr.primitives import ENCAPSULATION
from agv_motion.bag.columns.batch import Batch
from agv_motion.bag.compression import decompress_message
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap.chunk_content import LARGEST

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence
    from pathlib import Path

    from agv_motion.bag.connection import Message
    from agv_motion.bag.storage import Storage

_TOGETHER = 2048
"""Messages that are taken together where there are no chunks."""
_ALL = 2**64 - 1
_MOST = 1 << 24
"""[bytes] ... and their size."""


def of_messages(
    file: Storage,
    channels: Collection[int],
    start: int,
    stop: int,
    *,
    compressed: bool,
) -> Iterator[Batch]:
    """Yield the messages of any file, some together; unpack those that are compressed each."""
    numbers = {connection: channel for channel, connection in file.channels.items()}
    waiting: dict[int, list[Message]] = {channel: [] for channel in channels}
    size = count = 0
    for message in file.messages(channels, start, stop):
        if compressed:
            message = unpack_message(message, file.path)  # noqa: PLW2901 - the same, unpacked
        waiting[numbers[message.connection]].append(message)
        size, count = size + len(message.data), count + 1
        if size > _MOST or count >= _TOGETHER:
            yield from _joined(waiting, file.path)
            size = count = 0
    yield from _joined(waiting, file.path)


def unpack_message(message: Message, path: Path) -> Message:
    """Return a message that rosbag2 compressed by itself, unpacked.

    Raises:
        DamagedBagError: It is damaged.

    """
    try:
        return message._replace(data=decompress_message(message.data, LARGEST))
    except ValueError as error:
        finding = f'a message on {message.connection.topic} at {message.stamp} ns ({error})'
        raise DamagedBagError(path, 0, finding) from None


def _joined(waiting: dict[int, list[Message]], path: Path) -> Iterator[Batch]:
    for channel, messages in waiting.items():
        if messages:
            yield joined(channel, messages, path)
            messages.clear()


def joined(channel: int, messages: Sequence[Message], path: Path) -> Batch:
    """Return messages of one channel as a batch; ``path`` is where they come from.

    Raises:
        DamagedBagError: One is too short for CDR.

    """
    short = next((m for m in messages if len(m.data) < ENCAPSULATION), None)
    if short:
        finding = f'a message on {short.connection.topic} with {len(short.data)} bytes'
        raise DamagedBagError(path, 0, finding)
    data = b''.join(message.data for message in messages)
    sizes = np.array([len(message.data) for message in messages], np.int64)
    starts = np.cumsum(sizes) - sizes
    forms = np.ndarray((len(data) - 1,), '>u2', data, strides=(1,))[starts]
    stamps = np.array([m.stamp & _ALL for m in messages], np.uint64).view(np.int64)
    contents = starts + ENCAPSULATION, sizes - ENCAPSULATION
    return Batch(channel, data, *contents, forms, stamps, path, [(0, 0)])
