"""A bag that was recorded with an arbiter is reprocessed as it was wired, one without as ever."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import TwistStamped
from sensor_msgs.msg import JointState

from agv_motion.bag.reader import BagReader
from agv_motion.bag.writer import BagWriter
from agv_motion.errors import ConfigurationError
from agv_motion.reprocess.one_bag import Plan, reprocess
from agv_motion.reprocess.wiring import names_for, nodes_for
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import stamp_of

SECOND = 1_000_000_000
START = 1000 * SECOND
WITH = ['/oak/cmd_vel', '/oak/cmd_vel/agent', '/oak/cmd_vel/manual']
WITHOUT = ['/oak/cmd_vel', '/oak/odom']
CMD_VEL = '/oak/cmd_vel'


@pytest.mark.parametrize(
    ('node', 'source'),
    [
        ('motion_generator', 'agent'),
        ('ghost_trajectory', 'page'),
        ('route_follower', 'route'),
        ('sequence', 'sequence'),
    ],
)
def test_what_a_node_drives_as(node, source):
    given = {'/oak/pose': '/oak/fix'}
    assert names_for(node, WITH, '/oak', given) == given | {CMD_VEL: f'{CMD_VEL}/{source}'}
    assert names_for(node, WITHOUT, '/oak', given) == given
    assert names_for(node, WITH, '/ash', {}) == {}
    assert names_for(node, WITH, '/oak', {CMD_VEL: '/other'}) == {CMD_VEL: '/other'}


@pytest.mark.parametrize('node', ['arbiter', 'wheel_kinematics', 'localization'])
def test_who_drives_nothing_keeps_its_names(node):
    assert names_for(node, WITH, '/oak', {}) == {}


def test_an_arbiter_is_run_where_one_was_recorded():
    nodes = 'motion_generator', 'arbiter', 'wheel_kinematics'
    assert nodes_for(nodes, WITH, '/oak') == nodes
    assert nodes_for(nodes, WITHOUT, '/oak') == ('motion_generator', 'wheel_kinematics')
    with pytest.raises(ConfigurationError, match='no /oak/cmd_vel/agent'):
        nodes_for(('arbiter',), WITHOUT, '/oak')


def record(path):
    """Write a bag: the agent drives all the time, a person for a second, then comes a STOP."""
    said = [('agent', 0.1 * i, 0.2) for i in range(60)]
    said += [('manual', 2.0 + 0.05 * i, -0.1 if i < 20 else 0.0) for i in range(24)]
    said += [('stop', 5.0, 0.0)]
    with BagWriter(path) as bag:
        topics = {
            name: bag.add_topic(f'/cmd_vel/{name}', 'geometry_msgs/msg/TwistStamped')
            for name in ('agent', 'manual', 'stop')
        }
        for source, seconds, speed in sorted(said, key=lambda one: one[1]):
            message, stamp = TwistStamped(), START + round(seconds * SECOND)
            message.header.stamp = stamp_of(stamp)
            message.twist.linear.x = speed
            bag.write(topics[source], stamp, codec(TwistStamped).encode(message))
    return path


def read(bag, topic, kind):
    with BagReader(bag) as found:
        return [
            ((message.stamp - START) / SECOND, codec(kind).decode(message.data))
            for message in found.messages([topic])
        ]


def test_an_arbiter_decides_again_the_same_every_time(tmp_path):
    bag = record(tmp_path / 'drive')
    plan = Plan('differential.yaml', ('arbiter', 'differential_kinematics'), (), 'zstd')
    results = [tmp_path / name / 'again' for name in ('one', 'two')]
    for result in results:
        outcome = reprocess(bag, result, plan)
        assert outcome.failure == ''
        assert outcome.messages_in == 85
    files = [next(result.glob('*.mcap')).read_bytes() for result in results]
    assert files[0] == files[1]
    drivers = [
        (moment, {pair.key: pair.value for pair in message.values}['driver'])
        for moment, message in read(results[0], '/driver', DiagnosticStatus)
    ]
    changes = [one for i, one in enumerate(drivers) if not i or one[1] != drivers[i - 1][1]]
    assert [name for _, name in changes] == ['none', 'agent', 'manual', 'agent', 'stop', 'none']
    assert changes[2][0] == 2.0
    assert changes[4][0] == 5.0
    commands = read(results[0], '/wheels/command', JointState)
    assert any(min(message.velocity) < 0.0 for moment, message in commands if 2.0 < moment < 3.0)
    assert not any(any(message.velocity) for moment, message in commands if moment > 5.0)


def test_the_kinematics_alone_stand_by_what_was_recorded(tmp_path):
    arbiter = Plan('', ('arbiter',), (), 'none')
    assert reprocess(record(tmp_path / 'drive'), tmp_path / 'held', arbiter).failure == ''
    plan = Plan('', ('differential_kinematics',), (), 'none')
    assert reprocess(tmp_path / 'held', tmp_path / 'wheels', plan).failure == ''
    commands = read(tmp_path / 'wheels', '/wheels/command', JointState)
    assert any(any(message.velocity) for moment, message in commands if 4.0 < moment < 5.0)
    assert not any(any(message.velocity) for moment, message in commands if moment > 5.0)


def test_a_bag_without_an_arbiter_is_refused_where_nothing_else_is_asked_for(tmp_path):
    with BagWriter(tmp_path / 'old') as bag:
        bag.write(bag.add_topic('/cmd_vel', 'geometry_msgs/msg/TwistStamped'), START,
                  codec(TwistStamped).encode(TwistStamped()))  # fmt: skip
    outcome = reprocess(tmp_path / 'old', tmp_path / 'new', Plan('', ('arbiter',), (), 'none'))
    assert 'recorded without an arbiter' in outcome.failure
    assert not (tmp_path / 'new').exists()
