"""Which format a column is written in: the one that reads it, never a guess between two."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.probe.tables.time_format import (
    choose,
    named,
    readings,
    second_reading,
    without_clock,
)

DAYS = [f'{day:02}/06/2013 12:00' for day in range(1, 29)]


@pytest.mark.parametrize(
    ('words', 'name'),
    [
        (['2013-06-10 12:00', '1370822400'], 'iso'),
        (DAYS, 'day_first'),
        ([f'06/{day:02}/2013' for day in range(1, 29)], 'month_first'),
        (['10.06.2013'], 'day_first'),
        (['10-Jun-2013'], 'named_month'),
        (['end of file', '', '13/06/2013'], 'day_first'),
        ([*DAYS * 2, '06/13/2013'], 'day_first'),
        (['nothing'], 'iso'),
    ],
)
def test_the_format_that_reads_them(words, name):
    assert choose(words, joined=False).name == name


def test_a_proof_anywhere_in_a_long_file_counts():
    words = ['10/06/2013'] * 1001 + ['13/06/2013'] + ['11/06/2013'] * 1000
    assert choose(words, joined=False).name == 'day_first'


@pytest.mark.parametrize(
    'words', [['10/06/2013', '11/06/2013'], ['13/06/2013', '06/13/2013', '10/06/2013']]
)
def test_days_that_may_be_months_are_refused_with_both_readings(words):
    match = r'(2013-06-10|2013-10-06).*day_first.*month_first.*csv\.time_format'
    with pytest.raises(SourceError, match=match):
        choose(words, joined=False)


def test_ten_times_as_many_days_alone_are_not_enough_and_eleven_are():
    both = ['06/13/2013', '10/06/2013']
    words = [f'{day}/06/2013' for day in range(13, 24)]
    assert choose([*both, *words], joined=False).name == 'day_first'
    with pytest.raises(SourceError, match=r"'10/06/2013' may be .*2013-06-10.*2013-10-06"):
        choose([*both, *words[1:]], joined=False)


def test_columns_that_are_joined():
    assert choose(['2013 161 0', '2013 161 30'], joined=True).name == 'year_day'
    assert choose(['2013 6 10 0 30'], joined=True).name == 'fields'
    with pytest.raises(SourceError, match='2013-06-10'):
        choose(['2013 6 10'], joined=True)


@pytest.mark.parametrize(
    ('word', 'remedy'),
    [
        ('20130610', 'YYYYMMDD reads 2013-06-10'),
        ('201306101200', 'YYYYMMDDHHMM reads 2013-06-10T12:00:00'),
        ('41435.5', 'excel reads 2013-06-10T12:00:00'),
        ('735395.5', 'matlab reads 2013-06-10T12:00:00'),
        ('1370865600000', 'epoch_ms reads 2013-06-10T12:00:00'),
        ('2013161', 'give ISO 8601'),
        ('00:30', 'give ISO 8601'),
    ],
)
def test_a_number_is_refused_with_the_format_that_would_read_it(word, remedy):
    with pytest.raises(SourceError, match=f'{word}.* is no time.*{remedy}') as caught:
        choose([word], joined=False).instant(word)
    assert word not in caught.value.unquoted


def test_what_a_word_may_be():
    assert readings('20130610') == {'YYYYMMDD': 1_370_822_400.0}
    assert readings('x') == {}


def test_ten_digits_of_a_date_and_days_with_several_rows_are_refused():
    assert '%Y%m%d%H' in second_reading(['2013061000', '2013061001'])
    assert not second_reading(['2013061000', '1370822400'])
    assert 'date + clock' in without_clock(['2013-06-10'] * 2, [86400.0, 86400.0])
    assert not without_clock(['2013-06-10', '2013-06-11'], [0.0, 86400.0])
    assert not without_clock(['2013-06-10 00:00'] * 2, [0.0, 0.0])
    assert not without_clock(['2013-06-10', '2013-06-10 00:00'], [0.0, 0.0])
    assert not without_clock(['2013-06-10'] * 2, [0.0, 1.0])
    assert not without_clock(['20130610', '2013061006', '2013061006'], [0.0, 21600.0, 21600.0])


def test_names():
    assert named('%H:%M').name == '%H:%M'
    with pytest.raises(ConfigurationError, match="time_format = 'us': choose auto, iso, day_first"):
        named('us')
