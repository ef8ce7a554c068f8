"""Angles that turrets can follow."""

from __future__ import annotations

from math import cos, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.kinematics.turret_motion import alignment, nearest_turns

ANGLE = st.floats(-20.0, 20.0)


@given(st.lists(st.tuples(ANGLE, ANGLE), min_size=1, max_size=6))
def test_the_same_direction_at_most_half_a_turn_away(pairs):
    angles, held = zip(*pairs, strict=True)
    for angle, now, turned in zip(angles, held, nearest_turns(angles, held), strict=True):
        assert abs(turned - now) <= pi + 1e-12
        assert cos(turned - angle) == pytest.approx(1.0, abs=1e-12)


def test_no_jump_across_pi():
    assert nearest_turns([-3.1], [3.1]) == pytest.approx([-3.1 + 2 * pi])
    assert nearest_turns([0.5], [0.4]) == [0.5]


@pytest.mark.parametrize(
    ('error', 'share'), [(0.0, 1.0), (pi / 3, 0.5), (pi / 2, 0.0), (pi, 0.0), (2 * pi, 1.0)]
)
def test_it_rolls_with_the_cosine_of_the_worst_error(error, share):
    assert alignment([0.1, 1.0, 2.0], [0.1, 1.0 + error, 2.0]) == pytest.approx(share)
