"""`agv bag hz` and `agv bag gaps`: how often messages came, and when they did not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from agv_motion.cli.bag.options import Bag, Topics, opened, readable
from agv_motion.cli.terminal import LineTable, terminal

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from agv_motion.bag.reader import BagReader

Header = Annotated[
    bool, typer.Option('--header', help='By the stamps in the headers, not by their arrival.')
]


def hz(bag: Bag, topic_name: Topics = None, *, header: Header = False) -> None:
    """Tell how often the messages of each topic came: mean rate, shortest and longest interval.

    Examples: agv bag hz walk
              agv bag hz walk /odom --header
    """
    table = _table('topic', 'rate', 'min_delta', 'max_delta', 'std_dev', 'messages')
    with opened(bag, validate=False) as reader:
        for topic, stamps in sorted(_times(reader, topic_name, header=header)[0].items()):
            table.add_row(topic, *_rate(stamps), str(len(stamps)))
        terminal().print(table)


def _rate(stamps: NDArray[np.int64]) -> list[str]:
    """Return rate, shortest and longest interval, and their spread; empty without an interval."""
    steps = np.diff(np.sort(stamps)) * 1e-9
    if not len(steps):
        return ['', '', '', '']
    rate = 1.0 / steps.mean() if steps.any() else np.inf
    return [
        *(f'{rate:.3f}', f'{steps.min():.3f}s'),
        *(f'{steps.max():.3f}s', f'{steps.std():.5f}s'),
    ]


def gaps(
    bag: Bag,
    topic_name: Topics = None,
    *,
    header: Header = False,
    factor: Annotated[
        float, typer.Option(min=1.0, help='Number of usual intervals that make a gap ...')
    ] = 5.0,
    longer: Annotated[float, typer.Option(min=0.0, help='... and longer than this [s].')] = 0.0,
) -> None:
    """List the silences of each topic, and about how many messages are missing in each.

    The usual interval is the median; topics without one (few or irregular messages) are left out
    unless they are named. Example: agv bag gaps walk --longer 0.5
    """
    from agv_motion.bag.checks.silences import regular, silences

    table = _table('topic', 'after', 'silence', 'usual', 'missing')
    with opened(bag, validate=False) as reader:
        times, start = _times(reader, topic_name, header=header)
        for topic, stamps in sorted(times.items()):
            if not topic_name and not regular(stamps):
                continue
            for silence in silences(stamps, factor, longer):
                times_of = silence.after - start, silence.length, silence.usual
                cells = [f'{time * 1e-9:.3f}s' for time in times_of]
                table.add_row(topic, *cells, str(silence.missing))
        if table.row_count:
            terminal().print(table)
        else:
            typer.echo('No gaps')


def _table(*titles: str) -> LineTable:
    table = LineTable()
    for title in titles:
        table.add_column(title, justify='left' if title == 'topic' else 'right', overflow='fold')
    return table


def _times(
    bag: BagReader, topics: list[str] | None, *, header: bool
) -> tuple[dict[str, NDArray[np.int64]], int]:
    """Return the stamps of each topic, and the start of the bag [ns]."""
    from agv_motion.bag.cdr.definitions import begins_with_header
    from agv_motion.bag.checks.stamps import stamps
    from agv_motion.bag.columns.columns import read_topic

    if not header:
        return stamps(bag, topics), bag.start
    bag.require(topics or ())
    chosen = topics or [t for t, c in bag.topics.items() if begins_with_header(c.definition)]

    def times(topic: str) -> NDArray[np.int64]:
        return read_topic(bag, topic, ['header.stamp']).nanoseconds('header.stamp')

    return dict(readable(bag, chosen, times)), bag.start
