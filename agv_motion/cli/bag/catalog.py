"""`agv bag index`, `find` and `stats`: a folder of hundreds of bags."""

from __future__ import annotations

import json
from contextlib import closing, contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.progress import Progress

from agv_motion.cli.bag.many import Scheduler, Workers
from agv_motion.cli.bag.options import moment
from agv_motion.cli.terminal import LineTable, terminal
from agv_motion.errors import ConfigurationError
from agv_motion.visible import indented

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from agv_motion.bag.catalog.entry import BagEntry
    from agv_motion.bag.catalog.find import FoundBag
    from agv_motion.bag.catalog.index import BagIndex, IndexReport
    from agv_motion.bag.catalog.statistics import Amount, TopicAmount

Folder = Annotated[Path, typer.Argument(help='Folder in which, or below which, bags lie.')]
Begin = Annotated[
    str, typer.Option('--from', help='Bags that reach beyond 2024-05-03, 2024-05-03T14:32, @1714.')
]
End = Annotated[str, typer.Option('--until', help='... and begin before this moment.')]
Json = Annotated[bool, typer.Option('--json', help='As JSON, times in ns since 1970.')]


def index(folder: Folder = Path(), *, workers: Workers = 1, scheduler: Scheduler = '') -> None:
    """Note what is in each bag of a folder, so that find and stats answer at once.

    Only bags that are new or have changed are read; find and stats do the same first. The index is
    one hidden file in the folder, .agv_bags.sqlite3, or in your cache where nothing can be written.
    For example:

    agv bag index season

    agv bag index season --workers 4
    """
    with _indexed(folder, workers, scheduler) as (found, report):
        done = f'{report.read} read, {report.gone} gone, {report.damaged} damaged'
        typer.echo(f'{report.bags} bags, {done}: {found.path}')
        for path, fault in found.ask("SELECT path, fault FROM bag WHERE fault != '' ORDER BY path"):
            typer.echo(f'damaged: {found.decoded(path)}: {indented(fault)}')


def find(
    folder: Folder = Path(),
    *,
    topic: Annotated[
        list[str] | None, typer.Option(help="With this topic; * for anything: '*/odom'.")
    ] = None,
    kind: Annotated[
        list[str] | None, typer.Option('--type', help='With a topic of this type; * for anything.')
    ] = None,
    begin: Begin = '',
    end: End = '',
    where: Annotated[
        str, typer.Option(help="In which this was met: '/turrets/residual > 0.02'.")
    ] = '',
    as_json: Json = False,
) -> None:
    """Find the bags in which something is, and with --where when.

    The status is 1 where there is none. For example:

    agv bag find season --topic /fix --from 2024-05

    agv bag find season --where '/state ~ stopped' --from 2024-05-03 --until 2024-05-04

    agv bag find season --type 'sensor_msgs/msg/*' --json
    """
    from agv_motion.bag.catalog.find import Question
    from agv_motion.bag.catalog.find import find as ask

    asked = Question(tuple(topic or ()), tuple(kind or ()), begin, end, where)
    with _indexed(folder) as (index_, _), _bar('Looking') as show:
        found = list(ask(index_, asked, show, _complain))
    if as_json:
        typer.echo(
            json.dumps([{**one._asdict(), 'path': str(one.path)} for one in found], indent=1)
        )
    else:
        _print(found)
    if not found:
        raise typer.Exit(1)


def stats(
    folder: Folder = Path(),
    *,
    begin: Begin = '',
    end: End = '',
    by: Annotated[str, typer.Option(help='day or month; a bag counts where it begins, UTC.')] = '',
    gap: Annotated[
        float, typer.Option(min=0, help='Seconds between two bags that are a gap.')
    ] = 60.0,
    as_json: Json = False,
) -> None:
    """Tell how much was recorded: bags, hours, messages, bytes, gaps; by topic, day or month.

    Bytes of topics are judged by some chunks of each bag. For example: agv bag stats season

    agv bag stats season --by month

    agv bag stats season --from 2024-05-01 --until 2024-06-01 --by day --json
    """
    from agv_motion.bag.catalog.find import Question
    from agv_motion.bag.catalog.statistics import Period, amounts, topic_amounts

    if by not in ('', *(period.value for period in Period)):
        msg = f"--by '{by}': choose day or month"
        raise ConfigurationError(msg)
    asked = Question(begin=begin, end=end)
    with _indexed(folder) as (found, report):
        rows = amounts(found, asked, Period(by) if by else None, gap)
        topics = topic_amounts(found, asked)
    if as_json:
        told = [[one._asdict() for one in each] for each in (rows, topics)]
        typer.echo(json.dumps({'amounts': told[0], 'topics': told[1]}, indent=1))
        return
    _print_amounts(rows, by or 'bags')
    if not by:
        _print_topics(topics)
    if report.damaged:
        typer.echo(f'note: {report.damaged} bags are damaged: agv bag index {folder} names them')


