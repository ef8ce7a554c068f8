"""Whether all rows of a table are the same, bit by bit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

_PIECE = 1 << 17
"""[bytes] that are compared at once: they stay in the cache of a processor."""


def repeats(table: NDArray[Any], row: bytes) -> bool:
    """Return whether every row of ``table``, of shape (rows, values), has the bytes ``row``."""
    if table[-1:].tobytes() != row:
        return False
    count = min(max(_PIECE // max(len(row), 1), 1), len(table))
    rows = row * count
    return all(
        rows.startswith(table[first : first + count].tobytes())
        for first in range(0, len(table), count)
    )
