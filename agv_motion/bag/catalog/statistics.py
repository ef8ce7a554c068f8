"""How much was recorded over a season: hours, messages, bytes and gaps, by topic, day or month."""

from __future__ import annotations

from datetime import datetime, timezone
from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.catalog.find import limits

if TYPE_CHECKING:
    from collections.abc import Iterable

    from agv_motion.bag.catalog.find import Question
    from agv_motion.bag.catalog.index import BagIndex

SECOND = 10**9


class Period(Enum):
    """What a row of a season is about."""

    DAY = 'day'
    MONTH = 'month'


class Amount(NamedTuple):
    """What was recorded: of all, of a day, of a month; a bag counts where it begins (UTC)."""

    name: str
    bags: int
    seconds: float
    """of all bags together; those that overlap count each"""
    messages: int
    size: int
    """[bytes] of files"""
    gaps: int
    """times between bags in which nothing was recorded"""
    longest_gap: float
    """[s]"""


class TopicAmount(NamedTuple):
    """What was recorded of a topic."""

    name: str
    type: str
    bags: int
    seconds: float
    """of the bags that have it"""
    messages: int
    size: float | None
    """[bytes] of its messages, about; None: unknown"""


def amounts(index: BagIndex, asked: Question, period: Period | None, gap: float) -> list[Amount]:
    """Return what was recorded in each period, or in all.

    Args:
        index: Up to date.
        asked: Times; bags that reach into them are counted.
        period: Day or month; None: all in one.
        gap: [s] Shorter ones between two bags are none.

    """
    first, stop = limits(index, asked)
    rows = index.ask(
        'SELECT start, stop, messages, size FROM bag '
        'WHERE messages > 0 AND start < ? AND stop >= ? ORDER BY start', (stop, first),
    )  # fmt: skip
    groups: dict[str, list[tuple[int, int, int, int]]] = {}
    for row in rows:
        groups.setdefault(_period(row[0], period), []).append(row)
    return [_amount(name, group, gap) for name, group in groups.items()]


def topic_amounts(index: BagIndex, asked: Question) -> list[TopicAmount]:
    """Return what was recorded of each topic, by name and type."""
    first, stop = limits(index, asked)
    rows = index.ask(
        'SELECT name, type, count(), sum(bag.stop - bag.start) / 1e9, sum(topic.messages), '
        'CASE WHEN count() = count(topic.size) THEN sum(topic.size) END '
        'FROM topic JOIN bag ON bag.id = topic.bag '
        'WHERE bag.messages > 0 AND start < ? AND stop >= ? '
        'GROUP BY name, type ORDER BY name, type',
        (stop, first),
    )  # fmt: skip
    return [TopicAmount(*row) for row in rows]


def _amount(name: str, rows: Iterable[tuple[int, int, int, int]], gap: float) -> Amount:
    bags = messages = size = 0
    seconds = longest = 0.0
    gaps, latest = 0, None
    for start, stop, count, stored in rows:
        bags, messages, size = bags + 1, messages + count, size + stored
        seconds += (stop - start) / SECOND
        if latest is not None and (away := (start - latest) / SECOND) >= gap:
            gaps, longest = gaps + 1, max(longest, away)
        latest = stop if latest is None else max(latest, stop)
    return Amount(name, bags, seconds, messages, size, gaps, longest)


def _period(stamp: int, period: Period | None) -> str:
    if period is None:
        return 'all'
    day = datetime.fromtimestamp(stamp // SECOND, timezone.utc)
    return f'{day:%Y-%m-%d}' if period is Period.DAY else f'{day:%Y-%m}'
