"""Opening hours: days, midnight, summer time, the hours before dawn, and what is no hour."""

from __future__ import annotations

from datetime import datetime, timezone
from zoneinfo import ZoneInfo

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.motion.behavior.schedule import ALWAYS, Phase, Schedule, ScheduleParameters

PARIS = ZoneInfo('Europe/Paris')


def schedule(**parameters):
    return Schedule(ScheduleParameters(enabled=True, time_zone='Europe/Paris', **parameters))


def paris(text):
    return datetime.fromisoformat(text).replace(tzinfo=PARIS).timestamp()


def test_no_schedule_is_always_open():
    assert Schedule(ScheduleParameters()).hour(0.0) == ALWAYS


@pytest.mark.parametrize(
    ('moment', 'phase', 'until'),
    [
        ('2015-06-15T09:59:59', Phase.CLOSED, '2015-06-15T10:00'),  # a Monday
        ('2015-06-15T10:00:00', Phase.OPEN, '2015-06-15T18:00'),
        ('2015-06-15T18:00:00', Phase.CLOSED, '2015-06-16T10:00'),
        ('2015-06-20T18:00:00', Phase.CLOSED, '2015-06-22T10:00'),  # over Sunday
        ('2015-06-21T12:00:00', Phase.CLOSED, '2015-06-22T10:00'),
        ('2015-06-15T04:30:00', Phase.CALIBRATING, '2015-06-15T09:00'),  # 02:30 to 07:00 UTC
    ],
)
def test_opening_hours(moment, phase, until):
    hour = schedule().hour(paris(moment))
    assert hour == (phase, paris(until))


@pytest.mark.parametrize(
    ('moment', 'phase'),
    [
        ('2015-06-15T19:00', Phase.CLOSED), ('2015-06-15T23:00', Phase.OPEN),
        ('2015-06-16T00:59', Phase.OPEN), ('2015-06-16T01:00', Phase.CLOSED),
        ('2015-06-21T00:30', Phase.OPEN), ('2015-06-21T23:00', Phase.CLOSED),
        ('2015-06-22T00:30', Phase.CLOSED),
    ],
)  # fmt: skip
def test_hours_over_midnight_belong_to_the_day_on_which_they_begin(moment, phase):
    hours = schedule(opens='20:00', closes='01:00', solar_offset=-2.0)
    assert hours.hour(paris(moment)).phase is phase


@pytest.mark.parametrize('day', ['2015-03-28', '2015-03-30', '2015-10-24', '2015-10-26'])
def test_summer_time_moves_the_hours_with_the_local_clock(day):
    """Closed at 09:59 and open at 10:00, before and after the clocks change."""
    assert schedule().hour(paris(f'{day}T09:59')).phase is Phase.CLOSED
    assert schedule().hour(paris(f'{day}T10:00')).phase is Phase.OPEN


def test_the_night_of_the_change_is_an_hour_longer():
    hours = schedule(opens='22:00', closes='06:00', night_end=2.0, days=('sat',))
    begin = paris('2015-10-24T22:00')
    assert hours.hour(begin).until - begin == 9 * 3600.0


@pytest.mark.parametrize('day', [22, 24, 27, 28])
def test_the_only_hours_of_a_week_may_be_left_out_by_the_clocks(day):
    """On 29 March 2015 there is no 02:30: open it is a week later."""
    hours = schedule(opens='02:30', closes='03:00', days=('sun',), night_start=0.0, night_end=0.0)
    hour = hours.hour(paris(f'2015-03-{day}T12:00'))
    assert (hour.phase, hour.until) == (Phase.CLOSED, paris('2015-04-05T02:30'))


def test_before_dawn_wins_over_opening_hours():
    hours = schedule(opens='00:00', closes='23:59', solar_offset=0.16)
    night = datetime(2015, 6, 15, 4, 0, tzinfo=timezone.utc).timestamp()
    assert hours.hour(night).phase is Phase.CALIBRATING
    before = hours.hour(night - 3 * 3600.0)
    assert before.phase is Phase.OPEN
    assert before.until == pytest.approx(night - 2 * 3600.0 - 0.16 * 3600.0)


HOURS = st.builds('{:02d}:{:02d}'.format, st.integers(0, 23), st.integers(0, 59))


@given(HOURS, HOURS, st.integers(0, 2**31), st.floats(-14, 14))
def test_until_is_in_the_future_and_the_phase_holds_until_then(opens, closes, now, offset):
    if opens == closes:
        return
    hours = schedule(opens=opens, closes=closes, solar_offset=offset)
    phase, until = hours.hour(now)
    assert now < until <= now + 8 * 86400.0
    assert phase is Phase.CLOSED or hours.hour((now + until) / 2.0).phase is phase


def test_a_moment_in_words():
    assert schedule().clock(paris('2015-06-15T10:00')) == 'Mon 10:00'


@pytest.mark.parametrize(
    ('parameters', 'word'),
    [
        ({'time_zone': 'Paris'}, 'give an IANA name'),
        ({'time_zone': '../etc/passwd'}, 'give an IANA name'),
        ({'opens': '25:00'}, "opens = '25:00'"),
        ({'closes': 'late'}, "closes = 'late'"),
        ({'opens': '18:00'}, 'opens = closes'),
        ({'days': ()}, 'give at least one'),
        ({'days': ('lundi',)}, "days = 'lundi': choose one of mon"),
        ({'night_start': 8.0}, 'lie in one day'),
    ],
)
def test_hours_that_are_none_are_refused(parameters, word):
    with pytest.raises(ConfigurationError, match=word):
        ScheduleParameters(**parameters)


@pytest.mark.parametrize('offset', [-3.0, 0.25, 6.0])
def test_the_hours_before_dawn_are_those_of_the_sun_over_the_place(offset):
    hours = schedule(
        opens='00:00', closes='23:59', night_start=2.0, night_end=5.0, solar_offset=offset
    )
    start = datetime(2015, 6, 17, tzinfo=timezone.utc).timestamp() + (2.0 - offset) * 3600.0
    found = [hours.hour(start + seconds) for seconds in (-1.0, 0.0, 10_799.0, 10_800.0)]
    assert [hour.phase is Phase.CALIBRATING for hour in found] == [False, True, True, False]
    assert found[1].until == found[2].until == start + 10_800.0
