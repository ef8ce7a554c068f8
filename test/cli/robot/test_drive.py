"""`agv drive`, as a person types it: told beforehand, and driven on the graph."""

from __future__ import annotations

import signal

import pytest

pytest.importorskip('rclpy')

from agv_motion.nodes.ghost_trajectory import GhostTrajectory
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.run import overrides, start


def test_a_dry_run_tells_what_poses_ask_for_and_draws_it(alone, tmp_path):
    """1 m in a straight line at 0.4 m/s with 0.4 m/s2 and 0.2 s of rounding: 3.7 s."""
    picture = tmp_path / 'plan.png'
    status, out, errors = alone(
        'drive', 'to', -1, 0, 0, '--backward', '--dry-run', '--plot', picture
    )
    assert status == 0, errors
    assert '1.00 m in 3.7 s, at most 0.40 m/s' in out
    assert 'ends at -1.000 m, 0.000 m, 0.0 degrees' in out
    assert picture.read_bytes().startswith(b'\x89PNG')


def test_a_dry_run_predicts_where_an_arc_ends(alone):
    """Inner radius 0.5 m, half a track of 0.15 m: from (1, 1) looking along y to (0.35, 1.65)."""
    status, out, errors = alone(
        'drive', 'arc', '--angle', 90, '--diameter', 1.0, '--start', '1,1,90', '--dry-run'
    )
    assert status == 0, errors
    assert 'ends at 0.350 m, 1.650 m, -180.0 degrees' in out


@pytest.mark.parametrize(
    ('arguments', 'reason'),
    [
        (['to', '1', '2'], 'a pose is three numbers'),
        (['to', '1', 'nan', '0'], 'give X,Y,DEGREES'),
        (['arc', '--angle', '90', '--diameter', '-1'], 'diameter = -1.0 m'),
        (['to', '1', '0', '0', '--speed', '0'], 'cruising_speed = 0.0'),
    ],
)
def test_what_cannot_be_is_told_in_one_line(alone, arguments, reason):
    status, _, errors = alone('drive', *arguments, '--dry-run')
    assert status == 1
    assert reason in errors
    assert errors.count('\n') == 1


@pytest.fixture
def robot(graph, real_time_robot):
    """Return a robot, driven by a node that does a metre in two seconds."""
    node = LiveNode(
        GhostTrajectory,
        context=graph.context,
        parameter_overrides=overrides(cruising_speed=0.8, speed_ramps=2.0, rate=50.0),
    )
    start(graph.add(node))
    found = real_time_robot()
    found.find()
    found.driver = node
    return found


def test_it_drives_there_with_a_speed_for_this_time_alone(agv, robot):
    status, out, errors = agv('drive', 'to', 0.3, 0.1, 30, '--speed', 0.6)
    assert status == 0, errors
    assert 'at most 0.60 m/s' in out
    assert out.splitlines()[-1] == 'arrived'
    assert robot.pose[:2] == pytest.approx((0.3, 0.1), abs=0.03)
    assert robot.driver.parameters.cruising_speed == 0.8


def test_interrupted_it_brakes_and_fails(agv, robot):
    process = agv.start('drive', 'to', 50, 0, 0)
    robot.moves()
    process.send_signal(signal.SIGINT)
    agv.graph.spin_until(lambda: process.poll() is not None)
    out, _ = process.communicate()
    assert process.returncode == 1
    assert out.splitlines()[-1] == 'aborted'
    agv.graph.spin_until(lambda: not any(robot.commands[-1]))


def test_a_refusal_of_the_node_is_told(agv, robot):
    status, _, errors = agv('drive', 'to', 0.2, 0, 180, '--delta', 5)
    assert status == 1
    assert 'cusp' in errors
    assert robot.pose == (0.0, 0.0, 0.0)


def test_without_a_node_it_says_what_to_start(alone):
    status, _, errors = alone('drive', 'to', 1, 0, 0, '--namespace', 'nowhere')
    assert status == 1
    assert 'no node /nowhere/ghost_trajectory' in errors
