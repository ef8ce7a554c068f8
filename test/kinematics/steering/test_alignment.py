"""Rolling while turrets still turn."""

from __future__ import annotations

from math import cos, nan, pi

import pytest

from agv_motion.kinematics.steering.alignment import rolling_share


@pytest.mark.parametrize(
    ('error', 'share'), [(0.0, 1.0), (pi / 3, 0.5), (pi / 2, 0.0), (pi, 0.0), (2 * pi, 1.0)]
)
def test_it_rolls_with_the_cosine_of_the_worst_error(error, share):
    assert rolling_share([0.1, 1.0, 2.0], [0.1, 1.0 + error, 2.0]) == pytest.approx(share)


def test_an_angle_that_is_no_number_stops_the_wheels():
    assert rolling_share([0.0, 0.0], [0.0, nan]) == rolling_share([0.0, 0.0], [nan, 0.0]) == 0.0


def test_a_whole_turn_more_is_no_error():
    assert rolling_share([0.0, 0.0], [2 * pi, 1.0]) == pytest.approx(cos(1.0))
    assert rolling_share([0.0, 0.0], [0.2, -0.3]) == pytest.approx(cos(0.3))
