"""`agv interface`: the words, options and output of `ros2 interface`, for a machine without it."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from agv_motion.errors import ConfigurationError

app = typer.Typer(
    no_args_is_help=True,
    help='Types of messages and services, with the words and the output of `ros2 interface`.',
)


@app.command(name='list')
def list_(
    *,
    only_msgs: Annotated[bool, typer.Option('-m', '--only-msgs', help='Messages only.')] = False,
    only_srvs: Annotated[bool, typer.Option('-s', '--only-srvs', help='Services only.')] = False,
    only_actions: Annotated[bool, typer.Option('-a', '--only-actions', help='Actions.')] = False,
) -> None:
    """List the types that are installed."""
    from agv_motion.ros.interface_text import KINDS, installed

    asked = {'msg': only_msgs, 'srv': only_srvs, 'action': only_actions}
    for kind, title in KINDS.items():
        if asked[kind] or not any(asked.values()):
            typer.echo(f'{title}:')
            for name in installed(kind):
                typer.echo(f'    {name}')


@app.command()
def show(
    type_: Annotated[str, typer.Argument(metavar='TYPE', help='As std_msgs/msg/String; - reads.')],
    *,
    all_comments: Annotated[
        bool, typer.Option('--all-comments', help='Comments of the types in it as well.')
    ] = False,
    no_comments: Annotated[
        bool, typer.Option('--no-comments', help='No comments, no empty lines.')
    ] = False,
) -> None:
    """Show what a type consists of.

    Examples: agv interface show geometry_msgs/msg/TwistStamped
              agv topic type /cmd_vel | agv interface show -
    """
    from agv_motion.ros.interface_text import lines

    if all_comments and no_comments:
        msg = '--all-comments does not go with --no-comments: choose one'
        raise ConfigurationError(msg)
    name = sys.stdin.readline().strip() if type_ == '-' else type_
    if not name:
        msg = 'the passed value is empty'
        raise ConfigurationError(msg)
    for line in lines(name, comments=not no_comments, nested_comments=all_comments):
        typer.echo(line)
