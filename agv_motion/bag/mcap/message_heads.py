"""What stands before the data of each message in a chunk, many at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.bag.mcap import records

if TYPE_CHECKING:
    from collections.abc import Sequence

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
    places = np.asarray(offsets, np.intp)
    found = windows[places].view(form)
    lengths = found['length']
    shortest = form.itemsize - records.PREFIX.size
    wrong = (found['opcode'] != records.MESSAGE) | (lengths - shortest > len(unpacked))
    wrong |= places + lengths.astype(np.int64) > len(unpacked) - records.PREFIX.size
    if wrong.any():
        msg = f'no whole message at byte {int(places[int(wrong.argmax())])} of the content'
        raise ValueError(msg)
    return found


def headed(heads: NDArray[Any], data: Sequence[bytes]) -> tuple[list[bytes], NDArray[np.uint64]]:
    """Return heads and data in turn, as they are to lie in a chunk, and where each head begins.

    Args:
        heads: (n,) rows of ``HEAD``; opcode and length are filled in here.
        data: (n,) messages.

    """
    sizes = np.fromiter(map(len, data), np.uint64, len(data)) + np.uint64(HEAD.itemsize)
    heads['opcode'], heads['length'] = records.MESSAGE, sizes - np.uint64(records.PREFIX.size)
    packed, size = heads.tobytes(), HEAD.itemsize
    parts = [b''] * (2 * len(data))
    parts[::2] = [packed[i : i + size] for i in range(0, len(packed), size)]
    parts[1::2] = data
    return parts, np.cumsum(sizes) - sizes
