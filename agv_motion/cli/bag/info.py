"""`agv bag info`: what is in a bag, in the form of `ros2 bag info`."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.cli.bag.options import Bag, moment, opened
from agv_motion.visible import in_line

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.bag.events.event import Event
    from agv_motion.bag.quality_of_service import OfferedQos
    from agv_motion.bag.reader import BagReader

_UNITS = ('B', 'KiB', 'MiB', 'GiB', 'TiB')


def info(
    bag: Bag,
    *,
    topic_name: Annotated[
        bool, typer.Option('-t', '--topic-name', help='Only the names of the topics.')
    ] = False,
    verbose: Annotated[
        bool, typer.Option('-v', '--verbose', help='Quality of service and rates as well.')
    ] = False,
) -> None:
    """Tell what is in a bag: files, times, topics with their types and counts.

    Example: agv bag info walk
    """
    with opened(bag, validate=False) as reader:
        if topic_name:
            typer.echo('\n'.join(map(in_line, sorted(reader.topics))))
            return
        _head(reader)
        _topics(reader, verbose=verbose)
        _notes(bag)


def _head(bag: BagReader) -> None:
    from agv_motion.bag.completeness import completeness, together
    from agv_motion.bag.events.event import events_of

    files = [file.path for file in bag.files]
    length = (bag.end - bag.start) * 1e-9
    rows = {
        'Files': '\n                   '.join(in_line(path.name) for path in files),
        'Bag size': _size(sum(path.stat().st_size for path in files)),
        'Storage id': 'sqlite3' if bag.files[0].as_chunks() is None else 'mcap',
        'Duration': f'{length:.9f}s',
        'Start': moment(bag.start),
        'End': moment(bag.end),
        'Messages': str(bag.message_count),
    }
    told = completeness(bag)
    if told:
        rows['Recording'] = str(together(told))
    if events := events_of(bag):
        rows['Event'] = '\n                   '.join(map(_told, events))
    for title, text in rows.items():
        typer.echo(f'{title + ":":<19}{text}')


def _told(event: Event) -> str:
    others = len(event.moments) + event.more - 1
    more = f' and {others} more' if others else ''
    short = f'; cut short: {in_line(event.cut_short)}' if event.cut_short else ''
    return f'{in_line(event.first.reason)}{more}, {moment(event.first.stamp)}{short}'


def _topics(bag: BagReader, *, verbose: bool) -> None:
    length = (bag.end - bag.start) * 1e-9
    title = 'Topic information:'
    counts: Counter[tuple[str, str, str]] = Counter()
    profiles: dict[tuple[str, str, str], dict[OfferedQos, None]] = {}
    for connection, count in bag.connection_counts.items():
        one = connection.topic, connection.type, connection.encoding
        counts[one] += count
        profiles.setdefault(one, {}).update(dict.fromkeys(connection.qos))
    for one, count in sorted(counts.items()):
        topic, kind, encoding = one
        row = (
            f'{title:<19}Topic: {topic} | Type: {kind} | Count: {count} | '
            f'Serialization Format: {encoding}'
        )
        if verbose:
            row += f' | {count / length if length else 0.0:.2f} Hz'
            row += ''.join(
                f' | QoS: {qos.reliability}, {qos.durability}, depth {qos.depth}'
                for qos in profiles[one]
            )
        typer.echo(in_line(row))
        title = ''


def _notes(bag: Path) -> None:
    from agv_motion.bag.notes import notes_of

    title = 'Notes:'
    for note in notes_of(bag):
        typer.echo(f'{title:<19}{moment(note.stamp)}: {in_line(note.text)}')
        title = ''


def _size(size: float) -> str:
    for unit in _UNITS:
        if size < 1024 or unit == _UNITS[-1]:
            break
        size /= 1024
    return f'{size:.0f} {unit}' if unit == 'B' else f'{size:.1f} {unit}'
