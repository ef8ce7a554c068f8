"""Lines as loggers write them: each read as a person would, or refused with its reason."""

from __future__ import annotations

from datetime import datetime, timezone
from math import isfinite, isnan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.probe.sources.logger_line import cleaned, read_line

NOON = datetime(2013, 6, 10, 12, 30, tzinfo=timezone.utc).timestamp()


@pytest.mark.parametrize(
    'text',
    [
        '10-06-13 12:30:00 0.41 0.52 0.63',
        '10-06-13\t12:30:00\t0.41\t0.52\t0.63',
        '10-06-13 12:30:00,0.41,0.52,0.63',
        '10-06-13,12:30:00, 0.41, 0.52, 0.63',
        '10-06-13 12:30:00 0.41,0.52,0.63',
        '10-06-13 12:30:00 0.41, 0.52, 0.63',
        '10-06-13;12:30:00;0.41;0.52;0.63',
        '2013-06-10T12:30:00Z 0.41 0.52 0.63',
        '2013-06-10 12:30:00 0.41 0.52 0.63',
        '2013/06/10 12:30:00 0.41 0.52 0.63',
        '"2013-06-10 12:30:00",0.41,0.52,0.63',
        '10-06-2013 12:30:00 0.41 0.52 0.63',
        '10.06.13 12:30:00 0.41 0.52 0.63',
        '10/06/13 12:30:00 0.41 0.52 0.63',
        '1370867400 0.41 0.52 0.63',
        '10-06-13 12:30 0.41 0.52 0.63',
        '17 10-06-13 12:30:00 0.41 0.52 0.63',
        '10-06-13 12:30:00 0.41 0.52 0.63,',
        '10-06-13 12:30:00 +4.1e-1 .52 63e-2',
    ],
)
def test_forms_of_one_line(text):
    assert read_line(text) == (NOON, (0.41, 0.52, 0.63), False)


@pytest.mark.parametrize(
    'text',
    ['10-06-13;12:30:00;0,41;0,52;0,63', '10-06-13 12:30:00 0,41 0,52 0,63',
     '10-06-13 12:30:00;0,41;0,52;0,63;'],
)  # fmt: skip
def test_a_decimal_comma_is_read_and_said(text):
    assert read_line(text) == (NOON, (0.41, 0.52, 0.63), True)


@pytest.mark.parametrize(
    ('text', 'seconds'),
    [
        ('10-06-13 12:30:00.5 1', NOON + 0.5),
        ('2013-06-10T12:30:00+02:00 1', NOON - 7200.0),
        ('2013-06-10T12:30:00-0530 1', NOON + 5.5 * 3600.0),
        ('10-06-13 24:00 1', NOON + 11.5 * 3600.0),
        ('1370867400.25 1', NOON + 0.25),
    ],
)
def test_times(text, seconds):
    assert read_line(text).time == pytest.approx(seconds, abs=1e-6)


def test_the_clock_of_the_logger_counts_where_the_line_does_not_say_better():
    assert read_line('10-06-13 12:30:00 1', 2.0).time == NOON - 7200.0
    assert read_line('2013-06-10T12:30:00Z 1', 2.0).time == NOON
    assert read_line('1370867400 1', 2.0).time == NOON


def test_what_stands_for_no_value_is_none():
    values = read_line('10-06-13 12:30:00 NAN 0.52 -9999 1_0 0x1 inf').values
    assert values[1] == 0.52
    assert [isnan(value) for value in values] == [True, False, True, True, True, True]


@pytest.mark.parametrize(
    ('text', 'reason'),
    [
        ('T1:0.41 T2:0.52 T3:0.63', 'no time'),
        ('123456 0.41 0.52 0.63', 'no time'),
        ('01+0110. 02+0161. 03+1230. 04+0.41 05+0.52 06+0.63', 'no time'),
        ('110,2013,161,1230,0.41,0.52,0.63', 'no time'),
        (
            'D,081044,"JOB1",2013/06/10,12:30:00,0.000366,0;A,0,0.41,0.52,0.63;0071;42AB',
            'no time',
        ),
        ('27.08.20 18:04:48,52050502;94FE;4D;1597453200;36126', 'both , and ;'),
        ('10-06-70 12:30:00 1 2 3', 'the year is 2070'),
        ('01-01-00 00:00:07 0.41 0.52 0.63', 'the year is 2000'),
        ('01-01-1970 00:00:07 0.41 0.52 0.63', 'the year is 1970'),
        ('31-02-13 12:30:00 1 2 3', 'no such time'),
        ('10-13-13 12:30:00 1 2 3', 'no such time'),
        ('10-06-13 25:30:00 1 2 3', 'no such time'),
        ('10-06-13 12:30:61 1 2 3', 'no such time'),
        ('2013-06-10T12:30:00+15:00 1 2 3', 'no such zone'),
        ('2013-06-10T12:30:00+01:60 1 2 3', 'no such zone'),
        ('10-06/13 12:30:00 1 2 3', 'no time'),
        ('10-06-13 12:30:00,0,41,0,52,0,63', 'may be decimal'),
        ('10-06-13 12:30:00 0,41,0,52', 'may be decimal'),
        ('', 'no time'),
    ],
)
def test_what_has_no_one_reading_is_refused(text, reason):
    with pytest.raises(SignalError, match=reason):
        read_line(text)


@given(st.text(st.sampled_from('0123456789 -+./:,;TZeEaN\t'), max_size=60))
def test_any_line_is_read_or_refused(text):
    for whole in (text, f'10-06-13 12:30:00 {text}', f'10-06-13 12:30:00{text}'):
        try:
            line = read_line(whole)
        except SignalError:
            continue
        assert isfinite(line.time)


@given(st.lists(st.floats(-5e3, 5e3), min_size=1, max_size=8), st.sampled_from(' \t;'))
def test_what_is_written_is_read(values, gap):
    text = gap.join(['10-06-13 12:30:00', *(repr(value) for value in values)])
    assert read_line(text).values == pytest.approx(values)


@given(st.binary(max_size=80))
def test_any_bytes_are_text(data):
    assert '\0' not in cleaned(b'\0' + data.replace(b'\0', b'') + b'\0\x04')
