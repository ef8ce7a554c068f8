"""Options that the verbs of `agv bag` share, and the text of times."""

from __future__ import annotations

from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from agv_motion.bag.reader import BagReader

Bag = Annotated[Path, typer.Argument(help='Bag: its folder, or one .mcap or .db3 file.')]
Topics = Annotated[
    list[str] | None, typer.Argument(help="Topics, such as '/odom'; all if none is given.")
]
StartOffset = Annotated[
    float, typer.Option(min=0, help='Begin so many seconds after the start of the bag.')
]
Duration = Annotated[
    float, typer.Option('--playback-duration', help='Seconds of the bag; negative: all.')
]


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
