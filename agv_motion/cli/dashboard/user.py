"""`agv dashboard user`: who may come to the page from beyond this machine."""

from __future__ import annotations

import getpass
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Annotated

import typer

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from agv_motion.dashboard.server.users import Users

app = typer.Typer(no_args_is_help=True, help='Who may come to the page from other machines.')

NAME = Annotated[str, typer.Argument(help='Of the user.')]
ROLE = Annotated[str, typer.Option(help='viewer, operator or expert.')]
FOLDER = Annotated[str, typer.Option(help='Where the users are kept, as of the node.')]
STDIN = Annotated[bool, typer.Option('--password-stdin', help='Read it from standard input.')]


@contextmanager
def _users(folder: str) -> Iterator[Users]:
    from agv_motion.dashboard.server.store import Store, state_folder
    from agv_motion.dashboard.server.users import Users

    store = Store(state_folder(folder))
    try:
        yield Users(store)
    finally:
        store.close()


def _password(*, stdin: bool) -> str:
    """Return a password, which never stands on a command line."""
    if stdin:
        return sys.stdin.readline().rstrip('\n')
    password = getpass.getpass('Password: ')
    if getpass.getpass('Again: ') != password:
        msg = 'the two are not the same: nothing was changed'
        raise ConfigurationError(msg)
    return password


@app.command()
def add(
    name: NAME, *, role: ROLE = 'operator', state_folder: FOLDER = '', password_stdin: STDIN = False
) -> None:
    """Add a user; asks for the password."""
    with _users(state_folder) as users:
        users.add(name, _password(stdin=password_stdin), role)
        typer.echo(f'{name} may log in as {role}')


@app.command()
def password(name: NAME, *, state_folder: FOLDER = '', password_stdin: STDIN = False) -> None:
    """Give a user another password, and end all its sessions."""
    with _users(state_folder) as users:
        users.set_password(name, _password(stdin=password_stdin))
        typer.echo(f'{name} has another password, and must log in again')


@app.command()
def role(name: NAME, role: Annotated[str, typer.Argument()], *, state_folder: FOLDER = '') -> None:
    """Give a user another role, at once."""
    with _users(state_folder) as users:
        users.set_role(name, role)
        typer.echo(f'{name} is {role} now')


@app.command()
def remove(name: NAME, *, state_folder: FOLDER = '') -> None:
    """Let a user in no more."""
    with _users(state_folder) as users:
        users.remove(name)
        typer.echo(f'{name} may log in no more')


@app.command()
def token(
    name: NAME,
    *,
    role: ROLE = 'viewer',
    hours: Annotated[float, typer.Option(help='For which it lasts.')] = 12.0,
    state_folder: FOLDER = '',
) -> None:
    """Print a token by which a tool comes to /foxglove, where it cannot log in.

    It stands in the address, which the tool may keep: so it opens nothing else, is for looking
    unless a role is given, and is void after some hours, or when the password is changed.
    """
    with _users(state_folder) as users:
        typer.echo(f'?token={users.bearer_token(name, role, hours)}')


@app.command(name='list')
def list_users(*, state_folder: FOLDER = '') -> None:
    """List the users and their roles."""
    with _users(state_folder) as users:
        for name, held in users.names().items():
            typer.echo(f'{name} {held}')
