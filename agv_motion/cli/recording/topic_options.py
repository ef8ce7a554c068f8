"""Which topics: the options that `agv record` and `agv replay` have in common."""

from __future__ import annotations

from typing import Annotated, Any

import typer

Topics = Annotated[
    list[str] | None, typer.Option('--topics', help='Only these topics, one per option.')
]
Regex = Annotated[
    str, typer.Option('-e', '--regex', help='Only topics in whose name this is found.')
]
ExcludeTopics = Annotated[list[str] | None, typer.Option(help='Never this; one per option.')]
ExcludeRegex = Annotated[
    str, typer.Option('-x', '--exclude-regex', help='Never topics in whose name this is found.')
]
HiddenTopics = Annotated[
    bool, typer.Option('--include-hidden-topics', help='Hidden topics as well.')
]
PollingInterval = Annotated[
    float, typer.Option('-p', '--polling-interval', help='Milliseconds between looks.')
]


def chosen_topics(
    topics: list[str] | None, regex: str, exclude_topics: list[str] | None, exclude_regex: str
) -> dict[str, Any]:
    """Return the parameters of a node that records or plays; an empty list is no parameter."""
    lists = {'topics': topics, 'exclude_topics': exclude_topics}
    given = {name: values for name, values in lists.items() if values}
    return {'regex': regex, 'exclude_regex': exclude_regex, **given}
