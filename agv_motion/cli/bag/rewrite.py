"""`agv bag filter`, `split`, `compress` and `sort`: the same bag with less, in pieces, in order."""

from __future__ import annotations

from typing import Annotated

import typer

from agv_motion.cli.bag.edit_options import (
    Compression,
    From,
    Source,
    Target,
    To,
    compression,
    edit_each,
    selection,
)
from agv_motion.cli.bag.many import Scheduler, Workers
from agv_motion.cli.recording.topic_options import ExcludeRegex, ExcludeTopics, Regex, Topics
from agv_motion.errors import ConfigurationError


def choose(
    bag: Source,
    output: Target,
    *,
    topics: Topics = None,
    regex: Regex = '',
    exclude_topics: ExcludeTopics = None,
    exclude_regex: ExcludeRegex = '',
    begin: From = '',
    end: To = '',
    codec: Compression = '',
    workers: Workers = 1,
    scheduler: Scheduler = '',
) -> None:
    """Keep some topics of a bag, with their attachments and metadata.

    Chunks of which everything is kept are copied as they are, after a look at their CRC. Examples:

    agv bag filter walk small --topics /cmd_vel --topics /odom

    agv bag filter walk nocamera --exclude-regex camera

    agv bag filter season odometry --regex '/odom$' --workers 4
    """
    from agv_motion.bag.editing.request import EditRequest

    if not (topics or regex or exclude_topics or exclude_regex):
        msg = 'nothing to filter: give --topics, --regex, --exclude-topics or --exclude-regex'
        raise ConfigurationError(msg)
    chosen = selection(topics, regex, exclude_topics, exclude_regex)
    request = EditRequest(chosen, begin, end, compression=compression(codec))
    edit_each(bag, output, request, workers, scheduler)


def split(
    bag: Source,
    output: Target,
    *,
    duration: Annotated[float, typer.Option('-d', '--duration', min=0, help='[s] a file.')] = 0.0,
    size: Annotated[float, typer.Option('-b', '--size', min=0, help='[MB] a file, about.')] = 0.0,
    workers: Workers = 1,
    scheduler: Scheduler = '',
) -> None:
    """Split a bag into files by time, or by size, as agv record does; together they are the bag.

    With --duration each file begins at a multiple of it, counted from the start of the bag; with
    --size chunks stay whole. Attachments and metadata go into the first file. Examples:

    agv bag split day hours --duration 3600

    agv bag split day pieces --size 500

    agv bag cut day/day_0.mcap noon --from 12:00 --to 13:00
    """
    from agv_motion.bag.editing.request import EditRequest

    if bool(duration) == bool(size):
        msg = f'--duration {duration:g}, --size {size:g}: give one of them, above 0'
        raise ConfigurationError(msg)
    edit_each(bag, output, EditRequest(part_duration=duration, part_size=size), workers, scheduler)


def compress(
    bag: Source,
    output: Target,
    *,
    codec: Compression = 'zstd',
    workers: Workers = 1,
    scheduler: Scheduler = '',
) -> None:
    """Compress the chunks of a bag anew, or not at all; what is compressed so already is copied.

    For example:

    agv bag compress walk small

    agv bag compress walk plain --compression none

    agv bag compress season packed --workers 4
    """
    from agv_motion.bag.editing.request import EditRequest

    chosen = compression(codec) or 'zstd'
    edit_each(bag, output, EditRequest(compression=chosen), workers, scheduler)


def convert(
    bag: Source,
    output: Target,
    *,
    storage: Annotated[
        str, typer.Option('--to', '-s', help='mcap or sqlite3; else the one that it is not.')
    ] = '',
    topics: Topics = None,
    codec: Compression = '',
    workers: Workers = 1,
    scheduler: Scheduler = '',
) -> None:
    """Convert a bag from sqlite3 to MCAP, or back.

    A file of sqlite3 has no place for times of sending and for numbers of messages: they are lost
    there. Attachments and metadata go into extras.mcap beside it, from which they come back.
    For example:

    agv bag convert old_db3 new_mcap

    agv bag convert walk for_old_tools --to sqlite3

    agv bag convert archive_db3 archive_mcap --workers 4
    """
    from agv_motion.bag.editing.request import EditRequest

    if storage not in ('', 'mcap', 'sqlite3'):
        msg = f"--to '{storage}': choose mcap or sqlite3"
        raise ConfigurationError(msg)
    chosen = selection(topics, '', None, '')
    request = EditRequest(chosen, compression=compression(codec), storage=storage)
    edit_each(bag, output, request, workers, scheduler)


def sort(bag: Source, output: Target, *, workers: Workers = 1, scheduler: Scheduler = '') -> None:
    """Put the messages of a bag in the order of their log time; what is in order is copied.

    Readers of bags put messages in order anyway; those that read a file as it lies there, such as
    a stream, want it so. Of equal times, the order stays. Example: agv bag sort walk ordered
    """
    from agv_motion.bag.editing.request import EditRequest

    edit_each(bag, output, EditRequest(ordered=True), workers, scheduler)
