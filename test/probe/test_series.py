"""A whole series in one call: what the live probe says, reading by reading."""

from __future__ import annotations

from math import nan

import numpy as np
import pytest

from agv_motion.errors import SignalError
from agv_motion.probe import Probe, ProbeParameters, flux_density, read_series
from agv_motion.probe.quality import Quality

DAY = 86400.0
TIMES = np.arange(0.0, 3 * DAY, 900.0)
VALUES = 20.0 - 1.5 * np.maximum(np.sin(np.pi * (TIMES % DAY / 3600.0 - 8.0) / 12.0), 0.0)


def test_a_series_says_what_the_live_probe_says():
    values = VALUES + 0.001 * (TIMES % 3600.0 > 1000.0)
    values[50] = nan
    series, probe = read_series(TIMES, values), Probe(ProbeParameters())
    for row, (time, value) in enumerate(zip(TIMES, values, strict=True)):
        live = probe.update(float(time), float(value))
        assert series.quality[row] is live.quality
        for name in ('zero_flow', 'flow_index', 'flux_density', 'sap_flow'):
            column, told = getattr(series, name)[row], getattr(live, name)
            assert np.isnan(column) if told is None else column == told
    assert series.quality[50] is Quality.MISSING


def test_k_is_what_granier_has_it():
    series = read_series(TIMES, VALUES)
    known = np.flatnonzero(np.isfinite(series.flow_index) & (series.flow_index > 0.0))
    assert len(known) > 50
    row = known[-20]
    expected = (series.zero_flow[row] - VALUES[row]) / VALUES[row]
    assert series.flow_index[row] == pytest.approx(expected, rel=1e-12)
    assert series.flux_density[row] == pytest.approx(flux_density(expected), rel=1e-12)


@pytest.mark.parametrize(
    ('times', 'values', 'words'),
    [
        ([0.0, 1.0], [20.0], 'two columns'),
        ([[0.0]], [[20.0]], 'two columns'),
        ([0.0, nan], [20.0, 20.0], 'time nan s in row 1'),
        ([1.0, 0.0], [20.0, 20.0], 'time 0.0 s in row 1'),
    ],
)
def test_columns_that_are_no_series_are_refused(times, values, words):
    with pytest.raises(SignalError, match=words):
        read_series(times, values)
