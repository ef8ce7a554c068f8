"""What the shell offers for a word that is not finished: names that are on the graph now.

An answer takes a second, as to join the graph does; one that fails offers nothing, and says
nothing into the line that somebody types.
"""

from __future__ import annotations

from contextlib import redirect_stderr, suppress
from io import StringIO
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable


def topic_names(incomplete: str) -> list[str]:
    """Return the topics that begin so."""
    from agv_motion.cli.graph.session import topics

    return _offered(incomplete, topics)


def service_names(incomplete: str) -> list[str]:
    """Return the services that begin so."""
    from agv_motion.cli.graph.session import services

    return _offered(incomplete, services)


def names_of_nodes(incomplete: str) -> list[str]:
    """Return the nodes that begin so."""
    from agv_motion.cli.graph.nodes import node_names

    return _offered(incomplete, node_names)


def one_of(names: Callable[[], Iterable[str]]) -> Callable[[str], list[str]]:
    """Return what offers those of some names that begin so."""

    def offered(incomplete: str) -> list[str]:
        return [name for name in names() if name.startswith(incomplete)]

    return offered


def _offered(incomplete: str, names: Callable[[Any], Iterable[str]]) -> list[str]:
    from agv_motion.cli.graph.session import joined

    with suppress(Exception), redirect_stderr(StringIO()), joined() as node:
        return [name for name in dict.fromkeys(names(node)) if name.startswith(incomplete)]
    return []
