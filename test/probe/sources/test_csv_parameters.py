"""One column of a file is one thing."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.probe.sources.csv_parameters import CsvParameters


@pytest.mark.parametrize(
    'air',
    [
        {'radiation_column': 'sun', 'vpd_column': 'sun'},
        {'radiation_column': 'a', 'vpd_column': 'dry'},
        {'vpd_column': 'a'},
    ],
)
def test_no_column_is_two_things(air):
    given = {'columns': ('a', 'b'), 'day_offsets': (0.0, 0.0)}
    with pytest.raises(ConfigurationError, match='give each a column of its own'):
        CsvParameters(**given, **air)
    CsvParameters(**given, radiation_column='sun', vpd_column='dry')


@pytest.mark.parametrize('offsets', [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)])
def test_a_file_that_is_followed_has_no_offset_at_all(offsets):
    given = {'columns': ('a', 'b'), 'day_offsets': offsets, 'follow': True}
    if not any(offsets):
        assert CsvParameters(**given).follow
        return
    with pytest.raises(ConfigurationError, match='leave out start, speed and day_offsets'):
        CsvParameters(**given)
