"""`agv topic echo`: the messages of a topic as text."""

from __future__ import annotations

import time
from typing import Annotated, Any

import typer

from agv_motion.cli.graph.discovery import DISCOVERY
from agv_motion.cli.graph.options import SimTime, SpinTime
from agv_motion.cli.graph.session import full_name, interface_class, joined, spin, topic_class
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
from agv_motion.cli.topic.options import Topic, preset_qos


def echo(
    topic_name: Topic,
    message_type: Annotated[str, typer.Argument(help='Type, if the topic is not there yet.')] = '',
    *,
    qos_profile: Annotated[str, typer.Option(help='Preset to subscribe with.')] = 'sensor_data',
    qos_depth: Annotated[int, typer.Option(help='Queue size.')] = 0,
    qos_reliability: Annotated[str, typer.Option(help='reliable or best_effort.')] = '',
    qos_durability: Annotated[str, typer.Option(help='volatile or transient_local.')] = '',
    csv: Csv = False,
    field: Field = '',
    full_length: FullLength = False,
    truncate_length: TruncateLength = 128,
    no_arr: NoArrays = False,
    no_str: NoStrings = False,
    flow_style: FlowStyle = False,
    no_lost_messages: Annotated[
        bool, typer.Option('--no-lost-messages', help='Do not report lost messages.')
    ] = False,
    raw: Annotated[bool, typer.Option('--raw', help='The bytes as they come.')] = False,
    filter_expr: Filter = '',
    once: Once = False,
    timeout: Annotated[float, typer.Option(help='Stop after so many seconds.', min=0.0)] = 0.0,
    include_message_info: MessageInfo = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
) -> None:
    """Print the messages of a topic.

    Examples: agv topic echo /cmd_vel --once
              agv topic echo /odom --field pose.pose.position --csv
    """
    text = MessageText(
        None if full_length else truncate_length,
        no_arr=no_arr, no_str=no_str, flow_style=flow_style,
    )  # fmt: skip
    printer = MessagePrinter(
        text, csv=csv, field=field, filter_expr=filter_expr, info=include_message_info
    )
    seen: list[None] = []

    def show(message: Any, about: Any) -> None:
        if not (once and seen) and printer.show(message, about):
            seen.append(None)

    with joined(spin_time, use_sim_time=use_sim_time, endless=True) as node:
        full_name(node, topic_name)  # an impossible one is refused in words
        kind = interface_class(message_type) if message_type else topic_class(node, topic_name)
        offered = [end.qos_profile for end in node.get_publishers_info_by_topic(topic_name)]
        qos = _subscriber_qos(qos_profile, qos_depth, qos_reliability, qos_durability, offered)
        node.create_subscription(
            kind, topic_name, show, qos, raw=raw, event_callbacks=_lost_events(no_lost_messages)
        )
        end = time.monotonic() + timeout if timeout else float('inf')
        spin(node, lambda: (once and bool(seen)) or time.monotonic() > end)


def _lost_events(silent: bool) -> Any:  # noqa: FBT001 - one option of the command
    from rclpy.event_handler import SubscriptionEventCallbacks

    def lost(status: Any) -> None:
        typer.echo(
            f'A message was lost!!!\n\ttotal count change:{status.total_count_change}'
            f'\n\ttotal count: {status.total_count}\n---'
        )

    return None if silent else SubscriptionEventCallbacks(message_lost=lost)


def _subscriber_qos(
    preset: str, depth: int, reliability: str, durability: str, offered: list[Any]
) -> Any:
    """Return the profile asked for, or one that connects to all publishers."""
    from rclpy.qos import DurabilityPolicy, ReliabilityPolicy

    qos = preset_qos(preset, depth, reliability, durability)
    if offered and not reliability:
        reliable = all(o.reliability is ReliabilityPolicy.RELIABLE for o in offered)
        qos.reliability = ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT
    if offered and not durability:
        latched = all(o.durability is DurabilityPolicy.TRANSIENT_LOCAL for o in offered)
        qos.durability = DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE
    return qos
