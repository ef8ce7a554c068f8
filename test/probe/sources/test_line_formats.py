"""Lines of other loggers: by name, by pattern, with checksums; stamped where they tell no time."""

from __future__ import annotations

from datetime import datetime, timezone
from math import isnan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import AgvMotionError, ConfigurationError, SignalError
from agv_motion.probe.sources.checksum import Checksum, checked
from agv_motion.probe.sources.line_formats import LINE_FORMATS
from agv_motion.probe.sources.line_reading import read_line_of, sample_of
from agv_motion.probe.sources.serial_line import SerialParameters

NOON = datetime(2013, 6, 10, 12, 30, tzinfo=timezone.utc).timestamp()
NOW = NOON + 7.0
THREE = (0.41, 0.52, 0.63)
TREETALKER = r'(?P<time>\S+ \S+),\d+;\w+;\w+;(?P<v1>\d+);(?P<v2>\d+)'


def parse_line(text, given, now):
    return sample_of(text, read_line_of(text, given, now), given)


def read(text, format_='auto', fields=(1, 2, 3), **given):
    return parse_line(text, SerialParameters(format=format_, fields=fields, unit='K', **given), NOW)


@pytest.mark.parametrize(
    ('text', 'given', 'time'),
    [
        ('0.41 0.52 0.63', {'format_': 'arrival'}, NOW),
        ('0,41;0,52;0,63', {'format_': 'arrival'}, NOW),
        ('T1:0.41 T2:0.52 T3:0.63', {'format_': 'arrival'}, NOW),
        ('a=0.41, b = 0.52, c = 0.63', {'format_': 'arrival'}, NOW),
        ('123456 0.41 0.52 0.63', {'format_': 'arrival', 'fields': (2, 3, 4)}, NOW),
        ('110,2013,161,1230,0.41,0.52,0.63', {'format_': 'campbell_comma'}, NOON),
        (
            '01+0110. 02+0161. 03+1230. 04+0.41 05+0.52 06+0.63',
            {'format_': 'campbell_printable'},
            NOON,
        ),
        (
            '01+110. 02+2013. 03+161. 04+1230. 05+0.41 06+0.52 07+0.63',
            {'format_': 'campbell_printable'},
            NOON,
        ),
        (
            'D,081044,"JOB1",2013/06/10,12:30:00,0.000366,0;A,0,0.41,0.52,0.63;0071;42AB',
            {'format_': 'datataker'},
            NOON + 0.000366,
        ),
        (
            'at 10.06.2013 12:30 T1=0,41 T2=0,52 T3=0,63',
            {
                'format_': r'at (?P<time>\S+ \S+) T1=(?P<v1>\S+) T2=(?P<v2>\S+) T3=(?P<v3>\S+)',
                'time_format': 'day_first',
            },
            NOON,
        ),
        ('OAK>0.41|0.52|0.63<', {'format_': r'>(?P<v1>.*)\|(?P<v2>.*)\|(?P<v3>.*)<'}, NOW),
        ('x [0.41, 0.52, 0.63]', {'format_': r'\[(?P<values>.*)\]'}, NOW),
        (
            '110,2013,161,1430,0.41,0.52,0.63',
            {'format_': 'campbell_comma', 'utc_offset': 2.0},
            NOON,
        ),
    ],
)
def test_what_loggers_write(text, given, time):
    sample = read(text, **given)
    assert sample.time == pytest.approx(time, abs=1e-6)
    assert sample.values == pytest.approx(THREE)


def test_a_treetalker_by_its_pattern():
    sample = read(
        '27.08.20 18:04:48,52050502;94FE;4D;1597453200;36126', TREETALKER, (2,),
        time_format='day_first',
    )  # fmt: skip
    assert sample.values == (36126.0,)
    assert sample.time == datetime(2020, 8, 27, 18, 4, 48, tzinfo=timezone.utc).timestamp()


def test_a_year_that_is_not_told_is_the_nearest():
    """New year's eve, read on new year's day."""
    now = datetime(2014, 1, 1, 0, 1, tzinfo=timezone.utc).timestamp()
    given = SerialParameters(format='campbell_printable', fields=(1,), unit='K')
    sample = parse_line('01+0110. 02+0365. 03+2359. 04+0.5', given, now)
    assert sample.time == now - 120.0
    sample = parse_line('01+0110. 02+0001. 03+0001. 04+0.5', given, now - 120.0)
    assert sample.time == now


def test_what_is_beyond_all_numbers_is_missing():
    sample = read('110,2013,161,1230,1e999,0.5,0.6,1e999,9', 'campbell_comma', radiation_field=4)
    assert isnan(sample.values[0])
    assert isnan(sample.environment.radiation)


def test_what_stands_for_no_value_is_missing():
    values = read('110,2013,161,1230,-7999,NAN,0.63', 'campbell_comma').values
    assert [isnan(value) for value in values] == [True, True, False]


