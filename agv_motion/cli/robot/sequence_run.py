"""`agv sequence` for real: the node of this package, with a bar that shows how far it is."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING

from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from agv_motion.cli.terminal import terminal

if TYPE_CHECKING:
    from pathlib import Path

    from agv_motion.nodes.sequence import SequenceNode
    from agv_motion.ros.stop import Stop

LONGEST_BRAKING = 10.0
"""[s] After Ctrl-C the robot brakes on its way; it is stopped at once after so long."""


def perform(file: str, config: Path | None, arguments: list[str]) -> None:
    """Perform the sequence of ``file``; exits with 1 unless all of it was done.

    Args:
        file: A path, or a file of config/.
        config: Parameter file, or none.
        arguments: For ROS.

    """
    import rclpy

    from agv_motion.arbitration.source import TwistSource
    from agv_motion.cli.robot.source_topic import arguments_for
    from agv_motion.nodes.sequence import SequenceNode
    from agv_motion.ros.context import begin_context
    from agv_motion.ros.live_node import LiveNode
    from agv_motion.ros.run import overrides, spin, start
    from agv_motion.ros.stop import Stop

    extra = ['--ros-args', '--params-file', str(config), '--'] if config else []
    begin_context(args=['sequence', *extra, *arguments])
    try:
        stop = Stop()
        node = LiveNode(
            SequenceNode,
            parameter_overrides=overrides(file=file, autorun=True),
            cli_args=arguments_for(TwistSource.SEQUENCE, '_agv_sequence'),
        )
        start(node)
        console = terminal(stderr=True)
        columns = (TextColumn('{task.description}', markup=False), BarColumn(), TimeElapsedColumn())
        with Progress(*columns, console=console, disable=not console.is_terminal) as progress:
            watch = Watch(node.plain, stop, progress)
            spin([node], watch.over)
    finally:
        rclpy.try_shutdown()
    if not watch.done:
        sys.exit(1)


class Watch:
    """Looks at the node again and again, and tells when it is over."""

    def __init__(self, node: SequenceNode, stop: Stop, progress: Progress) -> None:
        """Begin to look."""
        self.done = False
        """Whether all actions were performed"""
        self._node, self._stop, self._progress = node, stop, progress
        self._task = progress.add_task('', total=1.0)
        self._told = ''
        self._braking_since: float | None = None

    def over(self) -> bool:
        """Show how far it is; return whether it is over."""
        from agv_motion.sequence.runner import SequenceState

        node, runner = self._node, self._node.runner
        self._show(node.told if runner or node.refusal else f'waiting: {node.lost}')
        if runner is None:
            return self._stop.requested or bool(node.refusal)
        self.done = runner.status.state is SequenceState.DONE
        if self._stop.requested and self._braking_since is None:
            self._braking_since = time.monotonic()
            runner.abort()
        since = self._braking_since
        return runner.ended or (since is not None and time.monotonic() - since > LONGEST_BRAKING)

    def _show(self, words: str) -> None:
        self._progress.update(self._task, completed=self._node.share_done(), description=words)
        if words != self._told:
            self._told = words
            if self._progress.disable:
                print(words, flush=True)  # noqa: T201 - no terminal: one line a change
