"""How far two trees keep apart."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.platform import PLATFORM_RADIUS
from agv_motion.motion.navigation.reservations.parameters import TrafficParameters


def test_the_clearance_is_of_two_bodies_two_errors_and_one_margin():
    given = TrafficParameters(body=0.7, tolerance=0.2, margin=0.3)
    assert given.radius == pytest.approx(0.9)
    assert given.clearance == pytest.approx(2.1)


def test_two_trees_as_they_are_delivered_keep_their_bodies_a_fifth_of_a_metre_apart():
    given = TrafficParameters()
    errors = 2.0 * given.tolerance
    assert given.clearance - errors - 2.0 * PLATFORM_RADIUS == pytest.approx(0.2)


def test_a_margin_that_cannot_be_is_refused():
    with pytest.raises(ConfigurationError, match='margin'):
        TrafficParameters(margin=-0.1)
