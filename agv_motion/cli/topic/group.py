"""`agv topic`: the words, options and output of `ros2 topic`, for a machine without it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

import typer

from agv_motion.cli.graph.discovery import DISCOVERY
from agv_motion.cli.graph.options import HiddenTopics, NoDaemon, SimTime, SpinTime
from agv_motion.cli.graph.session import joined, require_topic, topics
from agv_motion.cli.lazy_group import lazy_group
from agv_motion.cli.topic.options import Topic

app = typer.Typer(
    cls=lazy_group(
        {
            'hz': 'topic.rates:hz',
            'bw': 'topic.rates:bw',
            'delay': 'topic.delay:delay',
            'echo': 'topic.echo:echo',
            'pub': 'topic.pub:pub',
        }
    ),
    no_args_is_help=True,
    help='Look at topics, with the words and the output of `ros2 topic`.',
)


@app.command(name='list')
def list_(
    *,
    show_types: Annotated[bool, typer.Option('-t', '--show-types', help='Show the types.')] = False,
    count_topics: Annotated[bool, typer.Option('-c', '--count-topics', help='Count.')] = False,
    include_hidden_topics: HiddenTopics = False,
    verbose: Annotated[bool, typer.Option('-v', '--verbose', help='Show all details.')] = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
    no_daemon: NoDaemon = False,  # noqa: ARG001 - taken as ros2 does, without effect
) -> None:
    """List the topics of the graph.

    Example: agv topic list -t
    """
    with joined(spin_time, use_sim_time=use_sim_time, whole=True) as node:
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
    no_daemon: NoDaemon = False,  # noqa: ARG001 - taken as ros2 does, without effect
) -> None:
    """Tell the type of a topic, and how many publish and subscribe.

    Example: agv topic info /cmd_vel -v
    """
    with joined(spin_time, use_sim_time=use_sim_time, whole=True) as node:
        types = require_topic(node, topic_name)
        end = '\n\n' if verbose else '\n'
        typer.echo(f'Type: {types[0] if len(types) == 1 else types}{end}', nl=False)
        publishers = node.get_publishers_info_by_topic(topic_name)
        subscriptions = node.get_subscriptions_info_by_topic(topic_name)
        for word, ends in (('Publisher', publishers), ('Subscription', subscriptions)):
            typer.echo(f'{word} count: {len(ends)}{end}', nl=False)
            for one in ends if verbose else ():
                typer.echo(f'{one}{end}', nl=False)


@app.command(name='type')
def type_(
    topic_name: Topic,
    *,
    include_hidden_topics: HiddenTopics = False,  # noqa: ARG001 - what is named is shown
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """Tell the type of a topic.

    Example: agv topic type /cmd_vel
    """
    with joined(spin_time, use_sim_time=use_sim_time) as node:
        for one in require_topic(node, topic_name):
            typer.echo(one)


@app.command()
def find(
    topic_type: Annotated[str, typer.Argument(help="Such as 'nav_msgs/msg/Odometry'.")],
    *,
    count_topics: Annotated[bool, typer.Option('-c', '--count-topics', help='Count.')] = False,
    include_hidden_topics: HiddenTopics = False,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
    no_daemon: NoDaemon = False,  # noqa: ARG001
) -> None:
    """List the topics of a type.

    Example: agv topic find nav_msgs/msg/Odometry
    """
    with joined(spin_time, use_sim_time=use_sim_time, whole=True) as node:
        found = topics(node, hidden=include_hidden_topics).items()
        names = [name for name, types in found if topic_type in types]
        for line in [len(names)] if count_topics else names:
            typer.echo(line)
