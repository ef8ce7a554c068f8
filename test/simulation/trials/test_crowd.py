"""Seeded crowds over a bad network: never too near, never stuck for good."""

from __future__ import annotations

import pytest

from agv_motion.simulation.trials.crowd import Crowd, CrowdParameters
from agv_motion.simulation.trials.season_zones import plan_of

HALF_AN_HOUR = 1800.0
"""[s]"""
QUARTER = 900.0
"""[s]"""


@pytest.mark.parametrize(
    ('kind', 'trees', 'seed'),
    [('rooms', 2, 1), ('garden', 3, 2), ('square', 5, 1)],
)
def test_no_two_come_too_near_and_all_arrive(kind, trees, seed):
    """One message in ten is lost, others come late, clocks differ by seconds.

    The long form is launch_scripts/endurance_traffic.py.
    """
    crowd = Crowd(plan_of(kind, seed).zone(), CrowdParameters(trees=trees, seed=seed))
    crowd.run(HALF_AN_HOUR)
    assert crowd.least_gap >= 0.0
    assert crowd.least_held_gap >= -1e-6
    assert max(walker.longest_stand for walker in crowd.walkers) < QUARTER
    assert all(walker.arrivals for walker in crowd.walkers)
