"""`agv replay`: play a bag to the graph, with the options and keys of `ros2 bag play`."""

from __future__ import annotations

import math
from decimal import Decimal
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.progress import BarColumn, Progress, TextColumn

from agv_motion.cli.bag.options import Duration, StartOffset
from agv_motion.cli.recording.keys import keyboard
from agv_motion.cli.recording.topic_options import (
    ExcludeRegex,
    ExcludeTopics,
    Regex,
    Topics,
    chosen_topics,
)
from agv_motion.cli.terminal import terminal
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from agv_motion.nodes.bag_player import BagPlayer

LATEST = 2**63 - 1
"""[ns]"""

StartPaused = Annotated[
    bool, typer.Option('-p', '--start-paused', help='Wait for the space bar or ~/resume.')
]
SkipGaps = Annotated[
    bool, typer.Option('--skip-gaps', help='Go on at once where no bag was recorded.')
]
NoKeys = Annotated[bool, typer.Option('--disable-keyboard-controls', help='Leave the keys alone.')]
WaitForAcks = Annotated[
    float, typer.Option(help='Milliseconds to wait for listeners at the end; negative: not.')
]
RATE_STEP = 1.1
"""by which an arrow changes the rate"""


def replay(
    bag: Annotated[list[Path], typer.Argument(help='Folders or files, played by one clock.')],
    *,
    rate: Annotated[float, typer.Option('-r', '--rate', help='Times as fast as it was.')] = 1.0,
    loop: Annotated[bool, typer.Option('-l', '--loop', help='Begin again at the end.')] = False,
    start_offset: StartOffset = 0.0,
    playback_duration: Duration = -1.0,
    playback_until_sec: Annotated[
        str, typer.Option(help='Time of the bag to stop at, seconds since 1970; negative: its end.')
    ] = '-1',
    playback_until_nsec: Annotated[int, typer.Option(help='The same in nanoseconds.')] = -1,
    topics: Topics = None,
    regex: Regex = '',
    exclude_topics: ExcludeTopics = None,
    exclude_regex: ExcludeRegex = '',
    remap: Annotated[
        list[str] | None, typer.Option('-m', '--remap', help='/old:=/new; one per option.')
    ] = None,
    clock: Annotated[
        float, typer.Option(help='Publish the time of the bag on /clock so often [Hz]; 0: not.')
    ] = 0.0,
    delay: Annotated[float, typer.Option('-d', '--delay', help='Seconds to wait first.')] = 0.0,
    start_paused: StartPaused = False,
    skip_gaps: SkipGaps = False,
    qos_profile_overrides_path: Annotated[
        Path | None, typer.Option(help='YAML file: topic, then reliability, durability, depth.')
    ] = None,
    wait_for_all_acked: WaitForAcks = -1.0,
    disable_keyboard_controls: NoKeys = False,
) -> None:
    """Play bags to the graph, each message at its time, and tell how late they were.

    Several are played by one clock, those that overlap together, and with the pauses between them.
    Keys: space to pause and go on, right for the next message, up and down for the rate, left for
    ten seconds back, q to end. Examples:
    agv replay demo_output/bag
    agv replay demo_output/bag -r 10 --clock 40 --start-offset 600 --topics /fix
    agv replay walk -l -m /cmd_vel:=/old/cmd_vel
    agv replay monday tuesday --skip-gaps
    """
    if playback_until_nsec < 0:
        playback_until_nsec = _exact(playback_until_sec)
    given: dict[str, Any] = {
        'bag': str(bag[0]),
        'skip_gaps': skip_gaps,
        'rate': rate,
        'loop': loop,
        'start_offset': start_offset,
        'playback_duration': playback_duration,
        'playback_until_nsec': playback_until_nsec,
        'clock': clock,
        'delay': delay,
        'start_paused': start_paused,
        'qos_overrides': str(qos_profile_overrides_path or ''),
        'wait_for_all_acked': wait_for_all_acked / 1e3 if wait_for_all_acked >= 0 else -1.0,
    }
    given |= chosen_topics(topics, regex, exclude_topics, exclude_regex)
    given |= {'bags': [str(path) for path in bag[1:]]} if bag[1:] else {}
    _replay(given, remap or [], keys=not disable_keyboard_controls)


def _exact(seconds: str) -> int:
    """Return nanoseconds of what was typed; a float would lose those of a time since 1970.

    Raises:
        ConfigurationError: It is no number, or beyond all times.

    """
    try:
        return min(math.floor(Decimal(seconds) * 1_000_000_000), LATEST)
    except (ArithmeticError, ValueError) as error:
        msg = f"--playback-until-sec '{seconds}': give seconds since 1970, such as 1434366000.25"
        raise ConfigurationError(msg) from error


def _replay(given: dict[str, Any], remap: list[str], *, keys: bool) -> None:
    """Run the node until the end of the bag."""
    import rclpy

    from agv_motion.nodes.bag_player import BagPlayer
    from agv_motion.ros.context import begin_context
    from agv_motion.ros.live_node import LiveNode
    from agv_motion.ros.run import overrides, spin, start
    from agv_motion.ros.stop import Stop

    begin_context()
    stop = Stop()
    console = terminal()
    arguments = [word for pair in remap for word in ('-r', pair)]
    try:
        node = LiveNode(
            BagPlayer, parameter_overrides=overrides(**given), cli_args=['--ros-args', *arguments]
        )
        start(node)
        player = node.plain
        bar = Progress(
            BarColumn(),
            TextColumn('{task.description}', markup=False),
            console=console,
            transient=True,
        )
        task = bar.add_task(
            _progress(player), total=player.playing.excerpt.end - player.playing.excerpt.begin
        )
        with bar, keyboard(enabled=keys) as pressed:

            def finished() -> bool:
                for key in pressed():
                    stop.requested |= key == 'q'
                    _obey(player, key)
                done = player.playing.position() - player.playing.excerpt.begin
                bar.update(task, description=_progress(player), completed=done)
                return stop.requested or player.playing.finished.is_set()

            spin([node], finished)
    finally:
        rclpy.try_shutdown()
    console.print(str(player.playing.lag))
    for topic, reason in player.unplayed.items():
        typer.echo(f'error: {given["bag"]}, {topic} was not played: {reason}', err=True)
    if player.playing.failure:
        typer.echo(f'error: {player.playing.failure}', err=True)
    if player.playing.failure or player.unplayed or player.lossy:
        raise typer.Exit(1)


def _obey(player: BagPlayer, key: str) -> None:
    """Do what a key asks for."""
    playing = player.playing
    if key == ' ':
        (playing.resume if playing.paused else playing.pause)()
    elif key == 'right' and playing.paused:
        playing.play_next()
    elif key in {'up', 'down'}:
        playing.set_rate(
            min(max(playing.rate * RATE_STEP ** (1 if key == 'up' else -1), 1e-3), 1e3)
        )
    elif key == 'left':
        playing.seek(max(playing.position() - 10_000_000_000, playing.excerpt.begin))


def _progress(player: BagPlayer) -> str:
    playing = player.playing
    elapsed, whole = (
        (stamp - playing.excerpt.begin) * 1e-9
        for stamp in (playing.position(), playing.excerpt.end)
    )
    state = 'paused' if playing.paused else f'at {playing.rate:.2f} times'
    return f'{elapsed:.1f} of {whole:.1f} s, {state}; space, arrows, q'
