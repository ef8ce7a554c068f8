"""Rows of parameters: checked by themselves, whatever holds them."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf, nan
from typing import Annotated

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check, nested, rows


@dataclass(frozen=True)
class Motor:
    """One group of rows."""

    lag: Annotated[float, Spec('time constant', 's', (0.0, 10.0))] = 0.1


@dataclass(frozen=True)
class Robot:
    """A robot of every kind of row."""

    speed: Annotated[float, Spec('top speed', 'm/s', (0.0, 2.0))] = 1.0
    arms: Annotated[tuple[float, ...], Spec('lengths', 'm', (0.1, 3.0))] = (1.0, 2.0)
    mode: Annotated[str, Spec('what it does', choices=('walk', 'rest'))] = 'walk'
    silent: Annotated[bool, Spec('whether it hums')] = False
    not_a_parameter: int = 3
    motor: Motor = field(default_factory=Motor)


def test_rows_and_groups():
    assert [name for name, _, _ in rows(Robot)] == ['speed', 'arms', 'mode', 'silent']
    assert list(nested(Robot)) == [('motor', Motor)]


def test_what_keeps_to_its_row_passes():
    check(Robot())
    check(Robot(speed=0.0, arms=(), mode='rest', silent=True))


@pytest.mark.parametrize(
    ('change', 'message'),
    [
        ({'speed': 2.5}, r'speed = 2\.5: must lie in \[0, 2\] m/s \(top speed\)'),
        ({'speed': nan}, 'speed = nan: must be a finite number'),
        ({'arms': (1.0, inf)}, 'arms = inf: must be a finite number'),
        ({'arms': (1.0, 0.0)}, r'arms = 0\.0: must lie in \[0\.1, 3\] m'),
        ({'mode': 'fly'}, "mode = 'fly': choose one of walk, rest"),
    ],
)
def test_what_does_not_is_told_with_value_and_limit(change, message):
    with pytest.raises(ConfigurationError, match=message):
        check(Robot(**change))


@dataclass(frozen=True)
class FastRobot(Robot):
    """Another default; all else is told once, by the class that it comes from."""

    speed: float = 1.5


def test_another_default_keeps_unit_range_and_meaning():
    assert list(rows(FastRobot)) == list(rows(Robot))
    assert FastRobot().speed == 1.5
    with pytest.raises(ConfigurationError, match=r'speed = 2\.5: must lie in \[0, 2\] m/s'):
        check(FastRobot(speed=2.5))
