"""`agv plot` of bags written by an independent library."""

from __future__ import annotations

from math import cos, sin

import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

STORE = get_typestore(Stores.ROS2_JAZZY)
TYPES = STORE.types


def header(time, frame):
    seconds, rest = divmod(round(time * 1e9), 1_000_000_000)
    stamp = TYPES['builtin_interfaces/msg/Time'](sec=seconds, nanosec=rest)
    return TYPES['std_msgs/msg/Header'](stamp=stamp, frame_id=frame)


def stamped(time, x, y, theta, frame='map'):
    place = TYPES['geometry_msgs/msg/Point'](x=x, y=y, z=0.0)
    turn = TYPES['geometry_msgs/msg/Quaternion'](x=0.0, y=0.0, z=sin(theta / 2), w=cos(theta / 2))
    pose = TYPES['geometry_msgs/msg/Pose'](position=place, orientation=turn)
    return TYPES['geometry_msgs/msg/PoseStamped'](header=header(time, frame), pose=pose)


def write(path, topics):
    """Write messages of poses and paths, by topic, as rosbag2 does."""
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        for topic, messages in topics.items():
            kind = messages[0].__msgtype__
            connection = writer.add_connection(topic, kind, typestore=STORE)
            for message in messages:
                stamp = message.header.stamp
                time = stamp.sec * 1_000_000_000 + stamp.nanosec
                writer.write(connection, time, STORE.serialize_cdr(message, kind))


def test_the_errors_of_a_robot_beside_its_ghost(alone, tmp_path):
    """The robot goes 3 cm behind and 4 cm to the left of its Ghost: 5 cm away."""
    times = [10.0 + 0.02 * i for i in range(200)]
    write(tmp_path / 'bag', {
        '/hare/ghost/pose': [stamped(t, 0.5 * (t - 10.0), 0.0, 0.0) for t in times],
        '/hare/ghost/path': [
            TYPES['nav_msgs/msg/Path'](
                header=header(10.0, 'map'),
                poses=[stamped(10.0, x, 0.0, 0.0) for x in (0.0, 2.0)],
            )
        ],
        '/hare/ground_truth': [
            stamped(t + 0.007, 0.5 * (t + 0.007 - 10.0) - 0.03, 0.04, 0.0) for t in times
        ],
        '/hare/odom': [stamped(t, 9.0, 9.0, 0.0, 'odom') for t in times],
    })  # fmt: skip
    picture = tmp_path / 'run.png'
    status, out, errors = alone('plot', tmp_path / 'bag', '-o', picture, cold=True)
    assert status == 0, errors
    assert '/hare/ground_truth: 4.0 s, 1.99 m' in out
    assert 'from /hare/ghost/pose: root mean square 5.00 cm, at most 5.00 cm' in out
    assert picture.read_bytes().startswith(b'\x89PNG')
    status, out, errors = alone('plot', tmp_path / 'bag', '-o', picture, '--driven', 'hare/odom')
    assert status == 0, errors
    assert "/hare/ghost/pose is in 'map', /hare/odom in 'odom'" in errors


def test_without_a_ghost_the_way_is_drawn(alone, tmp_path):
    messages = [stamped(0.1 * i, 0.05 * i, 0.0, 0.0) for i in range(50)]
    write(tmp_path / 'bag', {'/pose': messages})
    picture = tmp_path / 'run.png'
    status, out, errors = alone('plot', tmp_path / 'bag', '-o', picture)
    assert status == 0, errors
    assert '/pose: 4.9 s, 2.45 m' in out
    assert picture.read_bytes().startswith(b'\x89PNG')


@pytest.mark.parametrize(
    ('options', 'reason'),
    [([], 'does not tell where the robot was'), (['--driven', 'odo'], 'no poses on /odo')],
)
def test_a_bag_that_does_not_tell_is_refused(alone, tmp_path, options, reason):
    write(tmp_path / 'bag', {'/goal_pose': [stamped(1.0, 0.0, 0.0, 0.0)]})
    status, _, errors = alone('plot', tmp_path / 'bag', '-o', tmp_path / 'run.png', *options)
    assert status == 1
    assert reason in errors


def test_no_bag_at_all(alone, tmp_path):
    status, _, errors = alone('plot', tmp_path / 'none')
    assert status == 1
    assert 'does not exist: give the folder of a bag' in errors
    assert 'Traceback' not in errors
