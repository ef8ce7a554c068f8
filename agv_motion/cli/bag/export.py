"""`agv bag export`: topics of a bag as tables, in CSV or Parquet."""

from __future__ import annotations

import csv
import json
import os
import re
from collections import Counter
from filecmp import cmp
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from rich.progress import track

from agv_motion.cli.bag.options import Bag, Duration, StartOffset, opened, readable, span
from agv_motion.cli.terminal import terminal
from agv_motion.errors import ConfigurationError
from agv_motion.files.unfinished import hidden_folder, told

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from agv_motion.bag.columns.column import Column
    from agv_motion.bag.columns.columns import Columns

MOST_COLUMNS = 64
"""Longer arrays stay in one cell."""
LONGEST_NAME = 150
"""Characters of the name of a file before its suffix; most file systems allow 255."""
_UNFIT = re.compile(r'[^A-Za-z0-9_.+~-]')
_BLOCK = 10_000


def export(
    bag: Bag,
    output: Annotated[Path, typer.Argument(help='Folder for the tables, one per topic.')],
    *,
    topics: Annotated[
        list[str] | None, typer.Option(help='Export only this; one per option.')
    ] = None,
    field: Annotated[
        list[str] | None, typer.Option(help='Only this field of each; one per option.')
    ] = None,
    table: Annotated[str, typer.Option('--format', '-f', help='csv or parquet.')] = 'csv',
    start_offset: StartOffset = 0.0,
    duration: Duration = -1.0,
) -> None:
    """Write topics as tables: a row a message, a column a field, log_time [ns] first.

    Arrays of constant length take a column for each element; others stay in one cell, as JSON in
    CSV and as a list in Parquet, which needs pip install "agv_motion[parquet]". Tables appear when
    all are whole; nothing is overwritten, and the same again is left as it is. Examples:

    agv bag export walk tables

    agv bag export walk tables --topics /odom --field header.stamp --field pose.pose -f parquet
    """
    from agv_motion.bag.columns.columns import read_topic

    console = terminal(stderr=True)
    writers = {'csv': _csv, 'parquet': _parquet}
    if table not in writers:
        msg = f"--format '{table}': choose csv or parquet"
        raise ConfigurationError(msg)
    with opened(bag) as reader:
        limits = span(reader, start_offset, duration)
        reader.require(topics or ())
        chosen = list(dict.fromkeys(topics or sorted(reader.topics)))
        names = file_names(reader.topics)
        paths = {topic: output / f'{names[topic]}.{table}' for topic in chosen}
        with told(output):
            output.mkdir(parents=True, exist_ok=True)
        rows: dict[Path, int] = {}
        with hidden_folder(output / table) as folder:
            found = readable(reader, chosen, lambda t: read_topic(reader, t, field, *limits))
            for topic, columns in track(
                found, 'Exporting', total=len(chosen), console=console, transient=True
            ):
                path = paths[topic]
                with told(path):
                    writers[table](folder / path.name, columns)
                _is_there(path, folder / path.name)
                rows[path] = len(columns.stamps)
            notes = [_put(path, folder / path.name) for path in rows]
        for (path, count), note in zip(rows.items(), notes, strict=True):
            typer.echo(f'{path}: {count} rows{note}')


def _put(path: Path, made: Path) -> str:
    """Move a table to its place, unless it is there already; return a note of that."""
    if _is_there(path, made):
        return ', there already'
    with told(path):
        made.rename(path)
    return ''


def _is_there(path: Path, made: Path) -> bool:
    """Return whether the same was made before: an earlier run may have been ended.

    Raises:
        ConfigurationError: Something else is there.

    """
    if not os.path.lexists(path):
        return False
    if path.is_file() and cmp(path, made, shallow=False):
        return True
    msg = f'{path} exists, with other content: choose another folder, nothing is overwritten'
    raise ConfigurationError(msg)


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


def _csv(path: Path, columns: Columns) -> None:
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


def _parquet(path: Path, columns: Columns) -> None:
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError as error:
        msg = 'Parquet needs pyarrow: pip install "agv_motion[parquet]"'
        raise ConfigurationError(msg) from error
    found = {
        name: column if isinstance(column, np.ndarray) and column.ndim == 1 else column.tolist()
        for name, column in _cells(columns)
    }
    parquet.write_table(pa.table(found), path)
