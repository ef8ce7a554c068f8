"""What the planner remembers."""

from __future__ import annotations

from math import nan

import pytest

from agv_motion.errors import SignalError
from agv_motion.kinematics.steering.state import AtRest, Limiter, Rolling, Stance
from agv_motion.kinematics.turrets import Turrets

PAIR = Turrets([(1.0, 0.0), (-1.0, 0.0)])
STANCE = Stance((1.0, 0.0, 0.0), [1.0, 1.0])


def test_a_platform_begins_at_rest_where_its_turrets_are():
    told = AtRest.at([0.5, -2]).setpoints
    assert (told.angles, told.rates, told.speeds) == ([0.5, -2.0], [0.0] * 2, [0.0] * 2)
    assert (told.signs, told.period, told.limiter) == ([1.0] * 2, 0.0, Limiter.NONE)
    with pytest.raises(SignalError, match='turret angles must be finite'):
        AtRest.at([0.0, nan])


def test_the_twist_is_that_of_the_wheels():
    told = AtRest.at([0.0, 0.0]).setpoints
    told.speeds = [0.3, 0.3]
    assert told.twist(PAIR) == pytest.approx((0.3, 0.0, 0.0))


def test_while_a_turret_turns_for_itself_there_is_no_stance():
    rolling = Rolling(AtRest.at([0.0, 0.0]).setpoints, STANCE)
    assert rolling.stance == STANCE
    rolling.free_turret = 0
    assert rolling.stance is None
