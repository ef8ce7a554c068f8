"""What bends allow, by hand, and what is refused."""

from __future__ import annotations

from math import inf, nan

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.trajectory.bounds import require_between
from agv_motion.trajectory.limits import (
    LateralAcceleration,
    LinearSpeed,
    TurnRate,
    TurnStep,
    WheelSpeed,
    joint_ceiling,
    lowest_ceiling,
)

BENDS = np.array([0.5, -2.0])


@pytest.mark.parametrize(
    ('limit', 'speeds'),
    [
        (LateralAcceleration(0.5), [1.0, 0.5]),  # v2 k = a
        (TurnRate(1.0), [2.0, 0.5]),  # v k = w
        (LinearSpeed(0.7), [0.7, 0.7]),
        (WheelSpeed(1.2, 0.8), [1.0, 1.2 / 1.8]),  # v (1 + k b / 2) = v_w
        (TurnStep(0.3), [inf, inf]),
    ],
)
def test_each_by_its_equation(limit, speeds):
    assert limit.ceiling(BENDS) == pytest.approx(speeds)
    assert BENDS.tolist() == [0.5, -2.0]


@pytest.mark.parametrize(
    'limit', [LateralAcceleration(0.5), TurnRate(1.0), WheelSpeed(1.2, 0.8), LinearSpeed(1.2)]
)
def test_straight_on_nothing_but_the_speed_itself_limits(limit):
    (speed,) = limit.ceiling(np.zeros(1))
    assert speed == pytest.approx(1.2) or speed > 1e5


def test_only_the_step_minds_a_joint():
    step = np.array([0.6, -0.1, 0.0])
    assert TurnStep(0.3).at_joints(step)[:2] == pytest.approx([0.5, 3.0])
    assert TurnStep(0.3).at_joints(step)[2] > 1e10
    for limit in (LateralAcceleration(0.5), TurnRate(1.0), LinearSpeed(0.7), WheelSpeed(1.0, 1.0)):
        assert limit.at_joints(step).tolist() == [inf] * 3


def test_the_lowest_holds():
    limits = [LateralAcceleration(0.5), TurnRate(1.0)]
    assert lowest_ceiling(limits, BENDS, 0.8) == pytest.approx([0.8, 0.5])
    assert lowest_ceiling([], BENDS, 0.8) == pytest.approx([0.8, 0.8])
    steps = np.array([0.6, 0.1])
    assert joint_ceiling([*limits, TurnStep(0.3), TurnStep(0.2)], steps) == pytest.approx(
        [0.2 / 0.6, 2.0]
    )
    assert joint_ceiling([], steps).tolist() == [inf, inf]


@pytest.mark.parametrize('bad', [0.0, -1.0, inf, nan])
@pytest.mark.parametrize(
    ('make', 'name'),
    [
        (LateralAcceleration, 'lateral acceleration'),
        (TurnRate, 'turn rate'),
        (LinearSpeed, 'linear speed'),
        (TurnStep, 'turn step'),
        (lambda bad: WheelSpeed(bad, 1.0), 'wheel speed'),
        (lambda bad: WheelSpeed(1.0, bad), 'track'),
    ],
)
def test_no_limit_is_nought_or_no_number(make, name, bad):
    with pytest.raises(ConfigurationError, match=f'{name} = .*must be positive and finite'):
        make(bad)


def test_a_range_includes_its_ends_and_names_its_remedy():
    assert require_between('x', 1.0, (1.0, 2.0), 'm') == 1.0
    assert require_between('x', 2.0, (1.0, 2.0), 'm') == 2.0
    with pytest.raises(ConfigurationError, match=r'x = 2.1 m: must lie in \[1, 2\] m; try less'):
        require_between('x', 2.1, (1.0, 2.0), 'm', 'try less')
    with pytest.raises(ConfigurationError, match=r'x = nan: must lie in \[1, 2\]$'):
        require_between('x', nan, (1.0, 2.0), '')
