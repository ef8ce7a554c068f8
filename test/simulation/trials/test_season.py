"""Days of trees by their real minds: in the zone, apart, never standing for long, everywhere."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest

from agv_motion.simulation.trials.season import PERIOD, Season, SeasonParameters


@pytest.mark.parametrize(
    ('kind', 'trees', 'days', 'told'),
    [
        ('garden', 1, 2, (100.44, 21, 0.43735, inf, 60.0, 0.37914, 0.54286)),
        ('rooms', 2, 1, (53.442, 18, 0.031165, 1.0805, 180.0, 0.66851)),
        ('hall', 2, 1, (16.434, 74, 0.1773, 0.57491, 300.0, 0.48701)),
        ('square', 3, 1, (110.99, 20, 0.54973, 0.57061, 195.0, 0.25362)),
    ],
)
def test_what_must_hold_on_every_day(kind, trees, days, told):
    """What must hold, and all else as it was: a seed tells the same story again.

    Two hours of a day, or of two; the long form is launch_scripts/trials/endurance_season.py.
    """
    tally = Season(SeasonParameters(kind=kind, trees=trees, days=days, hours=2.0, seed=7)).run()
    assert tally.least_inside >= 0.0
    assert tally.least_gap >= 0.0
    assert tally.longest_stand < 1800.0
    assert tally.goals > 5 * days * trees
    assert tally.coverage[-1] >= tally.coverage[0] > 0.2
    assert tally.days == days
    assert (*tally[1:6], *tally.coverage) == pytest.approx(told, rel=1e-3)


def test_hours_off_the_air_are_no_standstill():
    """Every day one of two trees is off the air for an hour, within which none is said to stand."""
    given = SeasonParameters(kind='rooms', trees=2, days=1, hours=2.0, seed=7, outages=1.0)
    season = Season(given)
    count_from = season.trees[0].count_from
    counted = []
    season.trees[0].count_from = lambda now: (counted.append(now), count_from(now))
    assert season.run().longest_stand < 1800.0
    assert counted[-1] - counted[0] == pytest.approx(3600.0, abs=120.0)


@pytest.mark.parametrize(('moves', 'every'), [(False, PERIOD), (True, 20.0)])
def test_while_no_tree_moves_time_goes_by_faster(moves, every):
    given = SeasonParameters(kind='hall', trees=2, days=1, hours=1.0, step=20.0, outages=0.0)
    season = Season(given)
    times = []
    for i, tree in enumerate(season.trees):
        tree.live = lambda now, *_, i=i: (times.append(now), moves and i == 0)[-1]
    season.run()
    assert set(np.diff(sorted(set(times[2:])))) == {every}
