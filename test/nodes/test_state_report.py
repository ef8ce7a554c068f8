"""What a robot does: words where they change, and since when."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.activity import Activity, Cause
from agv_motion.nodes.state_report import StateReport


@pytest.fixture
def port():
    told = []
    port = SimpleNamespace(now=3.0, told=told)
    port.seconds = lambda: port.now
    port.publisher = lambda *_, **__: SimpleNamespace(publish=lambda m: told.append(m.data))
    return port


def test_words_are_told_once_and_change_no_activity(port):
    report = StateReport(port, 'state')
    for word in ('driving', 'driving', 'turning'):
        port.now += 1.0
        report.tell(word)
    assert port.told == ['driving', 'turning']
    assert report.state == 'turning'
    assert report.values() == {'activity': 'starting', 'because': 'nothing', 'since [s]': '3.0'}


def test_since_when_is_the_last_change_of_activity_or_cause(port):
    report = StateReport(port, 'state')
    for now, activity, because in (
        (5.0, Activity.DRIVING, Cause.GOAL),
        (6.0, Activity.DRIVING, Cause.GOAL),
        (7.0, Activity.DRIVING, Cause.PERSON),
        (8.0, Activity.DRIVING, Cause.PERSON),
    ):
        port.now = now
        report.note(activity, because)
    assert report.values() == {'activity': 'driving', 'because': 'person', 'since [s]': '7.0'}
    assert port.told == []


def test_a_time_before_simulated_time_began_is_none_to_count_from(port):
    port.now = 0.0
    report = StateReport(port, 'state')
    port.now = 9.0
    report.note(Activity.STARTING, Cause.NOTHING)
    assert report.values()['since [s]'] == '9.0'
