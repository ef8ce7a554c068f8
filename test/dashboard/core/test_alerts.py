"""Alerts: raised once, cleared once, and nothing that trembles is told."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.dashboard.core.alerts import MOST, Alert, AlertBook, PlainLink

OFF = [
    PlainLink('decision', 'WARN', 'resting', 'sap flow'),
    PlainLink('sap flow', 'WARN', 'resting: probe_2 is off', 'probe_2'),
    PlainLink('probe_2', 'WARN', 'probe 2 is off since 14:02'),
]
WELL = [PlainLink('decision', 'OK', 'walking'), PlainLink('probe_2', 'OK', 'good')]
HELD = [PlainLink('wheels', 'ERROR', 'turrets fight')]


def feed(book, links, times, robot='oak'):
    """Return what changed at which time."""
    return [(now, alert) for now in times for alert in book.update(robot, links, float(now))]


def test_one_cause_is_one_alert_raised_when_it_has_lasted():
    book = AlertBook()
    ((now, alert),) = feed(book, OFF, range(100))
    assert now == 30
    assert alert == Alert(
        'oak-probe_2-30.000', 'oak', 'probe_2', 'WARN', 'probe 2 is off since 14:02', 30.0
    )
    assert book.standing() == [alert]


def test_an_error_is_told_after_a_second_and_is_over_when_all_has_been_well_for_five():
    book = AlertBook()
    assert [now for now, _ in feed(book, HELD, range(10))] == [1]
    ((now, over),) = feed(book, WELL, range(10, 30))
    assert now == 15
    assert over.cleared == 10.0
    assert book.standing() == []
    assert book.alerts() == [over]


def test_what_trembles_raises_nothing_and_clears_nothing():
    book = AlertBook()
    for now in range(0, 100, 2):
        assert book.update('oak', OFF, now) == []
        book.update('oak', WELL, now + 1)
    feed(book, OFF, range(100, 140))
    assert len(book.standing()) == 1
    for now in range(140, 240, 2):
        assert book.update('oak', WELL, now) == book.update('oak', OFF, now + 1) == []
    assert len(book.alerts()) == 1


def test_what_becomes_worse_is_told_again_and_must_be_seen_again():
    book = AlertBook()
    ((_, first),) = feed(book, OFF, range(40))
    assert book.acknowledge(first.id, 'maria', 41.0).by == 'maria'
    worse = [OFF[2]._replace(level='ERROR', sentence='probe 2 burns')]
    ((_, alert),) = feed(book, worse, range(50, 60))
    assert (alert.id, alert.level, alert.sentence) == (first.id, 'ERROR', 'probe 2 burns')
    assert (alert.acknowledged, alert.by) == (None, '')


def test_the_first_who_acknowledges_counts_and_of_what_is_not_there_nobody_can():
    book = AlertBook()
    ((_, alert),) = feed(book, HELD, range(5))
    book.acknowledge(alert.id, 'maria', 7.0)
    assert book.acknowledge(alert.id, 'jean', 9.0)[-2:] == (7.0, 'maria')
    assert book.acknowledge('oak-wheels-0', 'jean', 9.0) is None


def test_a_robot_that_falls_silent_is_an_alert_of_its_own():
    book = AlertBook()
    book.update('oak', WELL, 100.0)
    assert book.look(104.0) == []
    assert book.look(105.0) == []
    (alert,) = book.look(106.5)
    assert (alert.name, alert.level, alert.sentence) == (
        'silence', 'ERROR', 'oak has said nothing for 6 s',
    )  # fmt: skip
    for now in range(110, 120):
        book.update('oak', WELL, float(now))
        book.look(float(now))
    assert book.standing() == []


def test_robots_are_told_apart():
    book = AlertBook()
    feed(book, HELD, range(5), 'oak')
    feed(book, HELD, range(5), 'ash')
    assert sorted(alert.robot for alert in book.standing()) == ['ash', 'oak']


def test_a_clock_that_is_set_back_raises_nothing_by_itself():
    book = AlertBook()
    book.update('oak', OFF, 1000.0)
    assert book.update('oak', OFF, 10.0) == []
    assert [now for now, _ in feed(book, OFF, range(11, 60))] == [40]


def test_alerts_of_an_earlier_run_that_still_stand_are_cleared_if_all_is_well():
    book = AlertBook()
    feed(book, HELD, range(5))
    later = AlertBook()
    later.restore(book.alerts())
    ((_, over),) = feed(later, WELL, range(100, 120))
    assert (over.id, over.cleared) == (book.alerts()[0].id, 100.0)


def test_alerts_do_not_grow_without_end():
    book = AlertBook(clear_after=0.0)
    for k in range(MOST + 50):
        feed(book, HELD, (10.0 * k, 10.0 * k + 2.0))
        book.update('oak', WELL, 10.0 * k + 3.0)
    assert len(book.alerts()) == MOST


@given(st.lists(st.sampled_from(['OK', 'WARN', 'STALE', 'ERROR', 'else']), max_size=60))
def test_an_alert_stands_only_after_a_fault_and_never_twice(levels):
    book = AlertBook({'WARN': 3.0, 'STALE': 2.0, 'ERROR': 1.0}, clear_after=2.0)
    for now, level in enumerate(levels):
        book.update('oak', [PlainLink('wheels', level, level)], float(now))
        assert len(book.standing()) <= 1
        for alert in book.alerts():
            assert alert.level in levels
            assert alert.cleared is None or alert.cleared >= alert.raised


@pytest.mark.parametrize('name', ['<b>', 'a b', ''])
def test_an_id_holds_no_blank(name):
    book = AlertBook()
    ((_, alert),) = feed(book, [PlainLink(name, 'ERROR', 'x')], range(3))
    assert ' ' not in alert.id
