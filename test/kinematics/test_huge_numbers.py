"""What is finite and too large for the result is refused: no infinity comes out of a map."""

from __future__ import annotations

from itertools import product
from math import isfinite, pi

import numpy as np
import pytest

from agv_motion.errors import AgvMotionError
from agv_motion.kinematics import (
    DifferentialDrive,
    OmniWheels,
    Turrets,
    omniwheel_columns,
    turret_columns,
)
from agv_motion.planar import Twist

THIRDS, QUARTERS = [0.0, 2 * pi / 3, 4 * pi / 3], [0.0, pi / 2, pi, 3 * pi / 2]
PAIR = DifferentialDrive(0.5, (0.1, 0.1))
OMNI = OmniWheels.from_polar(THIRDS, [0.2] * 3, [0.05] * 3)
FOUR = OmniWheels.from_polar(QUARTERS, [0.2] * 4, [0.05] * 4)
TREE = Turrets.from_polar(THIRDS, [1.2] * 3)
COLUMN = np.array(THIRDS)[:, np.newaxis]
MAPS = [
    (2, PAIR.twist),
    (2, PAIR.rates),
    (2, PAIR.speeds),
    (2, lambda v: PAIR.command(Twist(v[0], 0.0, v[1]))),
    (3, lambda v: OMNI.command(Twist(*v))),
    (3, lambda v: OMNI.free_roller_speeds(Twist(*v))),
    (3, OMNI.rates),
    (3, OMNI.speeds),
    (3, OMNI.twist),
    (4, FOUR.twist),
    (3, lambda v: omniwheel_columns.command_columns(OMNI, np.array(v)[:, np.newaxis])),
    (3, lambda v: omniwheel_columns.command_columns(OMNI, np.array(v)[:, np.newaxis], 0.5)),
    (4, lambda v: omniwheel_columns.twist_columns(FOUR, np.array(v)[:, np.newaxis])),
    (3, lambda v: TREE.command(Twist(*v))),
    (3, lambda v: TREE.twist(THIRDS, v)),
    (3, lambda v: turret_columns.command_columns(TREE, np.array(v)[:, np.newaxis])),
    (3, lambda v: turret_columns.twist_columns(TREE, COLUMN, np.array(v)[:, np.newaxis])),
]


def numbers(result):
    if isinstance(result, tuple | list | np.ndarray):
        for part in result:
            yield from numbers(part)
    else:
        yield float(result)


def outcome(function, values):
    """Return the result, or the refusal."""
    try:
        return function(values)
    except AgvMotionError as error:
        return str(error)


@pytest.mark.parametrize('number', range(len(MAPS)))
def test_no_infinity_comes_out(number):
    count, function = MAPS[number]
    found = [outcome(function, v) for v in product((1.7e308, -1e308, 1e160, 1.0), repeat=count)]
    refusals = [result for result in found if isinstance(result, str)]
    results = [result for result in found if not isinstance(result, str)]
    assert all('finite' in refusal for refusal in refusals)
    assert results
    assert all(isfinite(value) for result in results for value in numbers(result))
    assert refusals or function in (PAIR.speeds, OMNI.speeds)  # which only become less
