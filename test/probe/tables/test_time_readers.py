"""Each way to write a time, in words and by hand."""

from __future__ import annotations

from datetime import datetime, timezone

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.probe.tables import time_readers
from agv_motion.probe.tables.time_readers import FORMATS, UNASKED, Instant, in_range, of_pattern

DAWN = 1_370_822_400.0
"""[s] since 1970: 2013-06-10"""
NOON = 43200.0


@pytest.mark.parametrize(
    ('name', 'word', 'since_dawn'),
    [
        ('iso', '2013-06-10', 0.0),
        ('iso', '2013-06-10 24:00', 86400.0),
        ('iso', '2013-06-10 24:00:00', 86400.0),
        ('iso', '2013-06-10T12:00:00.25', NOON + 0.25),
        ('iso', '2013-06-10, 12:00', NOON),
        ('iso', '20130610T1200', NOON),
        ('day_first', '10/06/13 12:00', NOON),
        ('day_first', '10-6-2013 12:00 PM', NOON),
        ('month_first', '6/10/2013 12:00:00 AM', 0.0),
        ('month_first', '6/10/2013 11:59 p.m.', 86340.0),
        ('named_month', '10 June 2013 12:00', NOON),
        ('named_month', 'Jun 10, 2013 12:00', NOON),
        ('YYYYMMDD', '20130610', 0.0),
        ('YYYYMMDDHHMM', '201306102400', 86400.0),
        ('epoch_ms', '1370822400250', 0.25),
        ('excel', '41435.5', NOON),
        ('excel', '41435.0208333', 1800.0),
        ('excel', '41435.521', NOON + 1800.0),  # three digits tell 86 s: a whole minute is meant
        ('excel', '41435.5215', NOON + 1860.0),  # four tell 8.6 s: 2.4 s from it is meant for it
        ('excel', '41435.5001', NOON + 9.0),  # and 8.64 s from it is meant for a whole second
        ('excel_1904', '39973.5', NOON),
        ('matlab', '735395.5', NOON),
        ('year_day', '2013 161 1200', NOON),
        ('year_day', '2013 161 2400', 86400.0),
        ('year_day', '2013 161 12:00', NOON),
        ('year_day', '2013 161.5', NOON),
        ('fields', '2013 6 10', 0.0),
        ('fields', '2013 6 10 12', NOON),
        ('fields', '2013 6 10 11 59 60', None),
        ('fields', '2013 6 10 11 59 59.5', NOON - 0.5),
        ('fields', '2013 6 10 24', 86400.0),
        ('year_day', '2012 366', -161 * 86400.0),
        ('year_day', '2013 161 0', 0.0),
        ('year_day', '2013 161 5', 300.0),
        ('year_day', '2013 161 12345', 5025.0),
        ('year_day', '2013 161 12:00:01,5', NOON + 1.5),
        ('year_day', '2013 161 1:00PM', NOON + 3600.0),
        ('year_day', '2013 161.000012', 1.0),
        ('iso', '2013-06-10 12:59:59', NOON + 3599.0),
        ('iso', '2013-06-10 12:30 AM', 1800.0),
        ('iso', '2013-06-10 01:30 PM', NOON + 5400.0),
        ('YYYYMMDDHHMMSS', '20130610120102', NOON + 62.0),
        ('YYYYMMDDHHMM', '201306101201', NOON + 60.0),
        ('epoch_us', '1370822400250000', 0.25),
        ('epoch_ns', '1370822400250000000', 0.25),
        ('epoch_s', '1370822400', 0.0),
    ],
)
def test_words(name, word, since_dawn):
    if since_dawn is None:
        with pytest.raises(ValueError, match='11'):
            FORMATS[name](word)
    else:
        assert FORMATS[name](word).seconds == pytest.approx(DAWN + since_dawn, abs=1e-6)


@pytest.mark.parametrize(
    ('word', 'seconds'),
    [
        ('2013-06-10T02:00:00+02:00', DAWN),
        ('2013-06-09 20:30-0330', DAWN),
        ('2013-06-10 00:00 Z', DAWN),
        ('2013-06-10 02:00+02', DAWN),
    ],
)
def test_a_zone_in_the_word_counts(word, seconds):
    assert FORMATS['iso'](word) == Instant(seconds, zoned=True)


@pytest.mark.parametrize(
    ('name', 'word'),
    [
        ('iso', '2013-02-29'), ('iso', '2013-06-10 24:01'), ('iso', '2013-06-10 12:60'),
        ('iso', '2013-06-10 12:00:60'), ('iso', '2013-06-10 13:00 PM'), ('iso', '13-06-10'),
        ('iso', '2013-06/10'), ('iso', '2013-06-10 12:3045'), ('day_first', '31/06/2013'),
        ('day_first', '10/13/2013'), ('named_month', '10 Jup 2013'), ('YYYYMMDD', '20131310'),
        ('YYYYMMDD', '2013061'),
        ('fields', '201\uff13 6 10'), ('epoch_s', '-5'), ('epoch_s', 'inf'),
        ('epoch_s', '1_370_822_400'), ('excel', ''), ('year_day', '2013 366'),
        ('year_day', '2013 0.5'), ('year_day', '2013 161.5 1200'), ('fields', '13 6 10'),
        ('fields', '2013 6 10 12.5'), ('fields', '2013 0_6 1_0'),
        ('iso', '2013-06-10 12:30+14:30'), ('iso', '2013-06-10 12:30+01:60'),
        ('year_day', '13 161'), ('year_day', '20133 161'), ('year_day', 'x013 161'),
        ('year_day', '2013 161 12 30'), ('year_day', '201\uff13 161'), ('year_day', '2012 367'),
        ('year_day', '2013 0'), ('year_day', '2013 161 1260'),
        ('year_day', '2013 161 12:00Z'), ('fields', '2013 6 10 1 2 3 4'), ('fields', '2013 6'),
        ('fields', '2013 6 10 12 30.5'), ('YYYYMMDD', '2013061\uff10'), ('YYYYMMDD', '2013061x'),
        ('iso', '2013-06-10 0:30 PM'), ('iso', '2013-06-10 25:00'), ('iso', '2013-06-10 24:00:01'),
    ],
)  # fmt: skip
def test_what_is_no_such_time_is_refused(name, word):
    with pytest.raises((ValueError, OverflowError)):
        FORMATS[name](word)


