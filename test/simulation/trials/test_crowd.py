"""Seeded crowds over a bad network: never too near, never stuck for good."""

from __future__ import annotations

import random
from math import dist

import pytest

from agv_motion.motion.navigation.zone import Zone
from agv_motion.simulation.trials.crowd import Crowd, CrowdParameters, scattered
from agv_motion.simulation.trials.season_zones import plan_of

HALF_AN_HOUR = 1800.0
"""[s]"""
QUARTER = 900.0
"""[s]"""


@pytest.mark.parametrize(
    ('kind', 'seed', 'gap', 'arrivals', 'stands'),
    [
        ('rooms', 1, 0.60986, (3, 4), (255, 220)),
        ('garden', 2, 1.0181, (2, 2, 1), (20, 15, 145)),
        ('square', 1, 0.53631, (4, 3, 2, 3, 2), (60, 140, 145, 100, 150)),
    ],
)
def test_no_two_come_too_near_and_all_arrive(kind, seed, gap, arrivals, stands):
    """One message in ten is lost, others come late, clocks differ by seconds.

    The long form is launch_scripts/trials/endurance_traffic.py.
    """
    crowd = Crowd(plan_of(kind, seed).zone(), CrowdParameters(trees=len(arrivals), seed=seed))
    crowd.run(HALF_AN_HOUR)
    assert crowd.least_gap >= 0.0
    assert -1e-6 <= crowd.least_held_gap < 0.1  # they use what they may
    assert max(walker.longest_stand for walker in crowd.walkers) < QUARTER
    assert all(walker.arrivals for walker in crowd.walkers)
    # a seed tells the same story again
    assert crowd.least_gap == pytest.approx(gap, rel=1e-3)
    assert tuple(walker.arrivals for walker in crowd.walkers) == arrivals
    assert tuple(walker.longest_stand for walker in crowd.walkers) == stands


@pytest.mark.parametrize(('clearance', 'least'), [(0.85, 1.0), (0.9, 1.25**0.5)])
def test_trees_begin_a_little_farther_from_each_other_than_they_have_to(clearance, least):
    """By more than 0.1 m, on a grid of half metres."""
    zone, chance = Zone([[0, 0], [6, 0], [6, 6], [0, 6]]), random.Random(1)  # noqa: S311
    places = [scattered(zone, 2, clearance, chance) for _ in range(400)]
    assert min(dist(*two) for two in places) == pytest.approx(least)
