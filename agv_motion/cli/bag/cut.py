"""`agv bag cut`: some time of a bag, or the times around what happened, as a bag of its own."""

from __future__ import annotations

from typing import Annotated

import typer

from agv_motion.cli.bag.edit_options import (
    From,
    Source,
    Target,
    To,
    edit_each,
    selection,
)
from agv_motion.cli.bag.many import Scheduler, Workers
from agv_motion.cli.bag.options import Duration, StartOffset
from agv_motion.cli.recording.topic_options import ExcludeRegex, ExcludeTopics, Regex, Topics
from agv_motion.errors import ConfigurationError


def cut(
    bag: Source,
    output: Target,
    *,
    begin: From = '',
    end: To = '',
    start_offset: StartOffset = 0.0,
    duration: Duration = -1.0,
    around: Annotated[
        str, typer.Option(help="Only times around messages like '/turrets/residual > 0.02'.")
    ] = '',
    before: Annotated[float, typer.Option(min=0, help='... how many seconds before.')] = 30.0,
    after: Annotated[float, typer.Option(min=0, help='... how many seconds after.')] = 60.0,
    latched: Annotated[
        bool, typer.Option(help='Begin with what latched topics had told before.')
    ] = True,
    topics: Topics = None,
    regex: Regex = '',
    exclude_topics: ExcludeTopics = None,
    exclude_regex: ExcludeRegex = '',
    workers: Workers = 1,
    scheduler: Scheduler = '',
) -> None:
    """Cut a time out of a bag, with maps and states that were told before it.

    What latched (transient local) topics had told last stands at the start of the cut, with its own
    time of sending. Chunks within are copied as they are, after a look at their CRC; attachments
    and metadata are kept. With --around the bag has all times around messages that meet a
    condition; windows that overlap are joined. Examples:

    agv bag cut walk rain --from 14:32 --to 14:40

    agv bag cut walk end --from -60

    agv bag cut walk part --start-offset 600 --playback-duration 30

    agv bag cut walk slips --around '/turrets/residual > 0.02' --before 30 --after 60

    agv bag cut walk stops --around '/state ~ stopped' --topics /cmd_vel --topics /odom

    agv bag cut season slips --around '/turrets/residual > 0.02' --workers 4
    """
    from agv_motion.bag.editing.request import EditRequest

    offsets = _offsets(start_offset, duration)
    if any(offsets) and (begin or end):
        msg = '--from and --to, or --start-offset and --playback-duration: give one of the pairs'
        raise ConfigurationError(msg)
    begin, end = (begin, end) if begin or end else offsets
    if not (begin or end or around):
        msg = (
            'nothing to cut: give --from, --to, --start-offset, --playback-duration or --around; '
            'agv bag filter takes some of the topics'
        )
        raise ConfigurationError(msg)
    chosen = selection(topics, regex, exclude_topics, exclude_regex)
    request = EditRequest(chosen, begin, end, around, before, after, latched=latched)
    edit_each(bag, output, request, workers, scheduler)


def _offsets(start_offset: float, duration: float) -> tuple[str, str]:
    """Return what the other commands call offset and duration as moments."""
    begin = f'{start_offset:.9f}' if start_offset else ''
    return begin, '' if duration < 0 else f'{start_offset + duration:.9f}'