@pytest.mark.parametrize('word', ['20130610', '201306101200', '41435.5', '1370822400000', '161'])
def test_no_number_but_seconds_is_taken_unasked(word):
    for read in UNASKED.values():
        try:
            instant = read(word)
        except ValueError:
            continue
        assert not in_range(instant)


def test_days_of_a_spreadsheet_tell_no_zone_whatever_their_digits():
    for word in ('41435.5', '41435.12345678'):
        assert not FORMATS['excel'](word).zoned


def test_what_is_less_than_a_hundredth_of_a_millisecond_is_rounding():
    read = FORMATS['excel']
    assert read('41435.50000000009').seconds == DAWN + NOON
    assert read('41435.50000000017').seconds == pytest.approx(DAWN + NOON + 1.5e-5, abs=1e-6)
    assert read('41435.50000000017').seconds != DAWN + NOON


def test_who_tells_no_zone_is_known():
    """Seconds since 1970 have one; what is written in digits may be of any place."""
    assert all(FORMATS[f'epoch_{unit}']('7').zoned for unit in ('s', 'ms', 'us', 'ns'))
    words = {
        'iso': ('2013-06-10', '2013-06-10 12:00'), 'YYYYMMDD': ('20130610',),
        'matlab': ('735395',), 'year_day': ('2013 161', '2013 161 1200'),
        'fields': ('2013 6 10',), 'day_first': ('10.06.2013 12:00',),
    }  # fmt: skip
    assert not any(FORMATS[name](word).zoned for name, told in words.items() for word in told)
    assert not of_pattern('%d.%m.%Y')('10.06.2013').zoned


def test_a_logger_wrote_from_1990_to_2099():
    seconds = 631_151_999.0, 631_152_000.0, 4_102_444_799.0, 4_102_444_800.0
    found = [in_range(Instant(one, zoned=True)) for one in seconds]
    assert found == [False, True, True, False]


@pytest.mark.parametrize(
    ('word', 'zoned'),
    [('2013-06-10 12:00', False), ('2013-06-10T12:00:00', False), ('2013-06-10 12:00:00Z', True)],
)
def test_the_usual_word_is_read_the_quick_way(word, zoned, monkeypatch):
    monkeypatch.setattr(time_readers, '_iso', None)
    assert UNASKED['iso'](word) == Instant(DAWN + NOON, zoned)


def test_unasked_a_number_is_of_seconds_since_1970():
    assert UNASKED['iso']('1370822400.5') == Instant(DAWN + 0.5, zoned=True)
    assert UNASKED['iso']('2013-6-10') == Instant(DAWN, zoned=False)


def test_patterns():
    assert of_pattern('%d.%m.%Y %H:%M')('10.06.2013 24:00').seconds == DAWN + 86400.0
    assert of_pattern('%Y-%m-%d %H:%M %z')('2013-06-10 02:00 +0200') == Instant(DAWN, zoned=True)
    assert of_pattern('%H%M %d.%m.%Y')('2400 10.06.2013').seconds == DAWN + 86400.0
    with pytest.raises(ValueError, match='time data'):
        of_pattern('%H:%M:%S %d.%m.%Y')('24:00:30 10.06.2013')
    for word in ('10.06.2013 24:30', '10.06.2013', 'soon'):
        with pytest.raises(ValueError, match='time data'):
            of_pattern('%d.%m.%Y %H:%M')(word)


@given(st.datetimes(datetime(1990, 1, 1), datetime(2099, 12, 31)))  # noqa: DTZ001 - as written
def test_every_format_reads_what_it_writes(moment):
    moment = moment.replace(microsecond=0)
    seconds = moment.replace(tzinfo=timezone.utc).timestamp()
    words = {
        'iso': f'{moment:%Y-%m-%d %H:%M:%S}',
        'day_first': f'{moment:%d.%m.%Y %H:%M:%S}',
        'month_first': f'{moment:%m/%d/%Y %I:%M:%S %p}',
        'named_month': f'{moment:%d-%b-%Y %H:%M:%S}',
        'YYYYMMDDHHMMSS': f'{moment:%Y%m%d%H%M%S}',
        'epoch_s': f'{seconds:.0f}',
        'epoch_us': f'{1e6 * seconds:.0f}',
        'excel': f'{seconds / 86400.0 + 25569.0:.10f}',
        'matlab': f'{seconds / 86400.0 + 719529.0:.9f}',
        'year_day': f'{moment.year} {moment.timetuple().tm_yday} {moment:%H:%M:%S}',
        'fields': f'{moment:%Y %m %d %H %M %S}',
    }
    for name, word in words.items():
        assert FORMATS[name](word).seconds == seconds, name
