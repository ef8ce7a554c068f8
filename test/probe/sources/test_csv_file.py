"""Recorded probes: columns, units, offsets, speed, and files that are not as they should be."""

from __future__ import annotations

import re
from math import isnan, nan

import pytest

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.probe.sources.csv_file import CsvSource, GrowingSource
from agv_motion.probe.sources.csv_parameters import CsvParameters
from agv_motion.probe.sources.csv_recording import ROUNDED, load, start_of
from agv_motion.probe.sources.source import kelvin_per

DAY = 86400.0
DAWN = 1_370_822_400.0
"""[s] since 1970: 2013-06-10, when all recordings here begin"""


def source(tmp_path, text, warm_up_days=0.0, **parameters):
    path = tmp_path / 'probes.csv'
    path.write_text(text)
    defaults = {'columns': ('a', 'b'), 'day_offsets': (0.0, 0.0), 'unit': 'K'}
    return CsvSource(CsvParameters(file=str(path), **(defaults | parameters)), warm_up_days)


TABLE = 'time,a,b\n' + ''.join(
    f'2013-06-1{d}T0{h}:00:00Z,{d}.{h},{h}\n' for d in range(3) for h in range(4)
)


def seconds(*rows):
    """Return a table whose times are seconds since dawn."""
    return 'time,a,b\n' + ''.join(f'{DAWN + t:.0f},{a},{b}\n' for t, a, b in rows)


def test_rows_fall_due_with_the_clock(tmp_path):
    played = source(tmp_path, TABLE, speed=3600.0)
    assert [s.values for s in played.read(50.0)] == [(0.0, 0.0)]
    assert [s.values for s in played.read(50.5)] == []
    assert [s.time for s in played.read(52.0)] == [DAWN + 3600.0, DAWN + 7200.0]
    assert played.period == 1.0


def test_what_lies_before_the_start_is_history(tmp_path):
    played = source(tmp_path, TABLE, warm_up_days=1.0, start='2013-06-11T02:00:00')
    assert [s.time for s in played.history(0.0)] == [
        DAWN + time for time in (7200.0, 10800.0, DAY, DAY + 3600.0)
    ]
    assert played.read(0.0)[0].time == DAWN + DAY + 7200.0


@pytest.mark.parametrize(('unit', 'kelvin'), [('K', 0.8), ('mV', 20.0), ('V', 2e4), ('uV', 0.02)])
def test_units(tmp_path, unit, kelvin):
    played = source(tmp_path, 'time,a,b\n2013-06-10,0.8,0.8\n', unit=unit)
    assert played.read(0.0)[0].values == pytest.approx((kelvin, kelvin))


def test_one_column_serves_several_probes_at_other_days(tmp_path):
    played = source(tmp_path, TABLE, columns=('a', 'a', 'a'), day_offsets=(0.0, 1.0, 2.0))
    assert played.read(0.0)[0].values == (0.0, 1.0, 2.0)
    values = [s.values for s in played.read(1.0e6)]
    assert isnan(values[-1][1])


def test_rows_out_of_order_and_repeated_are_mended_and_told(tmp_path):
    played = source(tmp_path, seconds((20, 2, 2), (10, 1, 1), (20, 3, 3), (30, 4, 4)))
    assert '1 rows of a time that comes again dropped' in played.complaint()
    samples = played.read(0.0) + played.read(15.0)
    assert [s.values for s in samples] == [(1.0, 1.0), (3.0, 3.0)]


def test_cells_that_are_no_numbers_are_missing_and_told(tmp_path):
    played = source(tmp_path, seconds((0, '?', 1), (10, '', 'inf'), (20, 'NA', 2)))
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
    with pytest.raises(SourceError, match='ends at 2013-06-12T03:00:00'):
        source(tmp_path, TABLE, start='2020-01-01')


def test_times_in_seconds_and_with_zones(tmp_path):
    path = tmp_path / 'zones.csv'
    path.write_text(
        f'time,a\n{DAWN + 1000.5},1\n2013-06-10T01:00:00+01:00,2\n2013-06-10 02:00:00,3\n'
    )
    found = load(CsvParameters(file=str(path), columns=('a',), day_offsets=(0.0,)))
    assert found.times == [DAWN, DAWN + 1000.5, DAWN + 7200.0]
    assert found.table.places[:, 1].tolist() == [3, 2, 4]
    assert 'put into order' in found.problem


def test_no_number_of_a_file_becomes_infinite(tmp_path):
    played = source(tmp_path, seconds((0, 1e308, 0.8), (1, -1e308, 0.8)), unit='mV')
    assert '2 values of more than 100000 K are no temperature' in played.complaint()
    for sample in (*played.read(0.0), *played.read(1.0)):
        assert isnan(sample.values[0])
        assert sample.values[1] == pytest.approx(20.0)


