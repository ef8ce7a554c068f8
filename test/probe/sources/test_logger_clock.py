"""A line whose time leaps by days is left out, until the next goes on from it."""

from __future__ import annotations

from agv_motion.probe.sources.logger_clock import OFF_CLOCK, LoggerClock

NOW = 1_400_000_000.0
MONTH = 30 * 86400.0


def test_one_line_of_another_month_is_left_out_and_all_others_are_not():
    clock = LoggerClock()
    ahead = [0.0, MONTH, 0.0, -MONTH, 0.0, MONTH, -MONTH, MONTH, 0.0]
    left_out = [
        clock.has_leapt(NOW + each + 30.0 * i, NOW + 30.0 * i) for i, each in enumerate(ahead)
    ]
    assert left_out == [each != 0.0 for each in ahead]


def test_a_logger_that_was_set_is_believed_from_its_second_line_on():
    clock = LoggerClock()
    assert [clock.has_leapt(NOW + each, NOW) for each in (0.0, MONTH, MONTH + 30.0, MONTH)] == [
        False, True, False, False,
    ]  # fmt: skip
    assert clock.has_leapt(NOW, NOW)
    assert not clock.has_leapt(NOW + 30.0, NOW + 30.0)


def test_what_is_less_than_a_day_off_goes_on():
    """Summer time, a drift of years, and lines that come late together."""
    clock = LoggerClock()
    assert not clock.has_leapt(NOW - MONTH, NOW)  # never set: nothing before tells better
    for ahead in (3600.0, 0.0, OFF_CLOCK - 1.0):
        assert not clock.has_leapt(NOW - MONTH + ahead, NOW)
    assert clock.has_leapt(NOW - MONTH + 2.0 * OFF_CLOCK - 1.0, NOW)


def test_a_clock_that_has_not_begun_tells_nothing():
    clock = LoggerClock()
    assert not clock.has_leapt(NOW, 0.0)
    assert not clock.has_leapt(NOW + MONTH, 5.0)
    assert not clock.has_leapt(NOW, NOW)
    assert clock.has_leapt(NOW + MONTH, NOW)
