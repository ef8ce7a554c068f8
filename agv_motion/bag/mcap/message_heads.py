"""What stands before the data of each message in a chunk, many at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.bag.mcap import records

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from agv_motion.bag.mcap.record_parsing import Buffer

HEAD = np.dtype(
    [
        *(('opcode', 'u1'), ('length', '<u8'), ('channel', '<u2'), ('sequence', '<u4')),
        *(('stamp', '<u8'), ('publish', '<u8')),
    ]
)
"""What stands before the data of a message."""


def heads(unpacked: Buffer, offsets: NDArray[Any], form: np.dtype[Any] = HEAD) -> NDArray[Any]:
    """Return the heads of the messages that lie at ``offsets``, as structured rows.

    Raises:
        ValueError: An offset lies outside, or there is no whole message.

    """
    room = len(unpacked) - form.itemsize + 1
    if not len(offsets):
        return np.empty(0, form)
    if room < 1 or int(offsets.max()) >= room:
        msg = f'a message at byte {int(offsets.max())} of a content of {len(unpacked)}'
        raise ValueError(msg)
    raw = np.dtype((np.void, form.itemsize))
    windows = np.ndarray((room,), raw, unpacked, strides=(1,))
    places = offsets.astype(np.intp, copy=False)
    found = windows[places].view(form)
    lengths = found['length']
    shortest = form.itemsize - records.PREFIX.size
    wrong = (found['opcode'] != records.MESSAGE) | (lengths - shortest > len(unpacked))
    wrong |= places + lengths.astype(np.int64) > len(unpacked) - records.PREFIX.size
    if wrong.any():
        msg = f'no whole message at byte {int(places[int(wrong.argmax())])} of the content'
        raise ValueError(msg)
    return found
