"""The sap follows the light and is told as shares of a fair noon."""

from __future__ import annotations

import pytest

from agv_motion.simulation.sap import SapSense

DAY = 86400.0
JUNE = 16600 * DAY


def flow(light, hour, seed=1):
    sense = SapSense(seed)
    for minute in range(0, 60, 10):
        found = sense.feel(JUNE + hour * 3600.0 + 60.0 * minute, light)
    return found


def test_at_noon_it_flows_at_night_it_does_not():
    noon, night = flow(1.0, 11), flow(1.0, 0)
    assert min(noon) > 0.3
    assert max(night) < 0.15
    assert all(0.0 <= share <= 1.0 for share in (*noon, *night))


def test_shade_makes_it_slow():
    assert sum(flow(0.3, 11)) < 0.8 * sum(flow(1.0, 11))


def test_a_seed_is_a_tree():
    assert flow(1.0, 11) == pytest.approx((0.767223138341, 0.489073807525, 0.515215577871))
    assert flow(0.5, 8, seed=3) == pytest.approx((0.090091873644, 0.064985070894, 0.036910669980))
    assert flow(1.0, 11) == flow(1.0, 11) != flow(1.0, 11, seed=2)
