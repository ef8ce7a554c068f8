"""The platform in the planner's measure."""

from __future__ import annotations

import pytest

from agv_motion.kinematics.steering.chassis import measure
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.turrets import Turrets


def test_arms_are_seen_from_the_centroid_and_measured_by_their_mean():
    """Hand calculation: centroid (2, 1), squares of the distances 1, 1, 4 and 4."""
    turrets = Turrets([(3.0, 1.0), (1.0, 1.0), (2.0, 3.0), (2.0, -1.0)])
    chassis = measure(turrets, SteeringLimits())
    assert (chassis.x, chassis.y) == (2.0, 1.0)
    assert chassis.length == pytest.approx(2.5**0.5)
    expected = [(1.0, 0.0), (-1.0, 0.0), (0.0, 2.0), (0.0, -2.0)]
    for arm, (x, y) in zip(chassis.arms, expected, strict=True):
        assert arm == pytest.approx((x / 2.5**0.5, y / 2.5**0.5))
