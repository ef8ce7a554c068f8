"""Functions of `math` over columns: the same bits as value by value, on every machine.

numpy's own sine and cosine differ from those of `math` in the last place, and among processors.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray


def elementwise(
    function: Callable[[float], float], column: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return ``function`` of each value, in an array of the same shape."""
    values = map(function, column.ravel().tolist())
    return np.fromiter(values, np.float64, column.size).reshape(column.shape)
