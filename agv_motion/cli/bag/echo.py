"""`agv bag echo`: the messages of a topic of a bag as text, with the words of `ros2 topic echo`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.cli.bag.options import Bag, Duration, StartOffset, moment, opened, span
from agv_motion.cli.topic.echo_options import (
    Csv,
    Field,
    Filter,
    FlowStyle,
    FullLength,
    MessageInfo,
    NoArrays,
    NoStrings,
    Once,
    TruncateLength,
)
from agv_motion.cli.topic.message_printer import MessagePrinter
from agv_motion.cli.topic.message_text import MessageText
from agv_motion.visible import in_line

if TYPE_CHECKING:
    from pathlib import Path


def echo(
    bag: Bag,
    topic_name: Annotated[str, typer.Argument(help="Name of the topic, such as '/cmd_vel'.")],
    *,
    csv: Csv = False,
    field: Field = '',
    full_length: FullLength = False,
    truncate_length: TruncateLength = 128,
    no_arr: NoArrays = False,
    no_str: NoStrings = False,
    flow_style: FlowStyle = False,
    filter_expr: Filter = '',
    once: Once = False,
    include_message_info: MessageInfo = False,
    start_offset: StartOffset = 0.0,
    duration: Duration = -1.0,
) -> None:
    """Print the messages of a topic.

    Types that are not installed here are understood too: their definition is in the bag. Examples:

    agv bag echo walk /cmd_vel --once

    agv bag echo walk /odom --field pose.pose.position --csv --start-offset 60
    """
    from agv_motion.bag.message_objects import decoder

    text = MessageText(
        None if full_length else truncate_length,
        no_arr=no_arr, no_str=no_str, flow_style=flow_style,
    )  # fmt: skip
    printer = MessagePrinter(
        text, csv=csv, field=field, filter_expr=filter_expr, info=include_message_info
    )
    with opened(bag) as reader:
        reader.require([topic_name])
        decoders = {c: decoder(c, bag) for c in reader.connections if c.topic == topic_name}
        limits = span(reader, start_offset, duration)
        notes = _Notes(bag, limits[0] or reader.start, aside=csv or bool(filter_expr))
        for message in reader.messages([topic_name], *limits):
            notes.show(message.stamp)
            about = {
                'source_timestamp': message.publish,
                'received_timestamp': message.stamp,
                'publication_sequence_number': message.sequence,
            }
            if printer.show(decoders[message.connection](message), about) and once:
                break
        else:
            notes.show(reader.end if limits[1] is None else limits[1])


class _Notes:
    """Shows notes between the messages, as comments of YAML; aside where a program may read on."""

    def __init__(self, bag: Path, start: int, *, aside: bool) -> None:
        from agv_motion.bag.notes import notes_of

        self._left = [note for note in notes_of(bag) if note.stamp >= start]
        self._aside = aside

    def show(self, stamp: int) -> None:
        """Show those up to a log time [ns]."""
        while self._left and self._left[0].stamp <= stamp:
            note = self._left.pop(0)
            typer.echo(f'# {moment(note.stamp)}: {in_line(note.text)}', err=self._aside)
