"""Episodes over the worst of networks; launch_scripts/trials/endurance_traffic.py is long."""

from __future__ import annotations

import pytest

from agv_motion.simulation.trials.traffic_episode import Episode, EpisodeParameters


@pytest.mark.parametrize(
    ('seed', 'gap', 'stand', 'counts', 'troubles'),
    [
        (2, 3.4821, 160.0, (1, 3, 0, 2), (0.45186, 74.905, 0.17421)),
        (3, 3.4336, 245.0, (0, 2, 0, 2), (0.83325, 6.4724, 0.0030293)),
        (4, 0.40956, 185.0, (1, 4, 1, 1), (0.45536, 2.3432, 0.094718)),
        (6, 1.5340, 405.0, (0, 7, 5, 2), (0.02558, 5.645, 0.12035)),
    ],
)
def test_rims_keep_what_was_promised_whatever_happens(seed, gap, stand, counts, troubles):
    """What was promised, and all else as it was: a seed tells the same story again."""
    episode = Episode(EpisodeParameters(seed=seed, seconds=600.0))
    outcome = episode.run()
    assert outcome.least_gap >= 0.0
    assert outcome[:2] == pytest.approx((gap, stand), rel=1e-3)
    assert outcome[2:6] == counts
    radio = episode.radio.parameters
    assert (radio.loss, radio.delay, radio.doubled) == pytest.approx(troubles, rel=1e-3)


def test_over_a_calm_network_nobody_stands_for_long_and_all_arrive():
    episode = Episode(EpisodeParameters(seed=5, seconds=2400.0, calm=True))
    outcome = episode.run()
    assert outcome.least_gap >= 0.0
    assert outcome.longest_stand < 1800.0
    assert outcome[2:6] == (9, 2, 0, 7)  # as it was, as above
    assert outcome[:2] == pytest.approx((0.5853, 185.0), rel=1e-3)
    assert all(tree.walker.arrivals for tree in episode.trees)
