"""The picture of a season: what a tree covered, day by day."""

from __future__ import annotations

import numpy as np

from agv_motion.report.season_figure import FloorCoverage
from agv_motion.report.season_figure import draw as draw_season
from agv_motion.report.season_figure import finding as season_finding


def test_the_seasons(drawn, tmp_path):
    risen = np.minimum(np.arange(21) / 9.0, 1.0)
    floor = FloorCoverage([risen, risen**0.5], [0.54 * risen, risen])
    draw_season({'square': floor, 'garden': floor, 'rooms': floor}, tmp_path / 'coverage.png')
    drawn.check()
    texts = [text for text, _ in drawn[-1][1]]
    told = 'By memory a tree comes to all of its floor within nine days; straight or not at all, '
    assert f'{told}once to 54 % of it' in texts
    assert texts.count('by memory') == 3
    assert season_finding({'cut': FloorCoverage([[0.0, 0.98]], [[0.0, 0.5]])}).startswith(
        'By memory a tree comes to all of its floor not in time'
    )
