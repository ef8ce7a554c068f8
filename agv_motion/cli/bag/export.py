"""`agv bag export`: topics of a bag as tables, in CSV or Parquet."""

from __future__ import annotations

import os
from filecmp import cmp
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import track

from agv_motion.cli.bag.options import Bag, Duration, StartOffset, opened, readable, span
from agv_motion.cli.terminal import terminal
from agv_motion.errors import ConfigurationError
from agv_motion.files.unfinished import hidden_folder, told


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
    from agv_motion.bag.columns.table_files import file_names, write_csv, write_parquet

    console = terminal(stderr=True)
    writers = {'csv': write_csv, 'parquet': write_parquet}
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
