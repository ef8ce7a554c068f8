"""Episodes over the worst of networks; the long form is launch_scripts/endurance_traffic.py."""

from __future__ import annotations

import pytest

from agv_motion.simulation.trials.traffic_episode import Episode, EpisodeParameters


@pytest.mark.parametrize('seed', [2, 3, 4, 6])
def test_rims_keep_what_was_promised_whatever_happens(seed):
    outcome = Episode(EpisodeParameters(seed=seed, seconds=600.0)).run()
    assert outcome.least_gap >= 0.0


def test_over_a_calm_network_nobody_stands_for_long_and_all_arrive():
    episode = Episode(EpisodeParameters(seed=5, seconds=2400.0, calm=True))
    outcome = episode.run()
    assert outcome.least_gap >= 0.0
    assert outcome.longest_stand < 1800.0
    assert all(tree.walker.arrivals for tree in episode.trees)
