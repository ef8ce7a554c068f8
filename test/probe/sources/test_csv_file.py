"""Recorded probes: columns, units, offsets, speed, and files that are not as they should be."""

from __future__ import annotations

from math import isnan

import pytest

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.probe.sources.csv_file import CsvParameters, CsvSource, load

DAY = 86400.0


def source(tmp_path, text, warm_up_days=0.0, **parameters):
    path = tmp_path / 'probes.csv'
    path.write_text(text)
    defaults = {'columns': ('a', 'b'), 'day_offsets': (0.0, 0.0), 'unit': 'K'}
    return CsvSource(CsvParameters(file=str(path), **(defaults | parameters)), warm_up_days)


TABLE = 'time,a,b\n' + ''.join(
    f'1970-01-0{1 + d}T0{h}:00:00Z,{d}.{h},{h}\n' for d in range(3) for h in range(4)
)


def test_rows_fall_due_with_the_clock(tmp_path):
    played = source(tmp_path, TABLE, speed=3600.0)
    assert [s.values for s in played.read(50.0)] == [(0.0, 0.0)]
    assert [s.values for s in played.read(50.5)] == []
    assert [s.time for s in played.read(52.0)] == [3600.0, 7200.0]
    assert played.period == 1.0


def test_what_lies_before_the_start_is_history(tmp_path):
    played = source(tmp_path, TABLE, warm_up_days=1.0, start='1970-01-02T02:00:00')
    assert [s.time for s in played.history(0.0)] == [7200.0, 10800.0, DAY, DAY + 3600.0]
    assert played.read(0.0)[0].time == DAY + 7200.0


@pytest.mark.parametrize(('unit', 'kelvin'), [('K', 0.8), ('mV', 20.0), ('V', 2e4), ('uV', 0.02)])
def test_units(tmp_path, unit, kelvin):
    played = source(tmp_path, 'time,a,b\n0,0.8,0.8\n', unit=unit)
    assert played.read(0.0)[0].values == pytest.approx((kelvin, kelvin))


def test_one_column_serves_several_probes_at_other_days(tmp_path):
    played = source(tmp_path, TABLE, columns=('a', 'a', 'a'), day_offsets=(0.0, 1.0, 2.0))
    assert played.read(0.0)[0].values == (0.0, 1.0, 2.0)
    values = [s.values for s in played.read(1.0e6)]
    assert isnan(values[-1][1])


def test_rows_out_of_order_and_repeated_are_mended_and_told(tmp_path):
    played = source(tmp_path, 'time,a,b\n20,2,2\n10,1,1\n20,3,3\n30,4,4\n')
    assert '1 repeated dropped' in played.complaint()
    samples = played.read(0.0) + played.read(15.0)
    assert [s.values for s in samples] == [(1.0, 1.0), (3.0, 3.0)]


def test_cells_that_are_no_numbers_are_missing_and_told(tmp_path):
    played = source(tmp_path, 'time,a,b\n0,?,1\n10,,inf\n20,NA,2\n')
    assert '2 cells' in played.complaint()
    values = [v for s in played.read(0.0) + played.read(20.0) for v in s.values]
    assert [isnan(v) for v in values] == [True, False, True, True, True, False]


def test_the_end_of_the_file_is_told_once(tmp_path):
    played = source(tmp_path, TABLE)
    played.read(0.0)
    assert played.complaint() == ''
    played.read(1e9)
    assert 'has come to its end' in played.complaint()
    assert played.complaint() == ''


def test_a_missing_column_names_those_there_are(tmp_path):
    with pytest.raises(ConfigurationError, match="no column 'c': it has time, a, b"):
        source(tmp_path, TABLE, columns=('a', 'c'))


@pytest.mark.parametrize('text', ['', 'time,a,b\n', 'time,a,b\nsoon,1,2\n'])
def test_a_file_without_rows_or_times_is_refused(tmp_path, text):
    with pytest.raises((SourceError, ConfigurationError), match=r'probes\.csv'):
        source(tmp_path, text)


def test_a_file_that_is_not_there_is_refused():
    with pytest.raises(SourceError, match='cannot read the probe file'):
        CsvSource(CsvParameters(file='nowhere.csv'), 0.0)


def test_a_start_after_the_end_is_refused(tmp_path):
    with pytest.raises(SourceError, match='ends at 1970-01-03T03:00:00'):
        source(tmp_path, TABLE, start='2020-01-01')


def test_times_in_seconds_and_with_zones(tmp_path):
    path = tmp_path / 'zones.csv'
    path.write_text('time,a\n1000.5,1\n1970-01-01T01:00:00+01:00,2\n1970-01-01 02:00:00,3\n')
    times, _, problem = load(CsvParameters(file=str(path), columns=('a',), day_offsets=(0.0,)))
    assert times == [0.0, 1000.5, 7200.0]
    assert 'put into order' in problem


def test_no_number_of_a_file_becomes_infinite(tmp_path):
    played = source(tmp_path, 'time,a,b\n0,1e308,0.8\n1,-1e308,0.8\n', unit='mV')
    assert '2 values of more than 100000 K are no temperature' in played.complaint()
    for sample in (*played.read(0.0), *played.read(1.0)):
        assert isnan(sample.values[0])
        assert sample.values[1] == pytest.approx(20.0)
