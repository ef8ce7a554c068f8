"""Bags of an index in which something is: a topic, a type, a time, a field that met a condition."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.bag.columns.condition import condition
from agv_motion.bag.editing.around import happenings, windows
from agv_motion.bag.editing.moments import moment
from agv_motion.bag.reader import BagReader
from agv_motion.bag.sqlite.file import LATEST
from agv_motion.errors import AgvMotionError, ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path
    from typing import Any

    from agv_motion.bag.catalog.index import BagIndex

SECOND = 10**9
APART = 10 * SECOND
"""[ns] between messages that met a condition, from which on they are two spans"""


@dataclass(frozen=True)
class Question:
    """What is looked for; the default is every bag."""

    topics: tuple[str, ...] = ()
    """all of them; `*` and `?` stand for anything"""
    types: tuple[str, ...] = ()
    begin: str = ''
    """a moment as of `agv_motion.bag.editing.moments`, counted from the first bag"""
    end: str = ''
    where: str = ''
    """a condition as of `agv_motion.bag.columns.condition`"""


class FoundBag(NamedTuple):
    """A bag."""

    path: Path
    start: int
    """[ns] log times"""
    end: int
    messages: int
    size: int
    """[bytes]"""
    fault: str
    spans: tuple[tuple[int, int], ...] = ()
    """[ns] from the first to the last message each that met the condition"""


def limits(index: BagIndex, asked: Question) -> tuple[int, int]:
    """Return the first log time and the one before which to stop [ns].

    Raises:
        ConfigurationError: There is no such moment, or they are the wrong way round.

    """
    ((start, end),) = index.ask(
        'SELECT ifnull(min(start), 0), ifnull(max(stop), 0) FROM bag WHERE messages > 0'
    )
    first = moment(asked.begin, start, end) if asked.begin else 0
    stop = moment(asked.end, start, end) if asked.end else LATEST
    if first >= stop:
        msg = f"from '{asked.begin}' until '{asked.end}': expected the earlier one first"
        raise ConfigurationError(msg)
    return min(first, LATEST), min(stop, LATEST)


def find(
    index: BagIndex, asked: Question,
    tell: Callable[[int, int], None] = lambda _done, _all: None,
    complain: Callable[[str], None] = lambda _: None,
) -> Iterator[FoundBag]:  # fmt: skip
    """Yield the bags that fit, in the order of time.

    Args:
        index: Up to date.
        asked: What is looked for.
        tell: Called with the number of bags that were looked into, and of all.
        complain: Called with why one could not be looked into.

    Raises:
        ConfigurationError: The question cannot be understood, or no bag has such a topic.

    """
    wanted = condition(asked.where) if asked.where else None
    first, stop = limits(index, asked)
    rows = _rows(index, asked, first, stop)
    fitting = False
    for number, row in enumerate(rows):
        tell(number, len(rows))
        one = FoundBag(index.decoded(row[1]), *row[2:])
        if wanted is None:
            yield one
            continue
        if not _may_have(index, row[0], wanted.name):
            continue
        fitting = True
        try:
            with BagReader(one.path) as bag:
                stamps = happenings(bag, wanted).stamps
        except AgvMotionError as error:
            complain(str(error))
            continue
        spans = windows(stamps[(stamps >= first) & (stamps < stop)], 0, APART)
        if spans:
            yield one._replace(spans=tuple((a, b - 1 - APART) for a, b in spans))
    if wanted is not None and rows and not fitting:
        msg = (
            f"'{wanted}': {wanted.name} is in none of {len(rows)} bags in {index.folder}: agv bag "
            'stats names topics'
        )
        raise ConfigurationError(msg)


def _rows(index: BagIndex, asked: Question, first: int, stop: int) -> list[Any]:
    where, values = ['(messages > 0 AND start < ? AND stop >= ?)'], [stop, first]
    if not (asked.topics or asked.types or asked.begin or asked.end or asked.where):
        where = [f'({where[0]} OR messages = 0)']
    given: list[Any] = list(values)
    for column, names in (('name', asked.topics), ('type', asked.types)):
        for name in names:
            where.append(f'id IN (SELECT bag FROM topic WHERE {column} GLOB ?)')  # noqa: S608 - a name of ours
            given.append(name)
    columns = 'id, path, start, stop, messages, size, fault'
    query = f'SELECT {columns} FROM bag WHERE {" AND ".join(where)}'  # noqa: S608 - no user's text
    return index.ask(f'{query} ORDER BY start, path', given)


def _may_have(index: BagIndex, bag: int, name: str) -> bool:
    """Return whether some topic of a bag is the beginning of a name."""
    topics = index.ask('SELECT name FROM topic WHERE bag = ?', (bag,))
    return any(f'{name}/'.startswith(f'{topic}/') for (topic,) in topics)
