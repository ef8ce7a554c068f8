"""`agv topic`: the words, options and output of `ros2 topic`, for a machine without it."""

from __future__ import annotations

import time
from collections.abc import Callable  # noqa: TC003 - typer reads annotations at run time
from typing import Annotated, Any

import typer
import yaml

from agv_motion.cli import topic_rates
from agv_motion.cli.graph import (
    DISCOVERY,
    interface_class,
    joined,
    require_topic,
    spin,
    topic_class,
    topics,
)
from agv_motion.cli.message_text import MessageText, fill, is_message
from agv_motion.errors import ConfigurationError

app = typer.Typer(
    no_args_is_help=True,
    help='Look at topics, with the words and the output of [b]ros2 topic[/b].',
)
app.command(name='hz')(topic_rates.hz)
app.command(name='bw')(topic_rates.bw)

Topic = Annotated[str, typer.Argument(help="Name of the topic, such as '/cmd_vel'.")]
SpinTime = Annotated[float, typer.Option(help='Seconds to wait for discovery.', min=0.0)]
SimTime = Annotated[bool, typer.Option('--use-sim-time', '-s', help='Use simulation time.')]
Hidden = Annotated[bool, typer.Option('--include-hidden-topics', help='Hidden topics as well.')]


@app.command(name='list')
def list_(
    *,
    show_types: Annotated[bool, typer.Option('-t', '--show-types', help='Show the types.')] = False,
    count_topics: Annotated[bool, typer.Option('-c', '--count-topics', help='Count.')] = False,
    include_hidden_topics: Hidden = False,
    verbose: Annotated[bool, typer.Option('-v', '--verbose', help='Show all details.')] = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
) -> None:
    """List the topics of the graph.

    Example: agv topic list -t
    """
    with joined(spin_time, use_sim_time=use_sim_time) as node:
        found = topics(node, hidden=include_hidden_topics)
        if count_topics:
            typer.echo(len(found))
        elif verbose:
            _echo_details('Published', 'publisher', found, node.count_publishers)
            _echo_details('Subscribed', 'subscriber', found, node.count_subscribers)
        else:
            for name, types in found.items():
                typer.echo(f'{name} [{", ".join(types)}]' if show_types else name)


def _echo_details(
    title: str, word: str, found: dict[str, list[str]], count: Callable[[str], int]
) -> None:
    typer.echo(f'{title} topics:')
    for name, types in found.items():
        number = count(name)
        if number:
            plural = 's' if number > 1 else ''
            typer.echo(f' * {name} [{", ".join(types)}] {number} {word}{plural}')
    typer.echo()


@app.command()
def info(
    topic_name: Topic,
    *,
    verbose: Annotated[
        bool, typer.Option('-v', '--verbose', help='Nodes, types, and QoS of every end.')
    ] = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
) -> None:
    """Tell the type of a topic, and how many publish and subscribe.

    Example: agv topic info /cmd_vel -v
    """
    with joined(spin_time, use_sim_time=use_sim_time) as node:
        types = require_topic(node, topic_name)
        end = '\n\n' if verbose else '\n'
        typer.echo(f'Type: {types[0] if len(types) == 1 else types}{end}', nl=False)
        publishers = node.get_publishers_info_by_topic(topic_name)
        subscriptions = node.get_subscriptions_info_by_topic(topic_name)
        for word, ends in (('Publisher', publishers), ('Subscription', subscriptions)):
            typer.echo(f'{word} count: {len(ends)}{end}', nl=False)
            for one in ends if verbose else ():
                typer.echo(f'{one}{end}', nl=False)


