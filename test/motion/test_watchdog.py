"""Silence: fresh, late, lost, and a clock that jumps."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.motion.watchdog import Silence, Watchdog


def test_fresh_then_late_then_lost_then_fresh_again():
    watchdog = Watchdog(3.0, 5.0)
    assert watchdog.judge(0.0) is Silence.LOST
    watchdog.feed()
    judged = [watchdog.judge(t) for t in (10.0, 12.9, 13.0, 14.9, 15.0)]
    assert judged == [Silence.FRESH, Silence.FRESH, Silence.LATE, Silence.LATE, Silence.LOST]
    assert watchdog.age(15.0) == 5.0
    watchdog.feed()
    assert watchdog.judge(20.0) is Silence.FRESH


def test_a_clock_that_jumps_back_is_silence():
    watchdog = Watchdog(3.0, 5.0)
    watchdog.feed()
    watchdog.judge(100.0)
    assert watchdog.judge(10.0) is Silence.LOST


@pytest.mark.parametrize(('report', 'stop'), [(0.0, 5.0), (6.0, 5.0), (float('nan'), 5.0)])
def test_limits_out_of_order_are_refused(report, stop):
    with pytest.raises(ConfigurationError, match='must be positive'):
        Watchdog(report, stop)
