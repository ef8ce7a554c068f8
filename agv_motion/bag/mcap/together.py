"""Messages that are written together, as columns."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from agv_motion.bag.mcap.records import MESSAGE_HEAD

if TYPE_CHECKING:
    from collections.abc import Sequence

FEW = 256
"""Messages of a chunk that are written one by one: a short chunk is not worth columns."""


class Together:
    """Messages by columns."""

    def __init__(
        self, channels: Sequence[int], stamps: Sequence[int], data: Sequence[bytes]
    ) -> None:
        """Keep (n,) channels, log times [ns] and messages."""
        self.data = data
        self.channels = np.array(channels, np.uint16)
        self.stamps = np.array(stamps, np.uint64)
        sizes = np.fromiter(map(len, data), np.int64, len(data)) + MESSAGE_HEAD.size
        self.ends = np.cumsum(sizes)
        """[bytes] where each would end, were all in one chunk"""
        self.begins = self.ends - sizes
        """[bytes] where each would begin"""

    def first_from(self, first: int, last: int, time: float) -> int:
        """Return the first place from ``first`` on whose stamp is ``time`` or later, else ``last``.

        Ever longer pieces are looked at: a short chunk costs no look at all the messages after it.
        """
        piece = FEW
        while first < last and time < 2**64:
            late = self.stamps[first : min(first + piece, last)] >= np.uint64(time)
            if late.any():
                return first + int(late.argmax())
            first, piece = first + piece, 2 * piece
        return last
