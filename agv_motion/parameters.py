"""Parameters declared once: type, default, unit, range and meaning in one row of a dataclass.

The core checks its own values against the row; the nodes make ROS parameters of it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, fields, is_dataclass
from functools import cache
from math import isfinite
from typing import TYPE_CHECKING, Any, get_type_hints

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from _typeshed import DataclassInstance

TIME_OF_DAY = 'HH:MM'
"""Unit of a text that is one: YAML 1.1 makes 600 of 10:00, so a whole number means minutes."""


@dataclass(frozen=True)
class Spec:
    """What there is to know of a parameter beside its type and default.

    The second half of an annotation: ``rate: Annotated[float, Spec('...', 'Hz', (1, 9))] = 5.0``.
    """

    description: str
    unit: str = ''
    between: tuple[float, float] | None = None
    """Closed range; of each element where the value is a tuple."""
    choices: tuple[str, ...] = ()
    dynamic: bool = False
    """Whether it may change while the robot runs."""


def rows(kind: type[DataclassInstance]) -> Iterator[tuple[str, Any, Spec]]:
    """Yield name, type and :class:`Spec` of each annotated field of a parameter dataclass.

    A subclass that gives another default repeats name and type alone: ``rate: float = 20.0``.
    """
    yield from _rows(kind)


@cache
def _rows(kind: type[DataclassInstance]) -> tuple[tuple[str, Any, Spec], ...]:
    told = {}
    for base in reversed(kind.__mro__):
        for name, annotation in get_type_hints(base, include_extras=True).items():
            for spec in getattr(annotation, '__metadata__', ()):
                if isinstance(spec, Spec):
                    told[name] = annotation.__origin__, spec
    return tuple((field.name, *told[field.name]) for field in fields(kind) if field.name in told)


def check(values: DataclassInstance) -> None:
    """Refuse values that their own rows forbid; call it from ``__post_init__``.

    Raises:
        ConfigurationError: A number is not finite or out of its range, or a text is no choice.

    """
    for name, _, spec in rows(type(values)):
        value = getattr(values, name)
        for element in value if isinstance(value, tuple) else (value,):
            _check_element(name, element, spec)


def _check_element(name: str, value: Any, spec: Spec) -> None:
    if spec.choices and value not in spec.choices:
        msg = f"{name} = '{value}': choose one of {', '.join(spec.choices)}"
        raise ConfigurationError(msg)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return
    unit = '' if spec.unit == '1' else spec.unit
    if not isfinite(value):
        of_unit = f' [{unit}]' * bool(unit)
        msg = f'{name} = {value}: must be a finite number ({spec.description}{of_unit})'
        raise ConfigurationError(msg)
    if spec.between and not spec.between[0] <= value <= spec.between[1]:
        low, high = spec.between
        within = f'[{low:g}, {high:g}] {unit}'.rstrip()
        msg = f'{name} = {value}: must lie in {within} ({spec.description})'
        raise ConfigurationError(msg)


MOVED = (
    (r'(follow|tracking)\.leash\.(\w+)', r'\1.pace.\2'),
    (r'(follow\.ghost|tracking\.ghost|limits)\.track', 'track'),
)
"""Old names of parameters, as patterns, and what each is called now."""


def moved(name: str) -> str:
    """Return what an old parameter is called now; empty if it is none of the old ones."""
    for old, new in MOVED:
        found = re.fullmatch(old, name)
        if found:
            return found.expand(new)
    return ''


def nested(kind: type[DataclassInstance]) -> Iterator[tuple[str, type[DataclassInstance]]]:
    """Yield the fields of ``kind`` that are groups of parameters, with the class of each."""
    yield from _nested(kind)


@cache
def _nested(kind: type[DataclassInstance]) -> tuple[tuple[str, type[DataclassInstance]], ...]:
    hints = get_type_hints(kind)
    return tuple(
        (field.name, hints[field.name])
        for field in fields(kind)
        if is_dataclass(hints[field.name]) and isinstance(hints[field.name], type)
    )
