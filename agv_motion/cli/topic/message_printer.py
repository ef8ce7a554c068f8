"""What `agv topic echo` and `agv bag echo` do with each message: choose, cut, and print."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import typer
import yaml

from agv_motion.cli.topic.message_text import MessageText, csv_row, is_message
from agv_motion.errors import ConfigurationError


class MessagePrinter:
    """Prints the messages that a filter lets through, or one field of each."""

    def __init__(
        self, text: MessageText, *, csv: bool, field: str, filter_expr: str, info: bool
    ) -> None:
        """Keep the options of ``ros2 topic echo``; ``info`` asks for stamps and numbers as well.

        Raises:
            ConfigurationError: The filter is no expression of Python.

        """
        self._text, self._csv, self._field, self._info = text, csv, field, info
        self._wanted = predicate(filter_expr)

    def show(self, message: Any, about: dict[str, Any]) -> bool:
        """Print a message, after what is known ``about`` it; return False if it is filtered out.

        Raises:
            ConfigurationError: It has no such field, or the filter fails on it.

        """
        part = part_of(message, self._field)
        if not self._wanted(part):
            return False
        about = about if self._info else {}
        if self._csv:
            values = self._text.csv(part) if is_message(part) else csv_row([part])
            typer.echo(','.join([*map(str, about.values()), values]))
            return True
        if about:
            typer.echo(f'{yaml.dump(about, sort_keys=False)}---')
        typer.echo(f'{self._text.yaml(part)}---' if is_message(part) else f'{part}\n---')
        return True


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
