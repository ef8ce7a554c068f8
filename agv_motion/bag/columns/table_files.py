"""Columns of a topic as a file of rows: CSV, or Parquet."""

from __future__ import annotations

import csv
import json
import re
from collections import Counter
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import numpy as np

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from agv_motion.bag.columns.column import Column
    from agv_motion.bag.columns.columns import Columns

MOST_COLUMNS = 64
"""Longer arrays stay in one cell."""
LONGEST_NAME = 150
"""Characters of the name of a file before its suffix; most file systems allow 255."""
_UNFIT = re.compile(r'[^A-Za-z0-9_.+~-]')
_BLOCK = 10_000


def file_names(topics: Iterable[str]) -> dict[str, str]:
    """Return a file name for each topic: as like it as can be, no two alike, none too long."""
    plain = {topic: topic.strip('/').replace('/', '__') for topic in topics}
    counts = Counter(name.lower() for name in plain.values())
    names = {}
    for topic, name in plain.items():
        kept = _UNFIT.sub('_', name)[:LONGEST_NAME]
        if kept != name or not name.strip('.') or counts[name.lower()] > 1:
            kept = f'{kept}_{sha256(topic.encode(errors="surrogateescape")).hexdigest()[:8]}'
        names[topic] = kept
    return names


def _cells(columns: Columns) -> Iterator[tuple[str, Column]]:
    """Yield name and values of every column of the table."""
    yield 'log_time', columns.stamps
    for path, column in columns.fields.items():
        shape: tuple[int, ...] = getattr(column, 'shape', ())
        if len(shape) == 1:
            yield path, column
        elif len(shape) == 2 and shape[1] <= MOST_COLUMNS:
            for i in range(shape[1]):
                yield f'{path}[{i}]', column[:, i]
        else:
            yield path, column


def write_csv(path: Path, columns: Columns) -> None:
    """Write columns as CSV; a list in a cell as JSON."""
    names, cells = zip(*_cells(columns), strict=True)
    with path.open('w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file)
        writer.writerow(names)
        for first in range(0, len(columns.stamps), _BLOCK):
            block = [_text(cell[first : first + _BLOCK]) for cell in cells]
            writer.writerows(zip(*block, strict=True))


def _text(column: Column) -> list[Any]:
    """Return cells; whatever is in a cell, if it is a list, as JSON."""
    values: list[Any] = column.tolist()
    return [json.dumps(v) if isinstance(v, list) else v for v in values]


def write_parquet(path: Path, columns: Columns) -> None:
    """Write columns as Parquet.

    Raises:
        ConfigurationError: pyarrow is not installed.

    """
    try:
        import pyarrow as pa  # noqa: PLC0415 - it need not be there
        from pyarrow import parquet  # noqa: PLC0415
    except ImportError as error:
        msg = 'Parquet needs pyarrow: pip install "agv_motion[parquet]"'
        raise ConfigurationError(msg) from error
    found = {
        name: column if isinstance(column, np.ndarray) and column.ndim == 1 else column.tolist()
        for name, column in _cells(columns)
    }
    parquet.write_table(pa.table(found), path)
