"""Messages of one channel that lie in one buffer: what columns are decoded from."""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.compression import decompress_message
from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap.chunk import LARGEST

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.bag.connection import Message
    from agv_motion.bag.mcap.file import McapFile
    from agv_motion.bag.mcap.record_parsing import Buffer
    from agv_motion.bag.sqlite.file import SqliteFile

ENCAPSULATION = 4
"""[bytes] before the content of a message: how it is written"""
_TOGETHER = 2048
"""Messages that are taken together where there are no chunks."""
_ALL = 2**64 - 1
_MOST = 1 << 24
"""[bytes] ... and their size."""


class Batch(NamedTuple):
    """Some messages of one channel."""

    channel: int
    data: Buffer
    starts: NDArray[np.int64]
    """[bytes] in ``data`` where the content of each begins, behind the encapsulation"""
    sizes: NDArray[np.int64]
    """[bytes] of each content"""
    forms: NDArray[Any]
    """encapsulation of each: 0 for big-endian, 1 for little-endian CDR"""
    stamps: NDArray[np.int64]
    """[ns] log time of each"""
    path: Path
    origins: Sequence[tuple[int, int]]
    """where ``data`` comes from, for errors: pairs of a place in it [bytes] and one in the file"""

    def origin(self, row: int) -> int:
        """Return the place in the file where a message comes from [bytes]."""
        return place_in_file(self.origins, int(self.starts[row]))

    def part(self, rows: slice) -> Batch:
        """Return some of the messages."""
        return self._replace(
            starts=self.starts[rows],
            sizes=self.sizes[rows],
            forms=self.forms[rows],
            stamps=self.stamps[rows],
        )


def place_in_file(origins: Sequence[tuple[int, int]], place: int) -> int:
    """Return the place in the file of a place in a buffer [bytes]."""
    return origins[max(0, bisect_right(origins, (place, 2**63)) - 1)][1]


def of_messages(
    file: McapFile | SqliteFile,
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
        if not messages:
            continue
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
        yield Batch(channel, data, *contents, forms, stamps, path, [(0, 0)])
        messages.clear()
