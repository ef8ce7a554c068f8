"""`agv bag echo`: the messages of a topic of a bag as text, with the words of `ros2 topic echo`."""

from __future__ import annotations

from itertools import islice
from typing import Annotated, Any

import typer
import yaml

from agv_motion.cli.bag.options import Bag, Duration, StartOffset, opened, span
from agv_motion.cli.topic.echo import part_of, predicate
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
from agv_motion.cli.topic.message_text import MessageText, is_message


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

    length = None if full_length else truncate_length
    text = MessageText(length, no_arr=no_arr, no_str=no_str, flow_style=flow_style)
    wanted = predicate(filter_expr)
    with opened(bag) as reader:
        reader.require([topic_name])
        decoders = {c: decoder(c, bag) for c in reader.connections if c.topic == topic_name}
        messages = reader.messages([topic_name], *span(reader, start_offset, duration))
        pairs = ((m, part_of(decoders[m.connection](m), field)) for m in messages)
        chosen = (pair for pair in pairs if wanted(pair[1]))
        for message, part in islice(chosen, 1 if once else None):
            about = {
                'source_timestamp': message.publish,
                'received_timestamp': message.stamp,
                'publication_sequence_number': message.sequence,
            }
            _show(part, about if include_message_info else {}, text, csv=csv)


def _show(part: Any, about: dict[str, int], text: MessageText, *, csv: bool) -> None:
    if csv:
        values = text.csv(part) if is_message(part) else str(part)
        typer.echo(','.join([*map(str, about.values()), values]))
        return
    if about:
        typer.echo(f'{yaml.dump(about, sort_keys=False)}---')
    typer.echo(f'{text.yaml(part)}---' if is_message(part) else f'{part}\n---')
