"""`agv topic delay`: how old the messages of a topic are when they come, by their stamps."""

from __future__ import annotations

from collections import deque
from statistics import fmean, pstdev
from typing import Annotated, Any

import typer

from agv_motion.cli.graph.discovery import DISCOVERY
from agv_motion.cli.graph.options import SimTime, SpinTime
from agv_motion.cli.graph.session import joined
from agv_motion.cli.topic.options import Topic
from agv_motion.cli.topic.rates import Duration, every_second, subscribe
from agv_motion.errors import ConfigurationError


class Delays:
    """Ages of the messages of one topic."""

    def __init__(self, window: int) -> None:
        """Keep the last ``window`` ages."""
        self._ages: deque[float] = deque(maxlen=window)
        self._first = self._last = self._told = -1.0

    def add(self, stamp: float, now: float) -> None:
        """Note a message with its ``stamp`` at ``now`` [s]; a clock that jumps back starts anew.

        As for ros2, the first message counts for nothing, and nothing counts before the clock runs.
        """
        if now <= 0.0 or self._first < 0.0 or self._first > now:
            self._ages.clear()
            self._first = now if now > 0.0 else -1.0
        else:
            self._ages.append(now - stamp)
        self._last = now

    def text(self) -> str:
        """Return what to print now; empty if nothing has come yet."""
        if not self._ages:
            return ''
        if self._last == self._told:
            return 'no new messages'
        self._told = self._last
        ages = self._ages
        return (
            f'average delay: {fmean(ages):.3f}\n\tmin: {min(ages):.3f}s max: {max(ages):.3f}s '
            f'std dev: {pstdev(ages):.5f}s window: {len(ages)}'
        )


def delay(
    topic: Topic,
    *,
    window: Annotated[
        int, typer.Option('-w', '--window', min=1, help='How many messages to average over.')
    ] = 10000,
    duration: Duration = 0.0,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
) -> None:
    """Tell how old messages are when they come, by the stamps in their headers.

    Example: agv topic delay /odom --use-sim-time
    """
    delays = Delays(window)
    with joined(spin_time, use_sim_time=use_sim_time, endless=True) as node:

        def measure(message: Any) -> None:
            stamp = _stamp(message, topic)
            now = node.get_clock().now().nanoseconds
            delays.add((stamp.sec * 10**9 + stamp.nanosec) * 1e-9, now * 1e-9)

        subscribe(node, [topic], lambda _: measure, raw=False)

        def tell() -> None:
            text = delays.text()
            if text:
                typer.echo(text)

        every_second(node, tell, duration)


def _stamp(message: Any, topic: str) -> Any:
    """Return the stamp of a message."""
    header = getattr(message, 'header', None)
    if header is None:
        msg = f"msg does not have header: of '{topic}', {type(message).__name__}"
        raise ConfigurationError(msg)
    return header.stamp
