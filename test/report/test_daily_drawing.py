"""Pictures of a day: zones that are none, and robots of whom nothing is known."""

from __future__ import annotations

from xml.etree import ElementTree as ET

import pytest

from agv_motion.report import style
from agv_motion.report.daily_drawing import bar_of, map_of, rings
from agv_motion.report.daily_robot import GoalOfDay, RobotDay, Spans


@pytest.mark.parametrize(
    'text', ['', '{', '[1]', 'null', '[' * 9999, '{"boundary": 3, "holes": "x"}',
             '{"boundary": [[0, NaN], [1, 1], [2, 2]]}'],
)  # fmt: skip
def test_what_is_no_zone_has_no_edges(text):
    assert not any(rings(text).values())


def test_of_whom_nothing_is_known_nothing_is_drawn():
    assert map_of(RobotDay('oak')) == bar_of(RobotDay('oak'), 0.0, 10.0) == ''


def test_a_name_with_markup_is_a_name():
    robot = RobotDay('<oak>')
    robot.trail = [(0.0, 0.0), (1.0, 1.0)]
    assert '&lt;oak&gt;' in map_of(robot)
    ET.fromstring(map_of(robot))  # noqa: S314 - our own


def test_a_way_has_two_ends_a_length_and_goals_that_lie_together_share_a_disc():
    robot = RobotDay('oak')
    robot.trail = [(0.0, 0.0), (12.0, 0.0)]
    robot.goals = [GoalOfDay(0.0, x, 5.0) for x in (2.0, 9.0, 2.1)]
    drawn = ET.fromstring(map_of(robot))  # noqa: S314 - our own
    assert [text.text for text in drawn.iter('text')] == ['1\u2009·\u20093', '2', '2 m']
    assert [end.get('fill') for end in drawn.iter('circle')] == ['#ffffff', style.ROBOT]


def test_a_robot_that_stood_is_drawn_too():
    robot = RobotDay('oak')
    robot.trail = [(3.0, 3.0)]
    assert 'NaN' not in map_of(robot)
    assert 'inf' not in map_of(robot)


def test_spans_end_where_nobody_has_told_for_long():
    spans = Spans()
    for time in (0.0, 10.0, 20.0, 5000.0, 5010.0):
        spans.add(time, 'resting', 'sap', '')
    assert [(span.begin, span.end) for span in spans.spans] == [(0.0, 20.0), (5000.0, 5010.0)]
    assert spans.totals() == {'resting': 30.0}
