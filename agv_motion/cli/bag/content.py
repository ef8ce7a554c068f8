"""`agv bag list` and `agv bag du`: what is attached to a bag, and what takes its space."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from agv_motion.cli.bag.options import Bag, moment, opened
from agv_motion.cli.terminal import LineTable, terminal
from agv_motion.errors import ConfigurationError
from agv_motion.visible import in_line


def contents(
    bag: Bag,
    *,
    extract: Annotated[
        Path | None, typer.Option(help='Write the attachments into this new folder.')
    ] = None,
) -> None:
    """List attachments, metadata and notes of a bag.

    For example: agv bag list walk

    agv bag list walk --extract calibrations
    """
    from agv_motion.bag.damage import DamagedBagError
    from agv_motion.bag.mcap.records import Attachment
    from agv_motion.bag.notes import notes_of
    from agv_motion.files.unfinished import beside, told

    attached: list[Attachment] = []
    with opened(bag, validate=False) as reader:
        for extra in (extra for file in reader.files for extra in file.extras()):
            if isinstance(extra, DamagedBagError):
                raise extra
            if isinstance(extra, Attachment):
                about = f'{in_line(extra.media_type) or "unknown type"}, {len(extra.data)} bytes'
                typer.echo(f'attachment {in_line(extra.name)}: {about}, {moment(extra.log_time)}')
                attached.append(extra)
            elif extra.name != 'rosbag2':
                typer.echo(f'metadata {in_line(extra.name)}:')
                for key, value in extra.entries.items():
                    typer.echo(f'  {in_line(key)}: {in_line(value)}')
        for note in notes_of(bag):
            typer.echo(f'note {moment(note.stamp)}: {in_line(note.text)}')
    if extract is None:
        return
    names = [Path(one.name.replace('\0', '')).name for one in attached]
    if not names or len(set(names)) < len(names) or not all(names):
        msg = f'{bag} attaches {", ".join(names) or "nothing"}: expected some, of different names'
        raise ConfigurationError(msg)
    with beside(extract) as folder, told(extract):
        folder.mkdir()
        for name, one in zip(names, attached, strict=True):
            (folder / name).write_bytes(one.data)
    typer.echo(f'{extract}: {len(names)} attachments')


def du(bag: Bag) -> None:
    """Tell what takes the space in a bag: bytes of each topic, and as they are compressed.

    The share of a topic in a compressed chunk is taken as its share in the chunk unpacked. In MCAP
    the indexes tell that, and nothing is unpacked. Example: agv bag du walk
    """
    from agv_motion.bag.checks.sizes import sizes

    table = LineTable()
    for title in ('topic', 'messages', 'bytes', 'mean', 'stored, about', 'share'):
        table.add_column(title, justify='left' if title == 'topic' else 'right', overflow='fold')
    with opened(bag, validate=False) as reader:
        found = sizes(reader)
        total = sum(one.stored for one in found.values()) or 1.0
        for topic, one in sorted(found.items(), key=lambda item: -item[1].stored):
            count = reader.counts[topic]
            table.add_row(
                topic, str(count), str(one.size), f'{one.size / count:.0f}' if count else '',
                f'{one.stored:.0f}', f'{100 * one.stored / total:.1f} %',
            )  # fmt: skip
        terminal().print(table)