def test_what_is_a_temperature_is_judged_in_kelvin(tmp_path):
    limit = 100_000.0 / kelvin_per('mV')
    played = source(tmp_path, seconds((0, 0.99 * limit, 0), (1, 1.01 * limit, 0)), unit='mV')
    (first,), (second,) = played.read(0.0), played.read(1.0)
    assert first.values[0] == pytest.approx(99_000.0)
    assert isnan(second.values[0])


def two_rows(first, second='2013-06-10 01:00'):
    return f'time,a,b\n{first},1,2\n{second},3,4\n'


@pytest.mark.parametrize(
    ('word', 'reason'),
    [
        ('201306101200', 'csv.time_format: YYYYMMDDHHMM reads 2013-06-10T12:00'),
        ('20130610', 'csv.time_format: YYYYMMDD reads 2013-06-10'),
        ('2013161', 'no time from 1990 to 2100'),
        ('41435.5', 'csv.time_format: excel reads 2013-06-10T12:00'),
        ('735395.5', 'csv.time_format: matlab reads 2013-06-10T12:00'),
        ('1370863800000', 'csv.time_format: epoch_ms reads 2013-06-10T11:30'),
        ('9' * 400, 'no time: give ISO 8601'),
        ('1989-12-31T23:59:59', 'no time from 1990 to 2100'),
        ('2100-01-01', 'no time from 1990 to 2100'),
        ('00:30', 'no time: give ISO 8601'),
    ],
)
def test_what_is_no_time_is_never_guessed_into_one(tmp_path, word, reason):
    with pytest.raises(SourceError, match=rf'probes\.csv, line 2, column 1: .*{reason}'):
        source(tmp_path, two_rows(word, word))
    played = source(tmp_path, two_rows(word))
    assert re.search(r'rows of .*probes\.csv left out: 1 \(line 2: no time', played.complaint())
    assert [s.values for s in played.read(0.0)] == [(3.0, 4.0)]
    with pytest.raises(SourceError, match=reason):
        source(tmp_path, TABLE, start=word)


@pytest.mark.parametrize(
    ('words', 'form'),
    [
        (('2013061000', '2013061001'), '%Y%m%d%H'),
        (('1306101200', '1306101230'), '%y%m%d%H%M'),
        (('1706202412', '1706202413'), '%d%m%Y%H'),
        (('2013-06-10', '2013-06-10'), 'days alone'),
        (('10/06/2013 00:00', '10/06/2013 00:30'), 'day_first.*month_first'),
        (('6/10/2013 12:30 AM', '6/10/2013 1:30 AM'), 'day_first.*month_first'),
    ],
)
def test_times_with_two_readings_are_refused(tmp_path, words, form):
    with pytest.raises(SourceError, match=rf'probes\.csv, line 2.*{form}'):
        source(tmp_path, two_rows(*words))


@pytest.mark.parametrize(
    ('word', 'time_format'), [('10.06.2013', 'day_first'), ('20130610', 'YYYYMMDD')]
)
def test_rows_of_one_day_without_a_clock_are_refused_in_every_format(tmp_path, word, time_format):
    with pytest.raises(SourceError, match=r'line 2.*days alone.*date \+ clock'):
        source(tmp_path, two_rows(word, word), time_format=time_format)


def test_days_alone_are_midnights_where_each_is_there_once(tmp_path):
    played = source(tmp_path, two_rows('2013-06-10', '2013-06-11'))
    assert [s.time for s in played.read(0.0) + played.read(DAY)] == [DAWN, DAWN + DAY]


@pytest.mark.parametrize(
    ('row', 'reason'),
    [
        ('end of file,,', 'no time'),
        (',3,4', 'no time'),
        ('2013-06-10 00:30,3', '2 cells under 3 columns'),
        ('2013-06-10 00:30,0,41,0,52', '5 cells under 3 columns: a comma in it may be decimal'),
        ('2013-06-10 00:30,"3,4', 'no CSV'),
        ('\0' * 20, 'only NUL bytes'),
        ('2013-06-10 24:01,3,4', 'no time'),
    ],
)
def test_one_bad_row_costs_one_row_and_is_told(tmp_path, row, reason):
    good = '2013-06-10 00:00,1,2', '2013-06-10 01:00,5,6'
    played = source(tmp_path, '\n'.join(('time,a,b', good[0], row, good[1], '')))
    assert f'left out: 1 (line 3: {reason}' in played.complaint()
    samples = played.read(0.0) + played.read(3600.0)
    assert [(s.time, *s.values) for s in samples] == [(DAWN, 1, 2), (DAWN + 3600.0, 5, 6)]


