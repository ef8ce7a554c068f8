"""`agv topic pub`: send messages written as YAML."""

from __future__ import annotations

import time
from typing import Annotated, Any

import typer

from agv_motion.cli.graph.options import SimTime, SpinTime
from agv_motion.cli.graph.session import full_name, interface_class, joined, spin
from agv_motion.cli.topic.message_text import fill
from agv_motion.cli.topic.options import Topic, preset_qos
from agv_motion.errors import ConfigurationError
from agv_motion.files import yaml_text

ACKNOWLEDGED = 2.0
"""[s] that reliable subscriptions have to say that they took the last message"""


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
    from rclpy.duration import Duration

    message = interface_class(message_type)()
    content = yaml_text.plain(values, 'the message')
    if not isinstance(content, dict):
        msg = 'The passed value needs to be a dictionary in YAML format'
        raise ConfigurationError(msg)
    stamps = fill(message, content)
    times = 1 if once else times
    matching = (
        int(times > 0) if wait_matching_subscriptions is None else wait_matching_subscriptions
    )
    with joined(spin_time, use_sim_time=use_sim_time, name=node_name, endless=True) as node:
        qos = preset_qos(qos_profile, qos_depth, qos_reliability, qos_durability)
        full_name(node, topic_name)  # an impossible one is refused in words
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
        # a subscription that was found first, and has yet to find us, takes it only then
        publisher.wait_for_all_acked(Duration(seconds=ACKNOWLEDGED))
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
