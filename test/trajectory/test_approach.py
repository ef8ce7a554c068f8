"""Progress towards a Ghost that stands, by hand."""

from __future__ import annotations

from math import exp

import pytest

from agv_motion.planar import REST, Twist
from agv_motion.trajectory.approach import Approach, is_calm
from agv_motion.trajectory.tracking import TrackingError

FAR, NEAR = TrackingError(1.0, 0.0, 0.2), TrackingError(0.5, 0.2, 0.0)
AHEAD = Twist(0.4, 0.0, 0.1)


def test_the_first_measurement_is_the_average():
    approach = Approach()
    approach.update(FAR, 1.0, AHEAD, 0.1, patience=3.0)
    assert (approach.error, approach.twist, approach.stalled) == (FAR, AHEAD, 0.0)


def test_later_ones_count_by_the_time_that_they_took():
    """A third of 6 s is the time constant: after 0.1 s, 1 - e^-0.05 of the way is gone."""
    approach = Approach()
    approach.update(FAR, 1.0, AHEAD, 0.1, patience=6.0)
    approach.update(NEAR, 0.5, REST, 0.1, patience=6.0)
    left = exp(-0.05)
    assert approach.error == pytest.approx((0.5 + 0.5 * left, 0.2 * (1 - left), 0.2 * left))
    assert approach.twist == pytest.approx((0.4 * left, 0.0, 0.1 * left))


def test_only_what_is_a_tenth_nearer_is_progress():
    approach = Approach()
    for separation, stalled in ((1.0, 0.0), (0.91, 0.1), (0.91, 0.2), (0.89, 0.0), (0.85, 0.1)):
        approach.update(FAR, separation, REST, 0.1, patience=3.0)
        assert approach.stalled == pytest.approx(stalled)


def test_without_patience_nothing_is_averaged():
    approach = Approach()
    approach.update(FAR, 1.0, AHEAD, 0.1, patience=0.0)
    approach.update(NEAR, 0.5, REST, 0.1, patience=0.0)
    assert (approach.error, approach.twist) == (NEAR, REST)


def test_another_approach_begins_anew():
    approach = Approach()
    approach.update(FAR, 0.1, AHEAD, 0.1, patience=3.0)
    approach.update(FAR, 0.1, AHEAD, 0.1, patience=3.0)
    approach.restart()
    assert (approach.error, approach.twist, approach.stalled) == ((0.0, 0.0, 0.0), REST, 0.0)
    approach.update(NEAR, 5.0, AHEAD, 0.1, patience=3.0)
    assert (approach.error, approach.stalled) == (NEAR, 0.0)


@pytest.mark.parametrize(
    ('twist', 'calm'),
    [
        (Twist(0.03, 0.04, 0.1), True), (Twist(-0.03, -0.04, -0.1), True),
        (Twist(0.03, 0.05, 0.1), False), (Twist(0.03, 0.04, -0.11), False),
    ],
)  # fmt: skip
def test_calm_is_slow_in_both_ways(twist, calm):
    assert is_calm(twist, 0.05000001, 0.1) is calm


def test_little_patience_averages_little():
    """A third of 0.3 s: after 0.1 s, 1 - 1/e of the way is gone."""
    approach = Approach()
    approach.update(FAR, 1.0, AHEAD, 0.1, patience=0.3)
    approach.update(NEAR, 0.5, REST, 0.1, patience=0.3)
    assert approach.twist.vx == pytest.approx(0.4 * exp(-1.0))
