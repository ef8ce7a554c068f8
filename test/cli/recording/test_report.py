"""`agv report`, as a person types it: a bag, a day, and what is neither."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped

from agv_motion.bag import BagWriter
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import type_name

NOON = 1434369600 * 1_000_000_000


@pytest.fixture
def bags(tmp_path):
    """Return a folder with a bag of a robot that goes two metres, and a file that is no bag."""
    writer, kind = BagWriter(tmp_path / 'walk'), PoseWithCovarianceStamped
    topic = writer.add_topic('/oak/pose', type_name(kind))
    for i in range(3):
        message = PoseWithCovarianceStamped()
        message.pose.pose.position.x = float(i)
        writer.write(topic, NOON + i * 1_000_000_000, codec(kind).encode(message))
    writer.close()
    (tmp_path / 'torn.mcap').write_bytes(b'nothing')
    return tmp_path


def test_of_a_bag_it_is_written_beside_the_bag(alone, bags):
    status, out, errors = alone('report', bags / 'walk')
    assert status == 0, errors
    made = bags / 'report_2015-06-15.html'
    assert out == f'Report: {made}\n'
    text = made.read_text(encoding='utf-8')
    assert 'It went <b>2.0 m</b>' in text
    assert text.endswith('</html>\n')


def test_of_a_day_all_bags_of_it_are_read(alone, bags, tmp_path):
    out_file = tmp_path / 'day.html'
    status, _, errors = alone(
        'report', '2015-06-15', '--bags', bags, '--time-zone', 'Europe/Paris', '-o', out_file
    )
    assert status == 0, errors
    assert 'torn.mcap' in errors
    text = out_file.read_text(encoding='utf-8')
    assert '00:00 to 00:00 (Europe/Paris), 1 robot' in text
    assert 'It went <b>2.0 m</b>' in text


@pytest.mark.parametrize(
    ('arguments', 'reason'),
    [
        (['2015-06-16'], 'no bag of 2015-06-16 among 2 in'),
        (['2015-06-15', '--time-zone', 'No/Where'], "--time-zone 'No/Where': give an IANA name"),
        (['nowhere'], 'nowhere'),
    ],
)
def test_what_cannot_be_is_told(alone, bags, arguments, reason):
    status, _, errors = alone('report', *arguments, '--bags', bags)
    assert status == 1
    assert reason in errors
    assert 'Traceback' not in errors
