"""What is shown of a message: chosen by a filter, one field of it, as YAML or as CSV."""

from __future__ import annotations

import pytest

geometry = pytest.importorskip('geometry_msgs.msg')

from agv_motion.cli.topic.message_printer import MessagePrinter, part_of, predicate
from agv_motion.cli.topic.message_text import MessageText
from agv_motion.errors import ConfigurationError

ABOUT = {'source_timestamp': 7, 'received_timestamp': 5}
POINT = geometry.Point(x=1.0, y=-2.5, z=0.0)


def printer(*, csv=False, field='', filter_expr='', info=False):
    return MessagePrinter(
        MessageText(), csv=csv, field=field, filter_expr=filter_expr, info=info
    )  # fmt: skip


@pytest.mark.parametrize(
    ('options', 'shown'),
    [
        ({}, 'x: 1.0\ny: -2.5\nz: 0.0\n---\n'),
        ({'field': 'y'}, '-2.5\n---\n'),
        ({'csv': True}, '1.0,-2.5,0.0\n'),
        ({'csv': True, 'field': 'y'}, '-2.5\n'),
        ({'csv': True, 'field': 'y', 'info': True}, '7,5,-2.5\n'),
        (
            {'field': 'x', 'info': True},
            'source_timestamp: 7\nreceived_timestamp: 5\n---\n1.0\n---\n',
        ),
    ],
)
def test_both_commands_show_a_message_alike(capsys, options, shown):
    assert printer(**options).show(POINT, ABOUT)
    assert capsys.readouterr().out == shown


def test_what_is_filtered_out_is_not_shown_and_not_counted(capsys):
    assert not printer(filter_expr='m.y > 0').show(POINT, ABOUT)
    assert capsys.readouterr().out == ''


def test_a_field_of_a_field():
    pose = geometry.Pose(position=POINT)
    assert part_of(pose, 'position.y') == -2.5
    assert part_of(pose, '') is pose
    with pytest.raises(ConfigurationError, match=r"no field 'yaw'; it has position, orientation"):
        part_of(pose, 'yaw')


@pytest.mark.parametrize('wrong', ['m.', 'm.x > ', '\0'])
def test_a_filter_that_is_no_expression_is_refused(wrong):
    with pytest.raises(ConfigurationError, match='is no Python expression'):
        predicate(wrong)


def test_a_filter_that_fails_names_what_m_is():
    with pytest.raises(ConfigurationError, match='m is a Point'):
        predicate('m.w > 0')(POINT)
