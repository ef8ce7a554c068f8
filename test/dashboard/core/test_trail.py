"""Where a robot was, and what it drank: thinned, and forgotten in time."""

from __future__ import annotations

import pytest

from agv_motion.dashboard.core.trail import BUCKETS, DAY, MINUTES, DayChart, Trail


def test_a_robot_that_stands_adds_no_place_and_old_ones_go():
    trail = Trail()
    assert trail.add(0.0, 1.0, 1.0)
    assert not trail.add(1.0, 1.01, 1.01)
    assert trail.add(2.0, 1.0, 2.0)
    assert trail.points() == [[1.0, 1.0], [1.0, 2.0]]
    assert trail.add(MINUTES + 1.0, 1.0, 2.0)
    assert trail.points() == [[1.0, 2.0]]


def test_where_the_clock_goes_back_what_came_later_did_not_happen():
    trail = Trail()
    for now in (10.0, 20.0, 30.0):
        trail.add(now, now, 0.0)
    assert trail.add(15.0, 10.0, 0.0)
    assert trail.points() == [[10.0, 0.0]]


def test_what_it_drank_is_the_mean_flow_over_the_hours():
    chart, noon = DayChart(), 12 * 3600.0
    for minute in range(0, 61, 4):
        chart.add(noon + 60.0 * minute, (0.5, 1.0, 0.0))
    assert chart.value()['drunk'] == pytest.approx(0.5)
    assert chart.value()['s2'][0] == 1.0


def test_a_flow_that_is_not_known_leaves_a_gap_and_the_next_day_begins_at_nothing():
    chart = DayChart()
    step = DAY / BUCKETS
    assert chart.add(1000.0, (1.0,))
    assert not chart.add(1000.0 + step, (None,))
    assert chart.add(1000.0 + 2.0 * step, (1.0,))
    assert chart.value()['drunk'] == 0.0
    chart.add(1000.0 + 2.5 * step, (1.0,))
    assert chart.value()['drunk'] == pytest.approx(0.5 * step / 3600.0, abs=1e-3)
    chart.add(DAY + 10.0, (1.0,))
    assert chart.value()['drunk'] == 0.0


def test_a_clock_that_goes_back_begins_the_chart_anew():
    chart = DayChart()
    chart.add(5000.0, (1.0,))
    chart.add(100.0, (0.5,))
    assert chart.value()['times'] == [100.0]
