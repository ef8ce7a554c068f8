"""The clock of a logger in UTC, over both nights on which it is changed."""

from __future__ import annotations

from datetime import datetime, timezone

import pytest

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.probe.tables import TableParameters, read_tables
from agv_motion.probe.tables.local_time import DoubledHour, LocalClock, solar_offset, zone_of
from agv_motion.probe.tables.time_readers import Instant


def shown(word):
    return Instant(datetime.fromisoformat(word).replace(tzinfo=timezone.utc).timestamp(), False)  # noqa: FBT003


def hours(rule, *words):
    """Return UTC hours of the day of what a clock in Zurich showed on 27 October 2013."""
    clock = LocalClock(zone_of('Europe/Zurich'), rule)
    return [(clock.utc(shown(f'2013-10-27 {w}')) % 86400.0) / 3600.0 for w in words]


AUTUMN = '01:30', '02:00', '02:30', '02:00', '02:30', '03:00'


@pytest.mark.parametrize(
    ('rule', 'utc'),
    [
        (DoubledHour.IN_ORDER, [23.5, 0.0, 0.5, 1.0, 1.5, 2.0]),
        (DoubledHour.FIRST, [23.5, 0.0, 0.5, 0.0, 0.5, 2.0]),
        (DoubledHour.SECOND, [23.5, 1.0, 1.5, 1.0, 1.5, 2.0]),
    ],
)
def test_the_doubled_hour(rule, utc):
    assert hours(rule, *AUTUMN) == utc


def test_an_hourly_row_that_comes_again_is_of_the_second_pass():
    assert hours(DoubledHour.IN_ORDER, '01:00', '02:00', '02:00', '03:00') == [23.0, 0.0, 1.0, 2.0]


def test_a_file_with_the_newest_row_on_top(tmp_path):
    rows = [f'2013-10-27 {clock},{i}' for i, clock in enumerate(AUTUMN)]
    file = tmp_path / 'a.csv'
    file.write_text('time,a\n' + '\n'.join(reversed(rows)))
    given = TableParameters(file=str(file), columns=('a',), time_zone='Europe/Zurich')
    found = read_tables(given)
    assert found.values[:, 0].tolist() == [0, 1, 2, 3, 4, 5]
    assert set((found.times[1:] - found.times[:-1]).tolist()) == {1800.0}


def test_an_hour_that_there_never_was_names_the_remedy_and_the_line(tmp_path):
    with pytest.raises(SourceError, match=r'no 2013-03-31 02:30 in Europe/Zurich.*UTC\+1'):
        LocalClock(zone_of('Europe/Zurich'), DoubledHour.FIRST).utc(shown('2013-03-31 02:30'))
    file = tmp_path / 'a.csv'
    file.write_text('time,a\n2013-03-31 01:30,1\n2013-03-31 02:30,2\n')
    with pytest.raises(SourceError, match=r'a\.csv, line 3.*there was no'):
        read_tables(TableParameters(file=str(file), columns=('a',), time_zone='Europe/Zurich'))


@pytest.mark.parametrize(
    ('name', 'hours'), [('UTC', 0), ('', 0), ('UTC+1', 1), ('-03:30', -3.5), ('GMT+0530', 5.5)]
)
def test_fixed_offsets(name, hours):
    clock = LocalClock(zone_of(name), DoubledHour.FIRST)
    assert clock.utc(Instant(1e9, zoned=False)) == 1e9 - 3600.0 * hours
    assert clock.utc(Instant(1e9, zoned=True)) == 1e9


@pytest.mark.parametrize('name', ['Zurich', '../etc/passwd', 'UTC+15', 'x' * 300, 'CEST summer'])
def test_what_is_no_zone_is_refused(name):
    with pytest.raises(ConfigurationError, match=r'time_zone = .*Europe/Zurich'):
        zone_of(name)


@pytest.mark.parametrize(
    ('name', 'hours'),
    [('UTC', 0.0), ('UTC-3:30', -3.5), ('Europe/Zurich', 1.0), ('Europe/Dublin', 0.0),
     ('America/New_York', -5.0), ('Australia/Sydney', 10.0)],
)  # fmt: skip
@pytest.mark.parametrize('time', [1370000000.0, 1385000000.0], ids=['June', 'November'])
def test_the_sun_knows_no_summer_time(name, hours, time):
    assert solar_offset(name, time) == hours