def _complain(text: str) -> None:
    typer.echo(f'error: {indented(text)}', err=True)


@contextmanager
def _indexed(
    folder: Path, workers: int = 1, scheduler: str = ''
) -> Iterator[tuple[BagIndex, IndexReport]]:
    """Yield the index of a folder, brought up to date under a bar."""
    from agv_motion.bag.catalog.index import BagIndex

    with BagIndex(folder) as found:
        with _bar('Indexing') as show:
            report = found.update(show, partial(_read, workers=workers, scheduler=scheduler))
        yield found, report


def _read(bags: list[Path], *, workers: int, scheduler: str) -> Iterator[tuple[Path, BagEntry]]:
    """Yield what is in each bag, as soon as it is known."""
    from agv_motion.bag.catalog.entry import EntryReading
    from agv_motion.ros.many_bags import outcomes

    pairs = [(path, path) for path in bags]
    with closing(outcomes(pairs, EntryReading(), workers, scheduler)) as coming:
        for one in coming:
            if one.entry is not None:
                yield Path(one.source), one.entry


@contextmanager
def _bar(doing: str) -> Iterator[Callable[[int, int], None]]:
    with Progress(console=terminal(stderr=True), transient=True) as progress:
        bar = progress.add_task(doing, total=None)
        yield lambda done, total: progress.update(bar, completed=done, total=total)


def _print(found: list[FoundBag]) -> None:
    table = _table('bag', 'begins', 'seconds', 'messages', 'bytes')
    for one in found:
        fault = f' (damaged: {one.fault})' if one.fault else ''
        length = f'{(one.end - one.start) * 1e-9:.1f}'
        table.add_row(
            f'{one.path}{fault}', moment(one.start), length, str(one.messages), str(one.size)
        )
        for start, end in one.spans:
            table.add_row(
                f'  {(start - one.start) * 1e-9:.3f} to {(end - one.start) * 1e-9:.3f} s',
                moment(start), f'{(end - start) * 1e-9:.1f}', '', '',
            )  # fmt: skip
    if found:
        terminal().print(table)
    typer.echo(f'{len(found)} bags', err=True)


def _print_amounts(rows: list[Amount], title: str) -> None:
    table = _table(title, 'bags', 'hours', 'messages', 'bytes', 'gaps', 'longest gap')
    for one in rows:
        table.add_row(
            one.name, str(one.bags), f'{one.seconds / 3600:.2f}', str(one.messages), str(one.size),
            str(one.gaps), f'{one.longest_gap:.0f} s' if one.gaps else '',
        )  # fmt: skip
    terminal().print(table)


def _print_topics(topics: list[TopicAmount]) -> None:
    table = _table('topic', 'type', 'bags', 'hours', 'messages', 'Hz', 'bytes, about')
    for one in topics:
        rate = f'{one.messages / one.seconds:.2f}' if one.seconds else ''
        table.add_row(
            one.name, one.type, str(one.bags), f'{one.seconds / 3600:.2f}', str(one.messages),
            rate, '' if one.size is None else f'{one.size:.0f}',
        )  # fmt: skip
    terminal().print(table)


def _table(*titles: str) -> LineTable:
    table = LineTable()
    for title in titles:
        left = title in ('bag', 'begins', 'topic', 'type', 'day', 'month', 'bags')
        table.add_column(title, justify='left' if left else 'right', overflow='fold')
    return table
