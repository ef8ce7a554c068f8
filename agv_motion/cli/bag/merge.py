"""`agv bag merge`: several bags as one."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from agv_motion.cli.bag.edit_options import Compression, compression, edit_together, selection
from agv_motion.cli.recording.topic_options import ExcludeRegex, ExcludeTopics, Regex, Topics
from agv_motion.errors import ConfigurationError


def merge(
    bags: Annotated[
        list[Path], typer.Argument(metavar='IN... OUT', help='Bags; folder of the new one.')
    ],
    *,
    topics: Topics = None,
    regex: Regex = '',
    exclude_topics: ExcludeTopics = None,
    exclude_regex: ExcludeRegex = '',
    codec: Compression = '',
) -> None:
    """Make one bag of several, with all their topics, attachments and metadata.

    Chunks stay as they are and take turns by time; where a topic has another number in another bag,
    its messages are numbered anew. What several bags attach alike is kept once. Examples:

    agv bag merge monday tuesday week

    agv bag merge walk/walk_0.mcap lidar.mcap both
    """
    from agv_motion.bag.editing.request import EditRequest

    *sources, target = bags
    if len(sources) < 2:
        msg = f'give at least two bags and where to write: agv bag merge ONE OTHER {target}'
        raise ConfigurationError(msg)
    chosen = selection(topics, regex, exclude_topics, exclude_regex)
    edit_together(sources, target, EditRequest(chosen, compression=compression(codec)))
