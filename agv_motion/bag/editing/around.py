"""When something happened in a bag: the times at which a field met a condition.

``/turrets/residual > 0.02``, ``/odom/twist/twist/linear/x >= 0.5``, ``/joints/velocity[2] < -1``,
``/state == stopped``, ``/state ~ stop`` (a text in which this is found).
"""

from __future__ import annotations

import operator
import re
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from agv_motion.bag.columns.column import Ragged, Texts
from agv_motion.bag.columns.columns import read_topic
from agv_motion.bag.columns.field_name import topic_and_field
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.bag.columns.column import Column
    from agv_motion.bag.reader import BagReader

OPERATORS = {
    '>=': operator.ge, '<=': operator.le, '==': operator.eq, '!=': operator.ne, '>': operator.gt,
    '<': operator.lt,
}  # fmt: skip
FOUND = '~'
"""A text in which another is found."""
_FORM = re.compile(r'\s*(\S+?)(?:\[(\d{1,9})\])?\s*(>=|<=|==|!=|>|<|~)\s*(\S.*?)\s*')
_MOST_NAMED = 12
"""Fields that an error tells."""


class Condition(NamedTuple):
    """What a field is compared with."""

    name: str
    """topic and field, such as ``/odom/twist/twist/linear/x``"""
    place: int | None
    """in an array; None: any of its elements may meet the condition"""
    comparison: str
    value: str

    def __str__(self) -> str:
        """Return it as it is written."""
        place = '' if self.place is None else f'[{self.place}]'
        return f'{self.name}{place} {self.comparison} {self.value}'


class Happenings(NamedTuple):
    """When a condition was met."""

    events: int
    """how many times it began to be met"""
    stamps: NDArray[Any]
    """[ns] log times of all messages that met it, in order"""


def condition(text: str) -> Condition:
    """Return a condition that somebody wrote.

    Raises:
        ConfigurationError: It is none.

    """
    found = _FORM.fullmatch(text)
    if found is None:
        msg = (
            f"'{text}' is no condition: give topic and field, a comparison (>, >=, <, <=, ==, !=, "
            "~) and a value, such as '/turrets/residual > 0.02' or '/state ~ stopped'"
        )
        raise ConfigurationError(msg)
    name, place, comparison, value = found.groups()
    return Condition(name, None if place is None else int(place), comparison, value.strip('\'"'))


def happenings(bag: BagReader, wanted: Condition) -> Happenings:
    """Return when a condition was met.

    Raises:
        ConfigurationError: There is no such field, or it cannot be compared with such a value.
        SourceError: The bag is damaged.

    """
    topic, field = topic_and_field(bag, wanted.name)
    columns = read_topic(bag, topic, [field] if field else None)
    try:
        path, column = _only(wanted, columns.fields, named=bool(field))
        met = _met(wanted, path, column)
    except ConfigurationError as error:
        msg = f'bag {bag.path}: {error}'
        raise ConfigurationError(msg) from None
    order = np.argsort(columns.stamps, kind='stable')
    met = met[order]
    begins = met & ~np.concatenate((np.zeros(1, bool), met[:-1]))
    return Happenings(int(begins.sum()), columns.stamps[order][met])


def windows(
    stamps: Sequence[int] | NDArray[Any], before: int, after: int
) -> tuple[tuple[int, int], ...]:
    """Return the times around moments: from ``before`` to ``after`` each [ns], overlapping joined.

    Args:
        stamps: [ns] in order.
        before: [ns] that each window begins earlier.
        after: [ns] that it goes on, the moment included.

    """
    found: list[tuple[int, int]] = []
    for stamp in map(int, stamps):
        start, stop = max(stamp - before, 0), stamp + after + 1
        if found and start <= found[-1][1]:
            found[-1] = found[-1][0], stop
        else:
            found.append((start, stop))
    return tuple(found)


def _only(wanted: Condition, fields: dict[str, Column], *, named: bool) -> tuple[str, Column]:
    """Return the one field that is meant; what is in headers is not, unless it is named."""
    texts = wanted.comparison == FOUND or not _is_number(wanted.value)
    fits = {
        path: column
        for path, column in fields.items()
        if _is_text(column) == texts and (named or not re.search(r'(^|\.)header\.', path))
    }
    if len(fits) == 1:
        return next(iter(fits.items()))
    kind = 'texts' if texts else 'numbers'
    names = ', '.join(list(fits or fields)[:_MOST_NAMED])
    what = f'has {len(fits)} {kind}' if fits else f'has no {kind}'
    msg = f"'{wanted}': {wanted.name} {what} ({names}): name one field that can be compared"
    raise ConfigurationError(msg)


def _is_text(column: Column) -> bool:
    return isinstance(column.values if isinstance(column, Ragged) else column, Texts)


def _is_number(text: str) -> bool:
    try:
        return not np.isnan(float(text))
    except ValueError:
        return text in ('true', 'false')


def _met(wanted: Condition, path: str, column: Column) -> NDArray[np.bool_]:
    """Return which messages meet a condition: one element of an array does, or that which is named.

    Raises:
        ConfigurationError: The place is outside of the array, or there is no array.

    """
    if isinstance(column, Ragged):
        each = _compared(wanted, column.values)
        flat = np.asarray(_rows(each).any(axis=1))
        if wanted.place is not None:
            long = column.lengths > wanted.place
            met = np.zeros(len(column), bool)
            met[long] = flat[column.offsets[:-1][long] + wanted.place]
            return met
        before: NDArray[np.int64] = np.concatenate(([0], np.cumsum(flat))).astype(np.int64)
        return np.asarray(before[column.offsets[1:]] > before[column.offsets[:-1]])
    each = _compared(wanted, column)
    table = _rows(each)
    if wanted.place is None:
        return np.asarray(table.any(axis=1))
    if each.ndim == 1 or wanted.place >= table.shape[1]:
        size = f'an array of {table.shape[1]}' if each.ndim > 1 else 'no array'
        msg = f"'{wanted}': {path} is {size}: count its elements from 0"
        raise ConfigurationError(msg)
    return np.asarray(table[:, wanted.place])


def _rows(each: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return all elements of each message in a row; there may be none of either."""
    return each.reshape(len(each), int(np.prod(each.shape[1:])))


def _compared(wanted: Condition, column: Column) -> NDArray[np.bool_]:
    """Return for each element whether it meets the condition; NaN meets none but ``!=``."""
    assert not isinstance(column, Ragged), 'sequences of sequences are no numbers'
    if isinstance(column, Texts):
        if wanted.comparison == FOUND:
            fits = [wanted.value in value for value in column.values]
        elif wanted.comparison in ('==', '!='):
            same = wanted.comparison == '=='
            fits = [(value == wanted.value) == same for value in column.values]
        else:
            msg = f"'{wanted}': texts are compared by ==, != and ~"
            raise ConfigurationError(msg)
        return np.array(fits, bool)[column.codes] if fits else np.zeros(column.shape, bool)
    words = {'true': 1.0, 'false': 0.0}
    value = words[wanted.value] if wanted.value in words else float(wanted.value)
    return np.asarray(OPERATORS[wanted.comparison](column, value))
