"""Days of trees by their real minds: in the zone, apart, never standing for long, everywhere."""

from __future__ import annotations

import pytest

from agv_motion.simulation.trials.season import Season, SeasonParameters


@pytest.mark.parametrize(
    ('kind', 'trees', 'days'), [('garden', 1, 2), ('rooms', 2, 1), ('hall', 2, 1), ('square', 3, 1)]
)
def test_what_must_hold_on_every_day(kind, trees, days):
    """Two hours of a day, or of two; the long form is launch_scripts/endurance_season.py."""
    tally = Season(SeasonParameters(kind=kind, trees=trees, days=days, hours=2.0, seed=7)).run()
    assert tally.least_inside >= 0.0
    assert tally.least_gap >= 0.0
    assert tally.longest_stand < 1800.0
    assert tally.goals > 5 * days * trees
    assert tally.coverage[-1] >= tally.coverage[0] > 0.2


def test_hours_off_the_air_are_no_standstill():
    """Every day one of two trees is off the air for an hour, within which none is said to stand."""
    given = SeasonParameters(kind='hall', trees=2, days=1, hours=2.0, seed=7, outages=1.0)
    season = Season(given)
    count_from = season.trees[0].count_from
    counted = []
    season.trees[0].count_from = lambda now: (counted.append(now), count_from(now))
    assert season.run().longest_stand < 1800.0
    assert counted[-1] - counted[0] == pytest.approx(3600.0, abs=120.0)
