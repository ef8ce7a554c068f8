"""Silence: fresh, late, lost, and what was forgotten."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.watchdog import Silence, Watchdog


def test_fresh_then_late_then_lost_then_fresh_again():
    watchdog = Watchdog(3.0, 5.0)
    assert watchdog.judge(0.0) is Silence.LOST
    watchdog.feed(10.0)
    judged = [watchdog.judge(t) for t in (10.0, 12.9, 13.0, 14.9, 15.0)]
    assert judged == [Silence.FRESH, Silence.FRESH, Silence.LATE, Silence.LATE, Silence.LOST]
    assert watchdog.age(15.0) == 5.0
    watchdog.feed(20.0)
    assert watchdog.judge(20.0) is Silence.FRESH


def test_silence_counts_from_the_input_and_not_from_the_next_judgement():
    watchdog = Watchdog(3.0, 5.0)
    watchdog.feed(10.0)
    assert watchdog.judge(15.0) is Silence.LOST


def test_what_was_forgotten_is_lost_until_it_comes_again():
    watchdog = Watchdog(3.0, 5.0)
    watchdog.feed(10.0)
    watchdog.forget()
    assert watchdog.judge(10.0) is Silence.LOST
    watchdog.feed(11.0)
    assert watchdog.judge(11.0) is Silence.FRESH


@pytest.mark.parametrize(('report', 'stop'), [(0.0, 5.0), (6.0, 5.0), (float('nan'), 5.0)])
def test_limits_out_of_order_are_refused(report, stop):
    with pytest.raises(ConfigurationError, match='must be positive'):
        Watchdog(report, stop)
