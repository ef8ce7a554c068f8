"""Angles as they are read: believed, counted on, or refused."""

from __future__ import annotations

from math import inf, nan, pi, tau

import pytest

from agv_motion.errors import SignalError
from agv_motion.kinematics.steering.readings import LOST_TURRET, TurretReadings
from agv_motion.kinematics.steering.state import AtRest

MOST = (1.5 + 10.0) * tau


def readings(*angles):
    one = TurretReadings()
    one.update(list(angles), 1.5)
    return one


@pytest.mark.parametrize('bad', [nan, inf, -inf, MOST + 0.01, -MOST - 0.01])
def test_what_no_cable_allows_is_refused_and_the_last_angles_stay(bad):
    one = readings(0.1, 0.2)
    for angles in ([bad, 0.0], [0.0, bad]):
        with pytest.raises(SignalError, match=r'stands at .* rad, beyond 72\.26 rad'):
            one.update(angles, 1.5)
        assert f'turret {angles.index(bad)} stands' in one.unbelievable
        assert one.angles == [0.1, 0.2]
    one.update([MOST, -MOST], 1.5)
    assert one.unbelievable == ''
    assert one.angles == [MOST, -MOST]


def test_turns_of_encoders_that_wrap_are_counted_on():
    told = AtRest.at([7.0, -7.0, 0.0]).setpoints
    one = readings(7.1 - tau, tau - 7.2, 0.3)
    assert one.turns(told) == pytest.approx([7.1, -7.2, 0.3])
    assert TurretReadings().turns(told) == [7.0, -7.0, 0.0]


@pytest.mark.parametrize(
    ('off', 'astray'),
    [
        (LOST_TURRET - 0.01, False),
        (0.01 - LOST_TURRET, False),
        (LOST_TURRET + 0.01, True),
        (-pi, True),
    ],
)
def test_a_turret_that_is_elsewhere_at_rest_is_astray(off, astray):
    told = AtRest.at([1.0, 0.0]).setpoints
    assert (
        readings(1.0 + off, 0.0).are_astray(told) == readings(1.0, off).are_astray(told) == astray
    )
    assert readings(1.0 + off + tau, 0.0).are_astray(told) == astray
    assert not TurretReadings().are_astray(told)
    told.rates[1] = 0.1
    assert not readings(1.0 + off, 0.0).are_astray(told)