def test_many_bad_rows_are_counted_and_the_first_told(tmp_path):
    played = source(tmp_path, two_rows('2013-06-10') + 'end,,\n' * 9)
    assert 'left out: 9 (line 4: no time' in (told := played.complaint())
    assert told.endswith('; and 6 more)')


def test_a_column_that_is_there_twice_is_refused(tmp_path):
    with pytest.raises(ConfigurationError, match=r"line 1.*column 'a' is there 2 times"):
        source(tmp_path, 'time,a,a,b\n2013-06-10,1,2,3\n')


def test_what_loggers_write_for_a_missing_value_is_missing_in_every_unit(tmp_path):
    played = source(tmp_path, two_rows('2013-06-10').replace('1,2', '-9999,-7999.0'), unit='uV')
    assert all(map(isnan, played.read(0.0)[0].values))


@pytest.mark.parametrize(('start', 'line'), [('2013-06-09T23:59', 2), ('2013-06-12T03:01', 13)])
def test_a_start_outside_the_file_is_refused_with_line_and_remedy(tmp_path, start, line):
    with pytest.raises(SourceError, match=rf'\(line {line}\).*choose one from 2013-06-10T'):
        source(tmp_path, TABLE, start=start)


def follow(path, **given):
    given = {'columns': ('a', 'b'), 'day_offsets': (0.0, 0.0), 'unit': 'K'} | given
    return GrowingSource(CsvParameters(file=str(path), follow=True, **given), 1.0)


def test_rows_are_told_as_a_logger_writes_them_and_never_what_was_there_before(tmp_path):
    file = tmp_path / 'live.csv'
    file.write_text(seconds((0, 1, 2), (900, 3, 4)))
    source = follow(file)
    assert source.period == 900.0
    assert [s.values for s in source.history(0.0)] == [(1.0, 2.0), (3.0, 4.0)]
    assert source.read(1e9) == []
    with file.open('a') as written:
        written.write(f'{DAWN + 1800:.0f},5,6\n{DAWN + 2700:.0f},7')
    assert [(s.time - DAWN, s.values) for s in source.read(1e9)] == [(1800.0, (5.0, 6.0))]
    with file.open('a') as written:
        written.write(f',8\nend,,\n{DAWN + 60:.0f},9,9\n')
    assert [s.values for s in source.read(1e9)] == [(7.0, 8.0)]
    told = source.complaint()
    assert '1 rows are older than what was read before' in told
    assert 'left out: 1 (line 6: no time' in told
    assert source.complaint() == ''


HOURS = [(3600 * hour, 1, 2) for hour in range(3)]
AWAY = 40 * 86400


def append(file, *rows):
    with file.open('a') as written:
        written.write(seconds(*rows).partition('\n')[2])


def told(source, samples):
    return [sample.time - DAWN for sample in samples], source.complaint()


LEFT_OUT = 'rows are days ahead of the clock here: left out; set the logger'


def test_rows_of_a_logger_whose_clock_runs_days_ahead_are_left_out_of_the_history(tmp_path):
    file = tmp_path / 'live.csv'
    file.write_text(seconds(*HOURS, (AWAY, 3, 4), (AWAY + 3600, 3, 4)))
    source = follow(file)
    found = told(source, source.history(DAWN + 7300.0))
    assert found == ([0.0, 3600.0, 7200.0], f'2 {LEFT_OUT}')
    append(file, (10_800, 5, 6))
    assert told(source, source.read(DAWN + 10_900.0)) == ([10_800.0], '')


@pytest.mark.parametrize(
    ('rows', 'now', 'count'),
    [
        ([(0, 1, 2), (AWAY, 3, 4)], 0.0, 1),
        ([(0, 1, 2), (86400, 3, 4)], -43_200.0, 2),  # no more than a day apart
        ([(0, 1, 2), (86460, 3, 4)], -43_200.0, 1),
        ([(43_200 * k, 1, 2) for k in range(8)], 86400.0, 8),  # the clock here may be wrong
        ([(AWAY, 1, 2), (2 * AWAY, 3, 4)], 0.0, 2),  # and is, where all is ahead of it
    ],
)
def test_history_ends_where_it_leaps_ahead_of_the_clock(tmp_path, rows, now, count):
    file = tmp_path / 'live.csv'
    file.write_text(seconds(*rows))
    given = CsvParameters(
        file=str(file), follow=True, columns=('a', 'b'), day_offsets=(0.0, 0.0), unit='K'
    )
    source = GrowingSource(given, 1000.0)
    times, problem = told(source, source.history(DAWN + now))
    assert times == [float(row[0]) for row in rows[:count]]
    assert problem == (f'{len(rows) - count} {LEFT_OUT}' if count < len(rows) else '')


