"""The picture of the probes of a file, and what the tree drank."""

from __future__ import annotations

import numpy as np
import pytest

from agv_motion.probe.parameters import ProbeParameters
from agv_motion.probe.series import read_series
from agv_motion.probe.water import DayOfWater, Litres
from agv_motion.report.probes_figure import PlaceDays
from agv_motion.report.probes_figure import draw as draw_probes


@pytest.mark.parametrize(('count', 'theme', 'area'), [(1, 'dark', 0.0), (5, 'light', 0.012)])
def test_probes_of_a_file_and_what_the_tree_drank(sketched, tmp_path, count, theme, area):
    """Days are those of a place six hours ahead of UTC; the file begins at its midnight."""
    at = np.arange(4 * 96)
    values = 20.0 - 1.25 * np.maximum(0.0, 1.0 - np.abs(at % 96 - 56) / 24.0) + 0.0025 * (at % 3)
    parameters = ProbeParameters(solar_offset=6.0)
    series = [read_series(900.0 * at + 64800.0, values, parameters)] * count
    drunk = Litres(1.2, 0.4, 3.6)
    days = [DayOfWater(day, drunk, drunk, 0.5 if day == 1 else 1.0) for day in (1, 2, 3, 4)]
    water = PlaceDays(days, 6.0) if area else None
    names = [f'dT of probe {i}' for i in range(count)]
    draw_probes(names, series, tmp_path / 'oak.png', theme, water)
    sketched.check()
    told = 'Water, with 95 % confidence: 1.20 L (0.40 to 3.60) on a usual day'
    texts = [text for text, _ in sketched[-1][1]]
    assert [text for text in texts if text.startswith('Water')] == [told] * bool(area)
    labels = [text for text in texts if text.startswith('days since')]
    assert labels == ['days since 1970-01-01 18:00 UTC'] * (1 if area else count)
    if area:
        axes = next(a for a in sketched[-1][0].axes if a.get_ylabel() == 'water [L/day]')
        assert [bar.get_x() for bar in axes.patches] == pytest.approx([0.0, 1.0, 2.0, 3.0])
