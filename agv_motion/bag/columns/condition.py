"""Conditions on a field as people write them: `/turrets/residual > 0.02`, `/state ~ stopped`.

Topic and field, a place in an array if need be, a comparison and a value:
``/odom/twist/twist/linear/x >= 0.5``, ``/joints/velocity[2] < -1``, ``/state == stopped``,
``/state ~ stop`` (a text in which this is found). The same words for `agv bag cut --around`, for
`agv bag find --where` and for the triggers of a recorder.
"""

from __future__ import annotations

import math
import operator
import re
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.bag.columns.column import Ragged, Texts
from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from agv_motion.bag.columns.column import Column

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
    name, place, comparison, given = found.groups()
    value = given.strip('\'"')
    if comparison in ('>', '>=', '<', '<=') and not (_is_number(value) and _is_finite(value)):
        msg = (
            f"'{text}': texts are compared by ==, != and ~, and '{comparison}' takes a finite "
            f"number, not '{value}', such as '{name} {comparison} 0.02'"
        )
        raise ConfigurationError(msg)
    return Condition(name, None if place is None else int(place), comparison, value)


def begins(met: NDArray[np.bool_], *, before: bool = False) -> NDArray[np.bool_]:
    """Return where a condition begins to be met; ``before``: whether it was met before them all."""
    return np.asarray(met & ~np.concatenate(([before], met[:-1])).astype(bool))


def meets(wanted: Condition, fields: Mapping[str, Column], *, named: bool) -> NDArray[np.bool_]:
    """Return which messages meet a condition.

    Args:
        wanted: The condition.
        fields: Columns of the messages, by the path of each field.
        named: Whether the condition names the field, and not the topic alone.

    Raises:
        ConfigurationError: There is no field that can be compared so, or several.

    """
    path, column = _only(wanted, fields, named=named)
    return _met(wanted, path, column)


def _only(wanted: Condition, fields: Mapping[str, Column], *, named: bool) -> tuple[str, Column]:
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


def _is_finite(number: str) -> bool:
    return number in ('true', 'false') or math.isfinite(float(number))


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
