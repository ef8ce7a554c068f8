"""Zero flow: the highest reading before dawn, latched when the night ends."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.probe.zero_flow import ZeroFlow
from agv_motion.probe.zero_flow_method import MovingWindow

HOUR = 3600.0
DAY = 24 * HOUR


def fed(zero_flow, day, readings):
    """Feed (hour, value) pairs of one day."""
    for hour, value in readings:
        zero_flow.update(day * DAY + hour * HOUR, value)
    return zero_flow.value


def night(level):
    return [(2.0, level - 0.1), (3.0, level), (4.0, level), (5.0, level), (6.5, level - 0.2)]


def test_unknown_until_the_first_night_ends():
    zero_flow = ZeroFlow(2.0, 7.0, MovingWindow(3), 0.0)
    assert fed(zero_flow, 0, night(20.0)) is None
    assert fed(zero_flow, 0, [(7.0, 19.5)]) == 20.0


def test_however_small_the_signal_of_a_probe_is():
    zero_flow = ZeroFlow(2.0, 7.0, MovingWindow(3), 0.0)
    assert fed(zero_flow, 0, [*night(0.5), (7.0, 0.4)]) == 0.5


def test_latched_all_day_whatever_comes():
    zero_flow = ZeroFlow(2.0, 7.0, MovingWindow(3), 0.0)
    fed(zero_flow, 0, night(20.0))
    assert fed(zero_flow, 0, [(8.0, 15.0), (12.0, 25.0), (13.0, 25.0), (14.0, 25.0)]) == 20.0
    assert fed(zero_flow, 1, night(20.5)) == 20.0
    assert fed(zero_flow, 1, [(7.5, 19.0)]) == 20.5


def test_a_single_spike_at_night_decides_nothing():
    zero_flow = ZeroFlow(2.0, 7.0, MovingWindow(3), 0.0)
    spiked = [(2.0, 20.0), (3.0, 20.0), (4.0, 29.0), (5.0, 20.0), (6.0, 20.0), (8.0, 19.0)]
    assert fed(zero_flow, 0, spiked) == 20.0


def test_the_highest_of_the_last_nights_counts():
    """Three nights: 21, 20, 20 give 21; the fourth drops the first."""
    zero_flow = ZeroFlow(2.0, 7.0, MovingWindow(3), 0.0)
    seen = [fed(zero_flow, d, [*night(n), (8.0, 18.0)]) for d, n in enumerate([21, 20, 20, 20])]
    assert seen == [21.0, 21.0, 21.0, 20.0]


def test_after_days_without_a_night_nothing_is_known():
    zero_flow = ZeroFlow(2.0, 7.0, MovingWindow(3), 0.0)
    assert fed(zero_flow, 0, [*night(20.0), (8.0, 18.0)]) == 20.0
    assert fed(zero_flow, 3, [(12.0, 18.0)]) == 20.0
    assert fed(zero_flow, 4, [(12.0, 18.0)]) is None


def test_the_night_is_that_of_the_place():
    """At solar time UTC + 6 h the hours before dawn are 20:00 to 01:00 UTC."""
    zero_flow = ZeroFlow(2.0, 7.0, MovingWindow(3), 6.0)
    assert fed(zero_flow, 0, [(20.0, 20.0), (21.0, 20.0), (22.0, 20.0), (26.0, 18.0)]) == 20.0


def test_recalibration_forgets_and_adopts():
    zero_flow = ZeroFlow(2.0, 7.0, MovingWindow(3), 0.0)
    fed(zero_flow, 0, [*night(20.0), (8.0, 18.0)])
    zero_flow.recalibrate(0 * DAY + 9 * HOUR, 17.0)
    assert zero_flow.value == 17.0


def test_a_restart_remembers_the_nights():
    first, second = (ZeroFlow(2.0, 7.0, MovingWindow(3), 0.0) for _ in range(2))
    fed(first, 0, [*night(20.0), (8.0, 18.0)])
    second.restore(first.state())
    assert second.value == 20.0
    with pytest.raises(ConfigurationError, match='delete the state file'):
        second.restore({'nights': 'lost'})
