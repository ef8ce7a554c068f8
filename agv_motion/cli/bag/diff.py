"""`agv bag diff`: what sets two bags apart."""

from __future__ import annotations

from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.progress import track

from agv_motion.cli.bag.options import opened
from agv_motion.cli.terminal import LineTable, terminal
from agv_motion.errors import ConfigurationError
from agv_motion.visible import in_line

if TYPE_CHECKING:
    from rich.console import Console

    from agv_motion.bag.editing.diff import Difference, TopicDiff


def diff(
    first: Annotated[Path, typer.Argument(help='Bag with what should be.')],
    second: Annotated[Path, typer.Argument(help='Bag with what is.')],
    *,
    topics: Annotated[
        list[str] | None, typer.Option(help='Compare only this; one per option.')
    ] = None,
    common: Annotated[
        bool, typer.Option('--common', help='Compare only the topics that both bags have.')
    ] = False,
    tolerance: Annotated[
        float, typer.Option('-t', '--tolerance', min=0, help='By which numbers may differ.')
    ] = 0.0,
    relative: Annotated[
        float, typer.Option(min=0, help='... plus this share of the larger number.')
    ] = 0.0,
    within: Annotated[
        float | None,
        typer.Option(
            min=0, help='Pair the nearest, up to this number of seconds apart, not equal stamps.'
        ),
    ] = None,
    by_place: Annotated[
        bool, typer.Option('--by-place', help='Pair first with first, whatever their stamps.')
    ] = False,
) -> None:
    """Compare two bags topic by topic; the exit status is 0 if they are the same, 1 if not.

    Messages are paired by equal stamps in their headers, those without header by their place; with
    --within by the nearest time (of the header, or of arrival), and times in them may differ by as
    much. Of each field that differs, the two values furthest apart are told. Examples:
    agv bag diff before after
    agv bag diff before after --topics /cmd_vel -t 1e-9
    agv bag diff live reprocessed --common --within 0.05
    """
    from agv_motion.bag.editing import diff as comparison
    from agv_motion.bag.editing.pairing import Pairing

    _require_finite(tolerance=tolerance, relative=relative, within=within)
    pairing = Pairing(by_place, None if within is None else round(within * 1e9))
    limits = comparison.Tolerance(tolerance, relative)
    with opened(first) as one, opened(second) as other:
        chosen = topics or sorted(
            set(one.topics) & set(other.topics) if common else {*one.topics, *other.topics}
        )
        found = [
            topic
            for name in track(chosen, 'Comparing', console=terminal(stderr=True), transient=True)
            for topic in comparison.diff(one, other, [name], limits, pairing)
        ]
        _tell(found, one.start, by_stamp=pairing == Pairing())
    if not all(topic.same for topic in found):
        raise typer.Exit(1)


def _require_finite(**options: float | None) -> None:
    for option, value in options.items():
        if value is not None and not isfinite(value):
            msg = f'--{option} {value}: give a finite number'
            raise ConfigurationError(msg)


def _tell(found: list[TopicDiff], start: int, *, by_stamp: bool) -> None:
    """Print what differs, and how to pair what has no partner of the same stamp."""
    console = terminal()
    console.print(_overview(found))
    for topic in found:
        _details(console, topic, start)
    unpaired = sum(topic.unpaired for topic in found)
    if unpaired and by_stamp:
        console.print(
            f'\n{unpaired} messages have no partner of the same stamp: --within SECONDS pairs '
            'the nearest, --by-place the first with the first'
        )


def _overview(found: list[TopicDiff]) -> LineTable:
    table = LineTable()
    for title in ('topic', 'first', 'second', 'differ', 'unpaired', ''):
        table.add_column(
            title,
            justify='left' if title in {'topic', ''} else 'right',
            overflow='fold',
        )
    for topic in found:
        verdict = 'same' if topic.same else topic.note or 'DIFFERENT'
        if topic.apart:
            verdict += f', times up to {topic.apart * 1e-9:.9g} s apart'
        table.add_row(
            topic.topic, *map(str, topic.counts), str(topic.differing), str(topic.unpaired),
            verdict, style='' if topic.same else 'red',
        )  # fmt: skip
    return table


def _details(console: Console, topic: TopicDiff, start: int) -> None:
    """Print the fields of a topic that differ, the worst first."""
    from agv_motion.bag.editing.diff import distance

    if topic.since is None:
        return
    since = (topic.since - start) * 1e-9
    console.print(f'\n{in_line(topic.topic)}, from {since:.3f} s on', highlight=False)

    def size(difference: Difference) -> float:
        return distance(difference.first, difference.second)

    worst = sorted(topic.worst.values(), key=size, reverse=True)
    for path, stamp, a, b in worst[:MOST_FIELDS]:
        console.print(
            f'  {in_line(f"{path}: {a} against {b}")} at {(stamp - start) * 1e-9:.3f} s',
            highlight=False,
        )
    if len(worst) > MOST_FIELDS:
        console.print(f'  and {len(worst) - MOST_FIELDS} fields more')


MOST_FIELDS = 10
"""of a topic that are told"""
