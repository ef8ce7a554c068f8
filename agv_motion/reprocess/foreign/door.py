"""How nodes of others come into a run: nothing of it is imported where there are none."""

from __future__ import annotations

from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

from agv_motion.reprocess.recorded import all_parameters
from agv_motion.ros.config import find_config

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from agv_motion.ros.in_process_graph import InProcessGraph


def depends_on(foreign: tuple[str, ...], config: str) -> list[Any]:
    """Return what else a result depends on where there are nodes of others.

    Raises:
        ConfigurationError: One is not there, or asks for the date of today.

    """
    from agv_motion.reprocess.foreign.source import digest, require_no_dates

    for target in foreign:
        require_no_dates(target)
    texts = [find_config(config).read_bytes()] if foreign and config else []
    return [*map(digest, foreign), *texts]


@contextmanager
def watched(foreign: tuple[str, ...]) -> Iterator[None]:
    """Turn what nodes of others must not do into an error.

    Raises:
        ConfigurationError: One of them did.

    """
    if not foreign:
        yield
        return
    from agv_motion.reprocess.foreign.refusal import told

    with told(', '.join(foreign)):
        yield


def add(
    graph: InProcessGraph, target: str, place: tuple[str, Mapping[str, str]], config: str
) -> None:
    """Add somebody's node to a graph.

    Args:
        graph: To join.
        target: ``package.module:Class``.
        place: Namespace, and full names of topics by the full names that the node uses.
        config: File of parameters.

    """
    from agv_motion.reprocess.foreign.foreign_node import ForeignNode

    ForeignNode(graph, target, *place, partial(all_parameters, config))
