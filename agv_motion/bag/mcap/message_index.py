"""Message index records of MCAP: where the messages of one channel lie in one chunk."""

from __future__ import annotations

from struct import Struct
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.bag.damage import DamagedBagError
from agv_motion.bag.mcap import records

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from agv_motion.bag.mcap.record_parsing import Buffer

NONE = np.empty((0, 2), np.uint64)
"""Rows of a channel without messages."""
_ENTRY = 16
_HEAD = Struct('<BQHI')
"""Prefix of a message index, its channel and the size of its entries."""


def rows(data: Buffer, channel: int, at: int, path: Path) -> NDArray[np.uint64]:
    """Return log time [ns] and offset in the chunk of the messages of a channel, (n, 2).

    Args:
        data: The file.
        channel: Id that the index must have.
        at: [bytes] where it is, by the summary.
        path: Of the file.

    Raises:
        DamagedBagError: There is no such index.

    """
    size = _HEAD.size
    if at + size > len(data):
        raise DamagedBagError(path, at, f'a message index at byte {at} of a file of {len(data)}')
    opcode, length, found, pairs = _HEAD.unpack_from(data, at)
    if opcode != records.MESSAGE_INDEX or at + records.PREFIX.size + length > len(data):
        raise DamagedBagError(path, at, 'no message index where the summary says')
    room = length - (size - records.PREFIX.size)
    if found != channel or pairs % _ENTRY or not 0 <= room - pairs < _ENTRY:
        finding = f'a message index of channel {found} with {pairs} bytes in a record of {length}'
        raise DamagedBagError(path, at, f'{finding}, expected channel {channel}')
    return np.frombuffer(data, '<u8', pairs // 8, at + size).reshape(pairs // _ENTRY, 2)


def most(data: Buffer, at: int) -> int:
    """Return how many messages there are at most by the index at a place; 0 outside the file."""
    if at + records.PREFIX.size > len(data):
        return 0
    length: int = records.PREFIX.unpack_from(data, at)[1]
    return min(length, len(data)) // _ENTRY
