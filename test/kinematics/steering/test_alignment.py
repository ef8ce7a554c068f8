"""Rolling while turrets still turn."""

from __future__ import annotations

from math import cos, nan, pi

import pytest

from agv_motion.kinematics.steering.alignment import RollingShare, rolling_share
from agv_motion.kinematics.steering.state import AtRest, Rolling, Stance


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


def rolling(*speeds):
    phase = Rolling(AtRest.at([0.0] * len(speeds)).setpoints, Stance((1.0, 0.0, 0.0), [1.0, 1.0]))
    phase.setpoints.speeds = list(speeds)
    return phase


def test_the_share_rises_no_faster_than_the_wheels_may_speed_up():
    """Hand calculation: from rest by 0.1 m/s a step; then the whole of 0.25 m/s may be rolled."""
    share, phase, shares = RollingShare(2), rolling(0.25, -0.2), []
    for _ in range(3):
        share.update(phase, [0.0, 0.0], 0.1)
        shares.append(share.of(phase, [0.0, 0.0]))
    assert shares == pytest.approx([0.4, 0.8, 1.0])
    assert share.of(phase, [0.0, 1.0]) == pytest.approx(cos(1.0))
    share.update(phase, [0.0, pi / 2], 0.1)
    share.update(phase, [0.0, 0.0], 0.1)
    assert share.of(phase, [0.0, 0.0]) == pytest.approx(0.4)
    share.stop()
    share.update(rolling(0.5, 0.0), [0.0, 0.0], 0.1)
    assert share.of(phase, [0.0, 0.0]) == pytest.approx(0.2)


def test_all_of_it_is_rolled_at_rest_and_where_nobody_measures():
    share = RollingShare(2)
    share.update(rolling(0.5, 0.5), None, 0.1)
    assert share.of(rolling(0.5, 0.5), None) == 1.0
    assert share.of(AtRest.at([0.0, 0.0]), [1.0, 1.0]) == 1.0
    assert share.of(None, [1.0, 1.0]) == 1.0


def test_a_gain_to_the_last_digit_takes_nothing_off():
    share, phase = RollingShare(2), rolling(0.3, 0.3)
    share.update(phase, [0.0, 0.0], 0.3 * (1.0 - 1e-12))
    assert share.of(phase, [0.0, 0.0]) == 1.0
