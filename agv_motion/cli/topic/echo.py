"""`agv topic echo`: the messages of a topic as text."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Annotated, Any

import typer
import yaml

from agv_motion.cli.graph.session import DISCOVERY, interface_class, joined, spin, topic_class
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
from agv_motion.cli.topic.options import SimTime, SpinTime, Topic, preset_qos
from agv_motion.errors import ConfigurationError


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
        no_arr=no_arr,
        no_str=no_str,
        flow_style=flow_style,
    )
    wanted = predicate(filter_expr)
    seen: list[None] = []

    def show(message: Any, about: Any) -> None:
        if once and seen:
            return
        part = part_of(message, field)
        if not wanted(part):
            return
        seen.append(None)
        if include_message_info and not csv:
            typer.echo(f'{yaml.dump(about)}---')
        if not is_message(part):
            typer.echo(f'{part}\n---')
        elif csv:
            before = ','.join(str(x) for x in about.values()) + ',' if include_message_info else ''
            typer.echo(before + text.csv(part))
        else:
            typer.echo(f'{text.yaml(part)}---')

    with joined(spin_time, use_sim_time=use_sim_time, endless=True) as node:
        kind = interface_class(message_type) if message_type else topic_class(node, topic_name)
        offered = [end.qos_profile for end in node.get_publishers_info_by_topic(topic_name)]
        qos = _subscriber_qos(qos_profile, qos_depth, qos_reliability, qos_durability, offered)
        node.create_subscription(
            kind, topic_name, show, qos, raw=raw, event_callbacks=_lost_events(no_lost_messages)
        )
        end = time.monotonic() + timeout if timeout else float('inf')
        spin(node, lambda: (once and bool(seen)) or time.monotonic() > end)


def predicate(expression: str) -> Callable[[Any], bool]:
    """Return a test of a message from the user's own Python expression.

    Raises:
        ConfigurationError: The expression is none, or (by the test) it fails on a message.

    """
    if not expression:
        return lambda _: True
    try:
        code = compile(expression, '--filter', 'eval')
    except (SyntaxError, ValueError) as error:
        msg = f"--filter '{expression}' is no Python expression: {error}"
        raise ConfigurationError(msg) from error

    def test(message: Any) -> bool:
        try:
            return bool(eval(code, {'m': message}))  # noqa: S307 - as in ros2: the user's own words
        except Exception as error:
            msg = f"--filter '{expression}': {error} (m is a {type(message).__name__})"
            raise ConfigurationError(msg) from error

    return test


def part_of(message: Any, field: str) -> Any:
    """Return what a path such as ``pose.position`` leads to; '' is the message itself.

    Raises:
        ConfigurationError: There is no such field.

    """
    for name in filter(None, field.split('.')):
        if not hasattr(message, name):
            msg = f"Invalid field '{field}': {type(message).__name__} has no field '{name}'"
            if is_message(message):
                msg += f'; it has {", ".join(message.get_fields_and_field_types())}'
            raise ConfigurationError(msg)
        message = getattr(message, name)
    return message


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
