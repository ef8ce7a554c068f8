"""Days of trees by their real minds: in the zone, apart, never standing for long, everywhere."""

from __future__ import annotations

import pytest

from agv_motion.simulation.season import Season, SeasonParameters


@pytest.mark.parametrize(
    ('kind', 'trees'), [('garden', 1), ('rooms', 2), ('hall', 2), ('square', 3)]
)
def test_what_must_hold_on_two_days(kind, trees):
    """Two opening days; the long form is launch_scripts/endurance_season.py."""
    tally = Season(SeasonParameters(kind=kind, trees=trees, days=2, seed=7)).run()
    assert tally.least_inside >= 0.0
    assert tally.least_gap >= 0.0
    assert tally.longest_stand < 1800.0
    assert tally.goals > 10 * trees
    assert tally.coverage[1] > tally.coverage[0] > 0.2 or tally.coverage[0] == 1.0
