"""What is told of a tree: each thing once, until it changes."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip('rclpy')

from agv_motion.activity import Activity, Cause, Doing
from agv_motion.motion.behavior.sap_flow import SapFlow
from agv_motion.motion.behavior.schedule import ALWAYS
from agv_motion.nodes.motion_report import MotionReport, missing
from agv_motion.planar import Pose


class Port:
    """A port that notes what is published and logged."""

    def __init__(self):
        self.told, self.now = [], 1.0

    def seconds(self):
        return self.now

    def publisher(self, _kind, topic, _qos, **_):
        return SimpleNamespace(publish=lambda message: self.told.append((topic, message)))

    def listen(self, _kind, topic, callback, _qos):
        assert topic == 'granier/state'
        self.hears_losses = callback

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
        report.publish_state(Doing(state, Activity.RESTING, Cause.SAP))
    assert [(topic, message.data) for topic, message in port.told] == [
        ('state', 'resting'), ('state', 'moving'),
    ]  # fmt: skip
    assert report.state == 'moving'


def test_a_lost_probe_is_told_beside_what_the_tree_does(port, report):
    doing = Doing('walking', Activity.WALKING, Cause.SAP)
    for losses in ('probe_2 is off: held', ''):
        port.hears_losses(SimpleNamespace(data=losses))
        report.publish_state(doing)
    assert [message.data for topic, message in port.told if topic == 'state'] == [
        'walking; probe_2 is off: held', 'walking',
    ]  # fmt: skip


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


def test_since_when_counts_from_the_last_change_of_activity_or_cause(port, report):
    """The sentence of a walk changes with its goal; it walks all the while."""
    for now, state, activity, because in (
        (2.0, 'resting: the sap stands', Activity.RESTING, Cause.SAP),
        (5.0, 'walking to (1, 2)', Activity.WALKING, Cause.GOAL),
        (9.0, 'walking to (3, 4)', Activity.WALKING, Cause.GOAL),
    ):
        port.now = now
        report.publish_state(Doing(state, activity, because, 'ash'))
    assert report.values(ALWAYS, 'Europe/Paris') == {
        'activity': 'walking', 'because': 'goal', 'since [s]': '5.0', 'waits for': 'ash',
        'hours': 'open', 'hours until [s]': 'inf', 'time zone': 'Europe/Paris',
    }  # fmt: skip


HERE, FLOW = Pose(0.0, 0.0, 0.0), SapFlow(1.0, 0.5, 0.5)


@pytest.mark.parametrize(
    ('given', 'expected'),
    [
        ((None, None), ('resting: no input', Activity.STARTING, Cause.SAP_FLOW)),
        ((None, FLOW), ('resting: no input', Activity.STARTING, Cause.POSE)),
        ((HERE, None, 'sap flow'), ('resting: no sap flow', Activity.STARTING, Cause.SAP_FLOW)),
        ((HERE, FLOW, 'sap flow'), ('resting: no sap flow', Activity.STOPPED, Cause.SAP_FLOW)),
        ((HERE, FLOW, 'pose'), ('resting: no pose', Activity.STOPPED, Cause.POSE)),
        ((HERE, FLOW, '', 'it stands'), ('resting: it stands', Activity.STOPPED, Cause.CLOCK)),
    ],
)
def test_what_is_missing_is_told_for_programs(given, expected):
    assert missing(*given)[:3] == expected
