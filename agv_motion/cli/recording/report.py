"""`agv report`: a day of the robots as one HTML file."""

from __future__ import annotations

from contextlib import ExitStack
from datetime import date, datetime, time, timedelta, timezone
from pathlib import Path
from typing import TYPE_CHECKING, Annotated
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

import typer

from agv_motion.cli.bag.options import opened
from agv_motion.errors import ConfigurationError, SourceError

if TYPE_CHECKING:
    from agv_motion.bag.reader import BagReader

NS = 1_000_000_000


def report(
    day: Annotated[str, typer.Argument(help='A day, such as 2026-11-30, or a bag.')],
    *,
    out: Annotated[
        Path | None, typer.Option('--out', '-o', help='File; else beside the bag, by its day.')
    ] = None,
    bags: Annotated[Path, typer.Option(help='Folder in which the bags of a day lie.')] = Path(),
    time_zone: Annotated[str, typer.Option(help='Of the day and its times, by IANA name.')] = 'UTC',
) -> None:
    """Write where the robots went in a day, what they drank, why they stood, alerts and probes.

    The file needs nothing else: no network, no other file. For example:

    agv report 2026-11-30 --bags ~/bags --time-zone Europe/Paris

    agv report demo_output/bag -o walk.html
    """
    from agv_motion.files.unfinished import replacing
    from agv_motion.report.daily import read_day
    from agv_motion.report.daily_page import page

    zone = _zone(time_zone)
    given = _day(day)
    begin, end = (None, None) if given is None else _limits(given, zone)
    paths = [Path(day)] if given is None else _bags(bags, begin or 0, end or 0, day)
    with ExitStack() as stack:
        readers: list[BagReader] = [stack.enter_context(opened(path)) for path in paths]
        found = read_day(sorted(readers, key=lambda bag: bag.start), begin, end)
        first = datetime.fromtimestamp(found.begin, timezone.utc).astimezone(zone)
        target = out or paths[0].resolve().parent / f'report_{first:%Y-%m-%d}.html'
        text = page(found, paths, time_zone)
        with replacing(target) as made:
            made.write_text(text, encoding='utf-8')
        typer.echo(f'Report: {target}')


def _day(text: str) -> date | None:
    """Return the day that a text tells; None if it tells none."""
    try:
        return date.fromisoformat(text)
    except ValueError:
        return None


def _zone(name: str) -> ZoneInfo:
    try:
        return ZoneInfo(name)
    except (ZoneInfoNotFoundError, ValueError, OSError) as error:
        msg = f"--time-zone '{name}': give an IANA name such as Europe/Paris"
        raise ConfigurationError(msg) from error


def _limits(day: date, zone: ZoneInfo) -> tuple[int, int]:
    """Return beginning and end of a day [ns since 1970]."""
    begin, end = (
        int(datetime.combine(each, time(), zone).timestamp()) * NS
        for each in (day, day + timedelta(days=1))
    )
    return begin, end


def _bags(folder: Path, begin: int, end: int, day: str) -> list[Path]:
    """Return the bags of a folder that hold something of a day, with those that cannot be read.

    Raises:
        SourceError: There is none.

    """
    from agv_motion.bag.reader import BagReader

    found, seen = [], 0
    whole = (folder / 'metadata.yaml').is_file()
    inside = sorted(folder.iterdir()) if folder.is_dir() else []
    for path in [folder] if whole else filter(_is_bag, inside):
        seen += 1
        try:
            with BagReader(path, validate=False) as bag:
                if bag.start < end and bag.end >= begin:
                    found.append(path)
        except SourceError as error:
            typer.echo(f'warning: left out: {error}', err=True)
    if not found:
        msg = f'no bag of {day} among {seen} in {folder.resolve()}: give --bags, or name a bag'
        raise SourceError(msg)
    return found


def _is_bag(path: Path) -> bool:
    if path.is_dir():
        return (path / 'metadata.yaml').is_file() or any(path.glob('*.mcap'))
    return path.suffix in {'.mcap', '.db3'}
