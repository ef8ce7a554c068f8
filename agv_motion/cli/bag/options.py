"""Options that the verbs of `agv bag` share, and the text of times."""

from __future__ import annotations

from contextlib import contextmanager, nullcontext
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeVar

import typer

from agv_motion.errors import AgvMotionError, SourceError
from agv_motion.visible import indented

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator

    from agv_motion.bag.reader import BagReader

Bag = Annotated[Path, typer.Argument(help='Bag: its folder, or one .mcap or .db3 file.')]
Topics = Annotated[
    list[str] | None, typer.Argument(help="Topics, such as '/odom'; all if none is given.")
]
StartOffset = Annotated[
    float,
    typer.Option(min=0, help='Number of seconds after the start of the bag at which to begin.'),
]
Duration = Annotated[
    float, typer.Option('--playback-duration', help='Seconds of the bag; negative: all.')
]


Read = TypeVar('Read')


@contextmanager
def opened(path: Path, *, validate: bool = True) -> Iterator[BagReader]:
    """Open a bag and tell on stderr what is amiss: the one door to a bag of every command.

    After the block, in which the command says what it found, it ends with status 1 where something
    is lost.

    Raises:
        SourceError: There is no bag, or it cannot be read at all.

    """
    from agv_motion.bag.reader import BagReader

    with BagReader(path, validate=validate) as bag:
        tell(bag.problems)
        yield bag
        lossy = bag.lossy
    if lossy:
        raise typer.Exit(1)


def tell(problems: Iterable[object]) -> None:
    """Tell on stderr what is amiss in a bag."""
    for problem in problems:
        typer.echo(f'warning: {indented(problem)}', err=True)


def readable(
    bag: BagReader, topics: Collection[str], read: Callable[[str], Read]
) -> Iterator[tuple[str, Read]]:
    """Yield what is read of each topic; one that cannot be read is skipped, and named on stderr.

    That is a problem of the bag then: see :func:`opened`.

    Raises:
        AgvMotionError: The only topic cannot be read.

    """
    for topic in topics:
        with nullcontext() if len(topics) == 1 else _skipping(bag, topic):
            yield topic, read(topic)


@contextmanager
def _skipping(bag: BagReader, topic: str) -> Iterator[None]:
    try:
        yield
    except AgvMotionError as error:
        bag.problems.append(SourceError(f'{topic} is skipped: {error}'))
        typer.echo(f'error: {indented(bag.problems[-1])}', err=True)


def span(bag: BagReader, start_offset: float, duration: float) -> tuple[int | None, int | None]:
    """Return first log time [ns] and the one before which to stop; None where there is no limit."""
    first = bag.start + round(start_offset * 1e9)
    start = first if start_offset else None
    return start, None if duration < 0 else first + round(duration * 1e9)


def moment(stamp: int) -> str:
    """Return a time [ns] as `ros2 bag info` writes it, in UTC."""
    seconds, rest = divmod(stamp, 10**9)
    try:
        day = datetime.fromtimestamp(seconds, timezone.utc)
    except (ValueError, OverflowError, OSError):
        return f'({seconds}.{rest:09d})'
    return f'{day:%b %d %Y %H:%M:%S}.{rest:09d} UTC ({seconds}.{rest:09d})'
