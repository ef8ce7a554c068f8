"""When cables are unwound."""

from __future__ import annotations

from math import pi

import pytest

from agv_motion.kinematics.steering.state import AtRest
from agv_motion.kinematics.steering.unwinding import Unwinding, describe, is_wound


def setpoints(*angles):
    return AtRest.at(angles).setpoints


@pytest.mark.parametrize(
    ('angle', 'wound'), [(1.57, False), (1.58, True), (-1.57, False), (-1.58, True)]
)
def test_more_than_a_quarter_turn_can_be_unwound(angle, wound):
    assert is_wound(setpoints(0.0, angle)) == is_wound(setpoints(angle, 0.0)) == wound


def test_after_a_rest_it_is_due_where_there_is_something_to_do():
    one, wound = Unwinding(0.25), setpoints(2.0, 0.0)
    assert [one.is_due(wound, 0.1, wanted=False) for _ in range(4)] == [False, False, True, True]
    assert not one.is_due(setpoints(1.0, 0.0), 0.1, wanted=False)
    assert not one.is_due(wound, 0.1, wanted=True)
    assert [one.is_due(wound, 0.1, wanted=False) for _ in range(3)] == [False, False, True]


def test_it_is_due_when_asked_and_never_by_itself_with_zero():
    one, wound = Unwinding(0.0), setpoints(2.0, 0.0)
    assert not any(one.is_due(wound, 100.0, wanted=False) for _ in range(5))
    one.asked = True
    assert one.is_due(wound, 0.1, wanted=False)


def test_the_furthest_turret_is_told_in_half_turns():
    assert describe(setpoints(2.0, -2 * pi)) == 'unwinding, the furthest turret by -360 deg'
