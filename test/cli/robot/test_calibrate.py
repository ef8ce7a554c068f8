"""`agv calibrate`: bags of every kind of robot, with wheels that are not as drawn."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest
import yaml

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped
from sensor_msgs.msg import JointState

from agv_motion.bag.writer import BagWriter
from agv_motion.odometry.columns import pose_columns
from agv_motion.ros.cdr import codec
from agv_motion.ros.messages import stamp_of

PERIOD, NOISE = 0.1, 0.01
RADII, TRACK = (0.049, 0.0505), 0.31


def write(path, names, angles, poses, robots=('', '')):
    """Write wheel angles (n, m) and every tenth pose (3, m), seen with noise, into a bag.

    The first of ``robots`` (their namespaces) tells the angles, the second the poses.
    """
    rng = np.random.default_rng(1)
    with BagWriter(path) as bag:
        states = bag.add_topic(f'{robots[0]}/wheels/state', 'sensor_msgs/msg/JointState')
        fixes = bag.add_topic(f'{robots[1]}/fix', 'geometry_msgs/msg/PoseWithCovarianceStamped')
        for i in range(angles.shape[1]):
            time = round((100.0 + i * PERIOD) * 1e9)
            state = JointState(name=names, position=[float(a) for a in angles[:, i]])
            state.header.stamp = stamp_of(time)
            bag.write(states, time, codec(JointState).encode(state))
            if i % 10 == 0:
                fix = PoseWithCovarianceStamped()
                fix.header.stamp = stamp_of(time)
                x, y = poses[:2, i] + rng.normal(0.0, NOISE, 2)
                heading = poses[2, i] + rng.normal(0.0, NOISE)
                fix.pose.pose.position.x, fix.pose.pose.position.y = x, y
                fix.pose.pose.orientation.z = sin(heading / 2)
                fix.pose.pose.orientation.w = cos(heading / 2)
                fix.pose.covariance[0] = fix.pose.covariance[7] = NOISE**2
                fix.pose.covariance[35] = NOISE**2
                bag.write(fixes, time, codec(PoseWithCovarianceStamped).encode(fix))


def differential(path, turning, spoil=lambda angles, poses: None, robots=('', '')):
    """Drive a differential robot of RADII and TRACK for two minutes; ``spoil`` what is written."""
    rng = np.random.default_rng(2)
    way = np.zeros((3, 1200))
    way[0] = 0.3 * PERIOD
    way[2] = np.repeat(rng.uniform(-turning, turning, 60), 20) * PERIOD
    travel = np.array([way[0] - way[2] * TRACK / 2, way[0] + way[2] * TRACK / 2])
    turned = travel / np.array(RADII)[:, None]
    angles = np.concatenate([np.zeros((2, 1)), np.cumsum(turned, axis=1)], axis=1)
    poses = pose_columns(way)
    spoil(angles, poses)
    write(path, ['left_wheel', 'right_wheel'], angles, poses, robots)


@pytest.fixture(scope='module')
def winding(tmp_path_factory):
    """Return a bag of a drive that tells everything, for all who only read it."""
    path = tmp_path_factory.mktemp('winding') / 'bag'
    differential(path, 0.8)
    return path


def test_radii_and_track_of_a_differential_drive(alone, tmp_path, winding):
    out_file = tmp_path / 'new.yaml'
    status, out, errors = alone('calibrate', winding, '-o', out_file)
    assert status == 0, errors
    assert 'not told' not in out
    given = yaml.safe_load(out_file.read_text())['/**']['ros__parameters']
    assert given['wheel_radii'] == pytest.approx(RADII, abs=3e-4)
    assert given['track_multiplier'] * 0.3 == pytest.approx(TRACK, abs=3e-3)
    status, out, _ = alone('parameters', 'differential_kinematics')
    assert set(given) <= set(out.split())


def test_a_straight_line_says_what_it_does_not_tell(alone, tmp_path):
    differential(tmp_path / 'bag', 0.0)
    asked = 'calibrate', tmp_path / 'bag', '-o', tmp_path / 'new.yaml'
    status, out, _ = alone(*asked)
    assert status == 0
    (track,) = [line for line in out.splitlines() if line.startswith('track')]
    assert 'not told by this motion' in track
    given = yaml.safe_load((tmp_path / 'new.yaml').read_text())
    assert given['/**']['ros__parameters']['track_multiplier'] == (pytest.approx(1.0, abs=1e-3))


@pytest.mark.parametrize(
    ('options', 'word'),
    [
        (['--reference', '/cam'], "no topic '/cam'"),
        (['--node', 'wings'], "node = 'wings'"),
        (['--reference', '/wheels/state'], '/wheels/state is sensor_msgs/msg/JointState, expected'),
        (['--namespace', 'oak'], 'neither turrets/state nor wheels/state'),
        (['--node', 'omni_kinematics'], 'expected'),
    ],
)
def test_what_is_missing_is_told(alone, winding, options, word):
    status, _, errors = alone('calibrate', winding, *options)
    assert status == 1
    assert word in ' '.join(errors.split())
    assert 'Traceback' not in errors


def calibrated(alone, tmp_path, *options, expected=0):
    """Return what the command says, and the parameters it writes."""
    asked = 'calibrate', tmp_path / 'bag', '-o', tmp_path / 'new.yaml', *options
    status, out, errors = alone(*asked)
    assert status == expected, errors
    (given,) = yaml.safe_load((tmp_path / 'new.yaml').read_text()).values()
    return out + errors, given['ros__parameters']


def test_messages_that_are_not_finite_are_left_out_and_counted(alone, tmp_path):
    def spoil(angles, poses):
        angles[1, 600] = np.nan
        poses[0, 300] = np.inf

    differential(tmp_path / 'bag', 0.8, spoil)
    told, given = calibrated(alone, tmp_path)
    assert '/wheels/state: 1 of 1201 messages left out, they are not finite' in told
    assert '/fix: 1 of 121 messages left out, they are not finite' in told
    assert given['wheel_radii'] == pytest.approx(RADII, abs=3e-4)


def test_a_drive_is_cut_where_the_robot_was_carried(alone, tmp_path):
    def spoil(_, poses):
        x, y, heading = poses[:, 705:].copy()
        poses[:, 705:] = 4.0 - y, 3.0 + x, heading + np.pi / 2

    differential(tmp_path / 'bag', 0.8, spoil)
    told, given = calibrated(alone, tmp_path)
    assert 'carried 1 times: the drive is cut there' in told
    assert given['wheel_radii'] == pytest.approx(RADII, abs=3e-4)
    assert given['track_multiplier'] * 0.3 == pytest.approx(TRACK, abs=3e-3)


def test_a_robot_that_stood_is_told_as_such(alone, tmp_path):
    def spoil(angles, poses):
        angles[:] = 1.0
        poses[:] = 0.5

    differential(tmp_path / 'bag', 0.8, spoil)
    status, _, errors = alone('calibrate', tmp_path / 'bag', '-o', tmp_path / 'new.yaml')
    assert status == 1
    assert 'the robot stood' in errors
    assert not (tmp_path / 'new.yaml').exists()


def test_no_other_robot_tells_the_places(alone, tmp_path):
    differential(tmp_path / 'bag', 0.5, robots=('/oak', '/elm'))
    options = '--namespace', 'oak', '-o', tmp_path / 'new.yaml'
    status, _, errors = alone('calibrate', tmp_path / 'bag', *options)
    assert status == 1
    assert 'has no fix, pose or ground_truth of /oak' in ' '.join(errors.split())
    told, _ = calibrated(alone, tmp_path, *options, '--reference', '/elm/fix')
    assert '/elm/fix' in told
    assert list(yaml.safe_load((tmp_path / 'new.yaml').read_text())) == ['/oak/**']


def test_a_bag_that_was_cut_off_is_read_up_to_there(alone, tmp_path, winding):
    (file,) = winding.glob('*.mcap')
    data = file.read_bytes()
    (tmp_path / 'bag').mkdir()
    (tmp_path / 'bag' / 'bag_0.mcap').write_bytes(data[: len(data) * 3 // 4])
    told, given = calibrated(alone, tmp_path, expected=1)
    assert 'bag_0.mcap, byte ' in told
    assert given['wheel_radii'] == pytest.approx(RADII, abs=3e-4)


def test_a_place_that_cannot_be_written_is_told(alone, tmp_path, winding):
    asked = '-o', tmp_path / 'nowhere' / 'new.yaml'
    status, _, errors = alone('calibrate', winding, *asked)
    assert status == 1
    assert 'cannot be written (No such file or directory)' in ' '.join(errors.split())


def test_places_that_wander_are_not_blamed_on_the_wheels(alone, tmp_path):
    """Reflections move the places by decimetres for a while: no radius is made of that."""

    def wander(_, poses):
        poses[:2] += np.cumsum(np.random.default_rng(3).normal(0.0, 0.03, (2, 1201)), axis=1)

    differential(tmp_path / 'bag', 0.8, wander)
    status, _, errors = alone('calibrate', tmp_path / 'bag', '-o', tmp_path / 'new.yaml')
    assert status == 1
    assert 'no parameters are written' in ' '.join(errors.split())
    assert not (tmp_path / 'new.yaml').exists()
