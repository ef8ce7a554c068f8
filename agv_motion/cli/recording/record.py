"""`agv record`: a bag of what the graph says, with the words of `ros2 bag record`."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Annotated, Any

import typer

from agv_motion.cli.recording.event_options import (
    After,
    Before,
    Events,
    OnlyEvents,
    Trigger,
    event_parameters,
)
from agv_motion.cli.recording.storage_options import (
    Compression,
    KeepFiles,
    KeepFree,
    MaxBagDuration,
    MaxBagSize,
    MaxCacheSize,
    Output,
    StartPaused,
    Sync,
    WhenFull,
)
from agv_motion.cli.recording.topic_options import (
    ExcludeRegex,
    ExcludeTopics,
    HiddenTopics,
    PollingInterval,
    Regex,
    Topics,
    chosen_topics,
)
from agv_motion.cli.terminal import LineTable, terminal
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from rich.console import Console

    from agv_motion.bag.recording.recording import TopicReport
    from agv_motion.nodes.bag_recorder import BagRecorder


def record(
    topic: Annotated[list[str] | None, typer.Argument(help='Topics to record.')] = None,
    *,
    all_topics: Annotated[bool, typer.Option('-a', '--all', help='Record every topic.')] = False,
    topics: Topics = None,
    regex: Regex = '',
    exclude_topics: ExcludeTopics = None,
    exclude_regex: ExcludeRegex = '',
    include_hidden_topics: HiddenTopics = False,
    output: Output = None,
    compression: Compression = 'zstd',
    max_bag_size: MaxBagSize = 0,
    max_bag_duration: MaxBagDuration = 0,
    keep_files: KeepFiles = 0,
    keep_free: KeepFree = 100.0,
    when_full: WhenFull = 'stop',
    max_cache_size: MaxCacheSize = 256e6,
    sync: Sync = True,
    trigger: Trigger = None,
    before: Before = 120.0,
    after: After = 60.0,
    events: Events = None,
    only_events: OnlyEvents = False,
    polling_interval: PollingInterval = 100.0,
    start_paused: StartPaused = False,
    use_sim_time: Annotated[
        bool, typer.Option('--use-sim-time', help='Stamp with /clock.')
    ] = False,
    duration: Annotated[float, typer.Option(min=0, help='Stop after seconds; 0: Ctrl-C.')] = 0,
) -> None:
    """Record topics into a bag (MCAP) until Ctrl-C, then tell what was lost.

    A crash or a power cut loses at most the last second; agv bag recover mends the file. The time
    around an event (--trigger, or ~/mark of the node) becomes a small bag of its own.

    Examples:
    agv record -a
    agv record /cmd_vel /turrets/state -o walk
    agv record -a -d 3600 --keep-files 24     (the last day, by the hour)
    agv record -a --only-events --trigger '/state ~ stopped'     (a black box)
    """
    given = {
        'output': str(output or ''),
        'all': all_topics,
        'include_hidden_topics': include_hidden_topics,
        'start_paused': start_paused,
        **event_parameters(trigger, before, after, events, only_events=only_events),
        'polling_interval': polling_interval / 1e3,
        'use_sim_time': use_sim_time,
        'storage__compression': compression,
        'storage__max_bag_size': max_bag_size / 1e6,
        'storage__max_bag_duration': max_bag_duration,
        'storage__keep_files': keep_files,
        'storage__keep_free': keep_free,
        'storage__when_full': when_full,
        'storage__cache': max_cache_size / 1e6,
        'storage__sync': sync,
    }
    named = _require_any([*(topic or ()), *(topics or ())], all_topics or regex)
    _record(given | chosen_topics(named, regex, exclude_topics, exclude_regex), duration)


def _require_any(named: list[str], other: object) -> list[str]:
    """Return the topics that were named; raise where nothing is to be recorded."""
    if not (named or other):
        msg = 'nothing to record: name topics, or give -a for all, or --regex for those that match'
        raise ConfigurationError(msg)
    return named


def _record(given: dict[str, Any], duration: float) -> None:
    """Run the node until it is told to stop or ends by itself."""
    import rclpy

    from agv_motion.nodes.bag_recorder import BagRecorder
    from agv_motion.ros.context import begin_context
    from agv_motion.ros.live_node import LiveNode
    from agv_motion.ros.run import overrides, shut_down, spin, start
    from agv_motion.ros.stop import Stop

    begin_context()
    stop = Stop()
    console = terminal()
    try:
        node = LiveNode(BagRecorder, parameter_overrides=overrides(**given))
        try:
            start(node)
            recorder = node.plain
            begun = time.monotonic()
            with console.status('Waiting for topics') as status:

                def finished() -> bool:
                    recording = recorder.recording
                    elapsed = time.monotonic() - begun
                    if recording is not None:
                        status.update(_progress(recorder, elapsed))
                    over = bool(duration) and elapsed >= duration
                    return stop.requested or over or recording is None

                spin([node], finished)
        finally:
            shut_down(node)  # the bag is whole even where the terminal is gone
    finally:
        rclpy.try_shutdown()
    _tell(console, recorder.report)
    for path in recorder.events.saved:
        typer.echo(f'Event: {path}')
    if recorder.failure:
        typer.echo(f'error: {recorder.failure}', err=True)
        raise typer.Exit(1)


def _progress(recorder: BagRecorder, elapsed: float) -> str:
    assert recorder.recording is not None
    paused = ', paused' if recorder.paused else ''
    return (
        f'{elapsed:.0f} s: {recorder.recording.messages} messages of {recorder.topics} topics, '
        f'{recorder.recording.size / 1e6:.1f} MB{paused}; Ctrl-C ends'
    )


def _tell(console: Console, report: list[TopicReport]) -> None:
    """Print what became of each topic."""
    table = LineTable()
    for title in ('topic', 'messages', 'Hz', 'lost', 'dropped', 'deleted', 'longest silence [s]'):
        table.add_column(title, justify='left' if title == 'topic' else 'right', overflow='fold')
    for topic in sorted(report):
        bad = 'red' if topic.lost or topic.dropped else ''
        table.add_row(
            topic.name, str(topic.messages), f'{topic.rate:.2f}', str(topic.lost),
            str(topic.dropped), str(topic.deleted), f'{topic.longest_silence:.3f}', style=bad,
        )  # fmt: skip
    console.print(table)