@pytest.mark.parametrize(
    ('now', 'rows', 'count'),
    [
        (7200.0, [(10_800, 1, 2), (AWAY, 1, 2)], 1),
        (7200.0, [(7200 + 86400, 1, 2)], 1),
        (7200.0, [(7200 + 86401, 1, 2)], 0),
        (3 * 86400.0, [(216_000, 1, 2)], 1),  # nothing came for days: by the clock here
        (-79_000.0, [(80_000, 1, 2)], 1),  # within a day of the last, if not of the clock here
        (-10 * 86400.0, [(AWAY, 1, 2)], 1),  # what was there is ahead: the clock here is wrong
    ],
)
def test_a_row_days_ahead_of_the_clock_and_of_the_last_one_is_left_out(tmp_path, now, rows, count):
    file = tmp_path / 'live.csv'
    file.write_text(seconds(*HOURS))
    source = follow(file)
    append(file, *rows)
    times, problem = told(source, source.read(DAWN + now))
    assert times == [float(row[0]) for row in rows[:count]]
    assert problem == (f'{len(rows) - count} {LEFT_OUT}' if count < len(rows) else '')


def test_a_disk_that_goes_away_is_told_and_comes_back(tmp_path):
    file = tmp_path / 'live.csv'
    file.write_text(seconds((0, 1, 2)))
    source = follow(file)
    file.rename(tmp_path / 'away')
    assert source.read(0.0) == []
    assert 'live.csv' in source.complaint()
    (tmp_path / 'away').rename(file)
    with file.open('a') as written:
        written.write(f'{DAWN + 900:.0f},3,4\n')
    assert [s.values for s in source.read(0.0)] == [(3.0, 4.0)]


@pytest.mark.parametrize('given', [{'start': '2013-06-10'}, {'speed': 2.0}])
def test_a_file_that_is_followed_is_not_played(given):
    with pytest.raises(ConfigurationError, match=r'follow = true.*leave out start, speed'):
        CsvParameters(follow=True, **given)


@pytest.mark.parametrize(
    ('columns', 'air'),
    [
        ({'radiation_column': 'sun', 'vpd_column': 'vpd'}, (500.0, 0.8)),
        ({'radiation_column': 'sun'}, (500.0, nan)),
        ({'vpd_column': 'vpd'}, (nan, 0.8)),
        ({'vpd_column': '5', 'radiation_column': '2'}, (500.0, 0.8)),
        ({}, (nan, nan)),
    ],
)
@pytest.mark.parametrize('follow', [False, True])
def test_columns_of_the_air_come_with_the_probes_and_in_their_own_units(
    tmp_path, columns, air, follow
):
    path = tmp_path / 'probes.csv'
    rows = f'{DAWN:.0f},500,0.8,0.7,0.8\n{DAWN + 900:.0f},600,0.8,0.7,\n'
    path.write_text(f'time,sun,a,b,vpd\n{rows}')
    given = CsvParameters(
        file=str(path), columns=('b', 'a'), day_offsets=(0.0, 0.0), follow=follow, **columns
    )
    if follow:
        first, second = GrowingSource(given, 1.0).history(0.0)
    else:
        played = CsvSource(given, 0.0)
        first, second = [*played.read(0.0), *played.read(900.0)]
    assert first.values == pytest.approx((17.5, 20.0))
    assert tuple(first.environment) == pytest.approx(air, nan_ok=True)
    assert isnan(second.environment.vapour_pressure_deficit)


@pytest.mark.parametrize(('moment', 'row'), [(-0.5 * ROUNDED, 0), (0.5 * ROUNDED, -1)])
def test_a_start_may_lie_outside_by_rounding_alone(tmp_path, moment, row):
    table = tmp_path / 'table.csv'
    table.write_text(seconds((0, 1, 2), (900, 3, 4)))
    found = load(CsvParameters(file=str(table), columns=('a',), day_offsets=(0.0,)))
    beyond = found.times[row] + moment
    assert start_of(f'{beyond:.4f}', found, 'table.csv') == found.times[row]
    with pytest.raises(SourceError, match='choose one from'):
        start_of(f'{beyond + 2.0 * moment:.4f}', found, 'table.csv')


def test_a_file_that_is_empty_yet_is_followed_from_its_first_row(tmp_path):
    file = tmp_path / 'live.csv'
    file.write_text('')
    source = follow(file)
    assert list(source.history(0.0)) == []
    file.write_text(seconds((0, 1, 2), (900, 3, 4)))
    assert [s.values for s in source.read(1e9)] == [(1.0, 2.0), (3.0, 4.0)]
