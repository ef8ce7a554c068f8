"""`agv topic hz` and `bw`: how often, how much; in the form of `ros2 topic`."""

from __future__ import annotations

import time
from collections import deque
from statistics import fmean, pstdev
from typing import Annotated, Any

import typer

from agv_motion.cli.graph.completion import topic_names
from agv_motion.cli.graph.discovery import DISCOVERY
from agv_motion.cli.graph.options import SimTime, SpinTime
from agv_motion.cli.graph.session import joined, spin, topic_class
from agv_motion.cli.topic.message_printer import predicate
from agv_motion.cli.topic.options import Topic

Duration = Annotated[float, typer.Option(help='Stop after so many seconds; 0: never.', min=0.0)]


class Intervals:
    """Times between the messages of one topic."""

    def __init__(self, window: int) -> None:
        """Keep the last ``window`` intervals."""
        self._intervals: deque[float] = deque(maxlen=window)
        self._last: float | None = None
        self._told: float | None = None

    def add(self, now: float) -> None:
        """Note a message at ``now`` [s]; a clock that jumps back starts anew."""
        if self._last is not None and now >= self._last:
            self._intervals.append(now - self._last)
        elif self._last is not None:
            self._intervals.clear()
        self._last = now

    def statistics(self) -> tuple[float, float, float, float, int] | None:
        """Return rate [Hz], shortest, longest, deviation [s], count; None if nothing is new."""
        if not self._intervals or self._last == self._told:
            return None
        self._told = self._last
        mean = fmean(self._intervals)
        rate = 1.0 / mean if mean > 0.0 else 0.0
        times = self._intervals
        return rate, min(times), max(times), pstdev(times), len(times)


def hz(
    topic_name: Annotated[
        list[str], typer.Argument(help='One topic or several.', autocompletion=topic_names)
    ],
    *,
    window: Annotated[
        int, typer.Option('-w', '--window', min=1, help='How many messages to average over.')
    ] = 10000,
    filter_expr: Annotated[
        str, typer.Option('--filter', help='Count only messages m for which this is true.')
    ] = '',
    wall_time: Annotated[
        bool, typer.Option('--wall-time', help='Measure with the wall clock, not ROS time.')
    ] = False,
    duration: Duration = 0.0,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
) -> None:
    """Tell how often messages come.

    Example: agv topic hz /turrets/command
    """
    intervals = {topic: Intervals(window) for topic in topic_name}
    wanted = predicate(filter_expr)
    with joined(spin_time, use_sim_time=use_sim_time, endless=True) as node:

        def counter(topic: str) -> Any:
            def count(message: Any) -> None:
                if wanted(message):
                    clock = node.get_clock().now().nanoseconds * 1e-9
                    intervals[topic].add(time.time() if wall_time else clock)

            return count

        subscribe(node, topic_name, counter, raw=not filter_expr)
        every_second(node, lambda: _tell(intervals), duration)


def subscribe(node: Any, names: list[str], callback: Any, *, raw: bool) -> None:
    """Wait for topics, and give to each the callback that ``callback(topic)`` returns."""
    from rclpy.qos import qos_profile_sensor_data

    for topic in names:
        kind = topic_class(node, topic, wait=True)
        node.create_subscription(kind, topic, callback(topic), qos_profile_sensor_data, raw=raw)
        if len(names) > 1:
            typer.echo(f'Subscribed to [{topic}]')


def every_second(node: Any, tell: Any, duration: float) -> None:
    """Spin ``node`` and ``tell()`` every second, for ``duration`` [s] or (0) for ever."""
    start = time.monotonic()
    second = 1
    while not duration or second <= duration:
        due = start + second
        spin(node, lambda due=due: time.monotonic() >= due)  # type: ignore[misc]
        tell()
        second += 1


def _tell(intervals: dict[str, Intervals]) -> None:
    rows = [(topic, one.statistics()) for topic, one in intervals.items()]
    known = [(topic, row) for topic, row in rows if row is not None]
    if len(intervals) == 1:
        for _, (rate, low, high, deviation, count) in known:
            typer.echo(
                f'average rate: {rate:.3f}\n\tmin: {low:.3f}s max: {high:.3f}s '
                f'std dev: {deviation:.5f}s window: {count}'
            )
    elif known:
        header = ['topic', 'rate', 'min_delta', 'max_delta', 'std_dev', 'window']
        cells = [
            [topic, f'{r:.3f}', f'{low:.3f}', f'{high:.3f}', f'{deviation:.5f}', str(count)]
            for topic, (r, low, high, deviation, count) in known
        ]
        widths = [max(map(len, column)) for column in zip(header, *cells, strict=True)]
        typer.echo('   '.join(h.center(w) for h, w in zip(header, widths, strict=True)))
        typer.echo('=' * (sum(widths) + 3 * (len(header) - 1)))
        for row in cells:
            typer.echo('   '.join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)))
        typer.echo()


def bw(
    topic: Topic,
    *,
    window: Annotated[
        int, typer.Option('-w', '--window', min=1, help='How many messages to average over.')
    ] = 100,
    duration: Duration = 0.0,
    spin_time: SpinTime = DISCOVERY,
    use_sim_time: SimTime = False,
) -> None:
    """Tell how many bytes come.

    Example: agv topic bw /turrets/command
    """
    seen: deque[tuple[float, int]] = deque(maxlen=window)
    with joined(spin_time, use_sim_time=use_sim_time, endless=True) as node:

        def weigh(data: bytes) -> None:
            seen.append((node.get_clock().now().nanoseconds * 1e-9, len(data)))

        subscribe(node, [topic], lambda _: weigh, raw=True)
        typer.echo(f'Subscribed to [{topic}]')
        every_second(
            node,
            lambda: _tell_bytes(list(seen), node.get_clock().now().nanoseconds * 1e-9),
            duration,
        )


def _tell_bytes(seen: list[tuple[float, int]], now: float) -> None:
    if len(seen) < 2 or now <= seen[0][0]:
        return
    sizes = [size for _, size in seen]
    rate = sum(sizes) / (now - seen[0][0])
    divisor, form = next(
        (divisor, form)
        for limit, divisor, form in (
            (1e3, 1.0, '{:.0f} B'),
            (1e6, 1e3, '{:.2f} KB'),
            (float('inf'), 1e6, '{:.2f} MB'),
        )
        if rate < limit
    )
    speed, mean, low, high = (
        form.format(value / divisor) for value in (rate, fmean(sizes), min(sizes), max(sizes))
    )
    typer.echo(
        f'{speed}/s from {len(seen)} messages\n\tMessage size mean: {mean} min: {low} max: {high}'
    )