@pytest.mark.parametrize(
    ('text', 'format_', 'match'),
    [
        ('41,52,63,7', 'arrival', 'may be decimal or stand between'),
        ('110,2013,161', 'campbell_comma', 'not of the form array,year'),
        ('110,2013,367,1230,1,2,3', 'campbell_comma', 'day 367, clock 1230 is no time'),
        ('110,1970,161,1230,1,2,3', 'campbell_comma', 'year 1970'),
        ('01+0110. 03+1230.', 'campbell_printable', 'not of the form 01'),
        ('D,1;A,0,1', 'datataker', 'not of the form D,serial'),
        ('110,9999,366,1230,1,2,3', 'campbell_comma', 'is no time'),
        ('110,1990,001,0005,1,2,3', 'campbell_comma', 'the clock of the logger was not set'),
        ('110,2013,161,,1,2,3', 'campbell_comma', 'is no time'),
        ('01+0110. 02+0161.7 03+1230. 04+1', 'campbell_printable', 'day 161.7, clock 1230 is no'),
        ('D,1,"J",2013/06/10,12:30:00,x,0;A,0,1', 'datataker', "'x' is no fraction"),
        ('D,1,"J",2013/06/10,12:30:00,1e9,0;A,0,1', 'datataker', "'1e9' is no fraction"),
        ('D,1,"J",2013/06/10,12:30:00,1.0,0;A,0,1', 'datataker', "'1.0' is no fraction"),
        ('D,1,"J",2013/06/10,12:30:00,-0.1,0;A,0,1', 'datataker', "'-0.1' is no fraction"),
        ('D,1,"J",2000/01/01,00:00:05,0,0;A,0,1', 'datataker', 'the clock of the logger was not'),
        ('none', r'(?P<v1>\d+)', 'not of the form'),
        ('ch1 0.41 ch2 0.52 ch3 0.63', 'arrival', "a word stands beside each value .'ch1 0.41'"),
        ('0.41 mV 0.52 mV 0.63 mV', 'arrival', "beside each value .'0.41 mV'"),
        ('10-06-13 12:30:00 0.41 K 0.52 K 0.63', 'auto', "beside each value .'0.41 K'"),
        ('10-06-13 1:30:00 PM 0.41 0.52 0.63', 'auto', 'a clock of twelve hours: give a regular'),
        ('10-06-13;01:30 a.m.;0,41;0,52;0,63', 'auto', 'a clock of twelve hours'),
        ('0.41', 'arrival', '1 values, probe field 3 is missing'),
    ],
)
def test_what_is_not_of_the_form_is_refused_and_quoted(text, format_, match):
    with pytest.raises(SignalError, match=match) as caught:
        read(text, format_)
    assert text in str(caught.value)


@pytest.mark.parametrize('text', ['0.41 ERR 0.63', 'NAN 0.52 NAN 0.63', 'ERR ERR ERR', 'x 0.5 1'])
def test_a_word_in_place_of_a_value_is_missing(text):
    values = read(text, 'arrival').values
    expected = [not word[0].isdigit() for word in text.split()]
    assert [isnan(value) for value in values] == expected[:3]


@pytest.mark.parametrize('format_', [*LINE_FORMATS, r'(?P<v1>\d+)'])
@pytest.mark.parametrize('rubbish', ['7' * 10_000, '0.41 ' * 2000, 'a' * 1025])
def test_a_line_that_is_longer_than_any_is_refused_unread(format_, rubbish):
    with pytest.raises(SignalError, match=f'it has {len(rubbish)} letters') as caught:
        read(rubbish, format_)
    assert len(str(caught.value)) < 300
    assert read('0.41 ' * 204, 'arrival').values == (0.41, 0.41, 0.41)  # as long as may be


@pytest.mark.parametrize(
    ('format_', 'match'),
    [
        ('nmea', 'choose auto, arrival'),
        ('(?P<v1>', 'is no regular expression'),
        ('(?P<time>x)', 'names no value'),
    ],
)
def test_a_format_that_is_none_is_refused(format_, match):
    with pytest.raises(ConfigurationError, match=match):
        SerialParameters(format=format_)


@pytest.mark.parametrize(
    ('text', 'kind'),
    [
        ('$GPGGA,092750.000,5321.6802,N,00630.3372,W,1,8,1.03,61.7,M,55.2,M,,*76', Checksum.XOR),
        ('123456789;31C3', Checksum.CRC16),
        ('ab,C3', Checksum.SUM),
    ],
)
def test_checksums_that_others_published(text, kind):
    """NMEA's own example; the check value of CRC-16/XMODEM; 97 + 98."""
    assert checked(text, kind) in text
    with pytest.raises(SignalError, match='its checksum is'):
        checked('x' + text, kind)
    with pytest.raises(SignalError, match='has no checksum'):
        checked('0.41 0.52', kind)
    assert checked(text, Checksum.NONE) == text


@given(st.sampled_from(sorted(LINE_FORMATS)), st.text(max_size=60))
def test_nothing_but_a_sample_or_a_refusal_comes_of_any_line(format_, text):
    try:
        sample = read(text, format_, (1,))
    except AgvMotionError:
        return
    assert 6.3e8 <= sample.time <= 4.2e9
    assert not any(abs(value) == float('inf') for value in sample.values)
