"""Messages of one channel that lie in one buffer: what columns are decoded from."""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

    from agv_motion.bag.mcap.record_parsing import Buffer


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
