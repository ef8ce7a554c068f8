"""What is told of a tree: each thing once, until it changes."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.nodes.motion_report import MotionReport


class Port:
    """A port that notes what is published and logged."""

    def __init__(self):
        self.told = []

    def publisher(self, _kind, topic, _qos, **_):
        return SimpleNamespace(publish=lambda message: self.told.append((topic, message)))

    def stamp(self, message):
        message.header.stamp.sec = 7

    def info(self, text):
        self.told.append(('log', text))


@pytest.fixture
def port():
    return Port()


@pytest.fixture
def report(port):
    return MotionReport(port, 'map')


def goal(x, y, reason='asked for'):
    return SimpleNamespace(place=(x, y), reason=reason)


def test_a_state_is_told_when_it_changes(port, report):
    for state in ('resting', 'resting', 'moving'):
        report.publish_state(state)
    assert [(topic, message.data) for topic, message in port.told] == [
        ('state', 'resting'), ('state', 'moving'),
    ]  # fmt: skip
    assert report.state == 'moving'


def test_a_goal_is_told_once_with_its_reason_and_the_refusals(port, report):
    first = goal(1.0, 2.0)
    report.update(first, ['(9, 9): outside'], ())
    report.update(first, ['(9, 9): outside'], ())
    assert [what for what in port.told if what[0] == 'log'] == [
        ('log', 'no goal: (9, 9): outside'), ('log', 'goal: asked for'),
    ]  # fmt: skip
    ((_, message),) = [what for what in port.told if what[0] == 'goal']
    assert (message.header.frame_id, message.header.stamp.sec) == ('map', 7)
    assert (message.pose.position.x, message.pose.position.y) == (1.0, 2.0)


def test_no_goal_is_no_message(port, report):
    report.publish_goal(None, ['nowhere'])
    assert port.told == [('log', 'no goal: nowhere')]


def test_a_path_is_told_when_its_corners_change_not_its_beginning(port, report):
    target = goal(3.0, 0.0)
    for begin in (0.0, 0.1, 0.2):
        report.update(target, (), ((begin, 0.0), (3.0, 0.0)))
    report.update(target, (), ((0.2, 0.0), (2.0, 1.0), (3.0, 0.0)))
    paths = [message for topic, message in port.told if topic == 'path']
    corners = [[(p.pose.position.x, p.pose.position.y) for p in m.poses] for m in paths]
    assert corners == [[(0.0, 0.0), (3.0, 0.0)], [(0.2, 0.0), (2.0, 1.0), (3.0, 0.0)]]
    assert {message.header.frame_id for message in paths} == {'map'}
