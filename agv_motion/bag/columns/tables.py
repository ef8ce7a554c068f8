"""Columns as tables of pandas and of Arrow, neither of which need be installed.

Log times beyond the year 2262, which no time of theirs can hold, stay whole numbers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.bag.columns.column import Ragged, Texts
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray
    from pandas import DataFrame
    from pyarrow import Array, Table

    from agv_motion.bag.columns.column import Column


def to_pandas(stamps: NDArray[Any], fields: Mapping[str, Column]) -> DataFrame:
    """Return fields as a DataFrame by their log time.

    Args:
        stamps: [ns] log time of each message.
        fields: Values by the path of the field.

    Raises:
        ConfigurationError: pandas is not installed.

    """
    try:
        import pandas as pd  # noqa: PLC0415 - optional
    except ImportError as error:
        msg = 'to_pandas() needs pandas: pip install pandas'
        raise ConfigurationError(msg) from error
    index = pd.Index(stamps, name='log_time')
    if stamps.dtype == np.int64:
        index = pd.DatetimeIndex(stamps.view('M8[ns]'), tz='UTC', name='log_time')
    return pd.DataFrame({path: _cells(column) for path, column in fields.items()}, index)


def _cells(column: Column) -> NDArray[Any]:
    """Return one cell a message."""
    if isinstance(column, Texts) and len(column.shape) == 1:
        return column.numpy()
    if isinstance(column, np.ndarray) and column.ndim == 1:
        return column
    cells = np.empty(len(column), object)
    for i, row in enumerate(column):
        cells[i] = row if isinstance(row, np.ndarray) else row.tolist()
    return cells


def to_arrow(stamps: NDArray[Any], fields: Mapping[str, Column]) -> Table:
    """Return fields as an Arrow table, `log_time` first.

    Args:
        stamps: [ns] log time of each message.
        fields: Values by the path of the field.

    Raises:
        ConfigurationError: pyarrow is not installed.

    """
    try:
        import pyarrow as pa  # noqa: PLC0415 - optional
    except ImportError as error:
        msg = 'to_arrow() needs pyarrow: pip install "agv_motion[parquet]"'
        raise ConfigurationError(msg) from error
    times = pa.array(stamps)
    if stamps.dtype == np.int64:
        times = times.cast(pa.timestamp('ns', 'UTC'))
    return pa.table({'log_time': times} | {path: _array(pa, c) for path, c in fields.items()})


def _array(pa: Any, column: Column) -> Array:
    """Return an Arrow array; arrays in a message are lists, of one length where all have it."""
    if isinstance(column, Ragged):
        return pa.LargeListArray.from_arrays(pa.array(column.offsets), _array(pa, column.values))
    if isinstance(column, Texts):
        flat = pa.array(column.values, pa.string()).take(pa.array(column.codes.ravel()))
    else:
        flat = pa.array(np.ascontiguousarray(column).ravel())
    for level in range(len(column.shape) - 1, 0, -1):
        size = column.shape[level]
        if size:
            flat = pa.FixedSizeListArray.from_arrays(flat, size)
        else:  # nothing tells how many empty lists there are but their offsets
            none = np.zeros(int(np.prod(column.shape[:level])) + 1, np.int64)
            flat = pa.LargeListArray.from_arrays(pa.array(none), flat)
    return flat