@app.command()
def echo(
    topic_name: Topic,
    message_type: Annotated[str, typer.Argument(help='Type, if the topic is not there yet.')] = '',
    *,
    qos_profile: Annotated[str, typer.Option(help='Preset to subscribe with.')] = 'sensor_data',
    qos_depth: Annotated[int, typer.Option(help='Queue size.')] = 0,
    qos_reliability: Annotated[str, typer.Option(help='reliable or best_effort.')] = '',
    qos_durability: Annotated[str, typer.Option(help='volatile or transient_local.')] = '',
    csv: Annotated[bool, typer.Option('--csv', help='Values separated by commas.')] = False,
    field: Annotated[str, typer.Option(help='Only this field, such as pose.pose.position.')] = '',
    full_length: Annotated[bool, typer.Option('-f', '--full-length', help='Cut nothing.')] = False,
    truncate_length: Annotated[
        int, typer.Option('-l', '--truncate-length', min=0, help='Cut arrays and strings here.')
    ] = 128,
    no_arr: Annotated[bool, typer.Option('--no-arr', help='Hide arrays.')] = False,
    no_str: Annotated[bool, typer.Option('--no-str', help='Hide strings.')] = False,
    flow_style: Annotated[bool, typer.Option('--flow-style', help='One line.')] = False,
    no_lost_messages: Annotated[
        bool, typer.Option('--no-lost-messages', help='Do not report lost messages.')
    ] = False,
    raw: Annotated[bool, typer.Option('--raw', help='The bytes as they come.')] = False,
    filter_expr: Annotated[
        str, typer.Option('--filter', help='Python expression of m, the message.')
    ] = '',
    once: Annotated[bool, typer.Option('--once', help='Stop after the first message.')] = False,
    timeout: Annotated[float, typer.Option(help='Stop after so many seconds.', min=0.0)] = 0.0,
    include_message_info: Annotated[
        bool, typer.Option('-i', '--include-message-info', help='Stamps and numbers as well.')
    ] = False,
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
    wanted = _predicate(filter_expr)
    seen: list[None] = []

    def show(message: Any, about: Any) -> None:
        if once and seen:
            return
        part = _part(message, field)
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

    with joined(spin_time, use_sim_time=use_sim_time) as node:
        kind = interface_class(message_type) if message_type else topic_class(node, topic_name)
        offered = [end.qos_profile for end in node.get_publishers_info_by_topic(topic_name)]
        qos = _subscriber_qos(qos_profile, qos_depth, qos_reliability, qos_durability, offered)
        node.create_subscription(
            kind, topic_name, show, qos, raw=raw, event_callbacks=_lost_events(no_lost_messages)
        )
        end = time.monotonic() + timeout if timeout else float('inf')
        spin(node, lambda: (once and bool(seen)) or time.monotonic() > end)


def _predicate(expression: str) -> Callable[[Any], bool]:
    """Return a test of a message from the user's own Python expression."""
    if not expression:
        return lambda _: True
    code = compile(expression, '--filter', 'eval')
    return lambda m: bool(eval(code, {'m': m}))  # noqa: S307 - as in ros2: the user's own words


def _part(message: Any, field: str) -> Any:
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


def preset_qos(preset: str, depth: int = 0, reliability: str = '', durability: str = '') -> Any:
    """Return a preset of rclpy by its short name, with what was asked for changed.

    Raises:
        ConfigurationError: A word is not one of the short names.

    """
    from copy import copy

    from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, ReliabilityPolicy

    for word, policy in (
        (preset, QoSPresetProfiles),
        (reliability, ReliabilityPolicy),
        (durability, DurabilityPolicy),
    ):
        if word and word not in policy.short_keys():
            msg = f"QoS '{word}': choose one of {', '.join(policy.short_keys())}"
            raise ConfigurationError(msg)
    qos = copy(QoSPresetProfiles.get_from_short_key(preset))
    if reliability:
        qos.reliability = ReliabilityPolicy.get_from_short_key(reliability)
    if durability:
        qos.durability = DurabilityPolicy.get_from_short_key(durability)
    if depth > 0:
        qos.depth = depth
    return qos


@app.command()
def pub(
    topic_name: Topic,
    message_type: Annotated[str, typer.Argument(help="Such as 'geometry_msgs/msg/Twist'.")],
    values: Annotated[str, typer.Argument(help="YAML, such as '{linear: {x: 0.01}}'.")] = '{}',
    *,
    rate: Annotated[float, typer.Option('-r', '--rate', min=1e-3, help='Hz.')] = 1.0,
    print_: Annotated[int, typer.Option('-p', '--print', help='Print every N-th.')] = 1,
    once: Annotated[bool, typer.Option('-1', '--once', help='Publish one and stop.')] = False,
    times: Annotated[int, typer.Option('-t', '--times', min=0, help='Publish N and stop.')] = 0,
    wait_matching_subscriptions: Annotated[
        int | None, typer.Option('-w', '--wait-matching-subscriptions', min=0)
    ] = None,
    max_wait_time_secs: Annotated[float, typer.Option(min=0.0)] = 0.0,
    keep_alive: Annotated[float, typer.Option(help='Stay so long after the last.')] = 0.1,
    qos_profile: Annotated[str, typer.Option(help='Preset to publish with.')] = 'default',
    qos_depth: Annotated[int, typer.Option(help='Queue size.')] = 0,
    qos_reliability: Annotated[str, typer.Option(help='reliable or best_effort.')] = '',
    qos_durability: Annotated[str, typer.Option(help='volatile or transient_local.')] = '',
    node_name: Annotated[str, typer.Option('-n', '--node-name', help='Of the publisher.')] = '',
    spin_time: SpinTime = 0.0,
    use_sim_time: SimTime = False,
) -> None:
    """Publish a message, once, some times, or until stopped.

    Example: agv topic pub -r 10 /cmd_vel geometry_msgs/msg/TwistStamped
             '{header: auto, twist: {linear: {x: 0.01}}}'
    """
    message = interface_class(message_type)()
    content = yaml.safe_load(values)
    if not isinstance(content, dict):
        msg = 'The passed value needs to be a dictionary in YAML format'
        raise ConfigurationError(msg)
    stamps = fill(message, content)
    times = 1 if once else times
    matching = (
        int(times > 0) if wait_matching_subscriptions is None else wait_matching_subscriptions
    )
    with joined(spin_time, use_sim_time=use_sim_time, name=node_name) as node:
        qos = preset_qos(qos_profile, qos_depth, qos_reliability, qos_durability)
        publisher = node.create_publisher(type(message), topic_name, qos)
        _wait_for_subscriptions(node, publisher, matching, max_wait_time_secs)
        typer.echo('publisher: beginning loop')
        count, next_time = 0, time.monotonic()
        while times == 0 or count < times:
            due = next_time
            spin(node, lambda due=due: time.monotonic() >= due)  # type: ignore[misc]
            for stamp in stamps:
                stamp(node.get_clock().now().to_msg())
            count, next_time = count + 1, next_time + 1.0 / rate
            if print_ and count % print_ == 0:
                typer.echo(f'publishing #{count}: {message!r}\n')
            publisher.publish(message)
        time.sleep(keep_alive)


def _wait_for_subscriptions(node: Any, publisher: Any, wanted: int, limit: float) -> None:
    start = told = time.monotonic() - 1.0
    while publisher.get_subscription_count() < wanted:
        now = time.monotonic()
        if now - told >= 1.0:
            typer.echo(f'Waiting for at least {wanted} matching subscription(s)...')
            told = now
        if limit and now - start - 1.0 > limit:
            msg = (
                f'Timed out waiting for subscribers: Expected {wanted} subcribers but only got '
                f'{publisher.get_subscription_count()} subscribers'
            )
            raise ConfigurationError(msg)
        spin(node, lambda now=now: time.monotonic() > now + 0.1)  # type: ignore[misc]
