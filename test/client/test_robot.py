"""A script and a robot: a differential drive with its simulator, all nodes live."""

from __future__ import annotations

import runpy
from contextlib import contextmanager
from math import dist
from pathlib import Path

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger

from agv_motion.client import Robot
from agv_motion.client.link import ScriptLink
from agv_motion.client.task import Outcome
from agv_motion.errors import AgvMotionError, SignalError, SourceError
from agv_motion.ros.messages import pose_of
from agv_motion.ros.qos import COMMAND, SENSOR

LIMIT = 60.0


@pytest.fixture(scope='module')
def nodes(swift, wait_until):
    with swift() as found:
        drivers = [found[name].plain for name in ('ghost_trajectory', 'route_follower', 'sequence')]
        wait_until(lambda: not any(driver.lost for driver in drivers))
        yield found


@pytest.fixture(scope='module')
def ears(nodes):
    """Return what the arbiter is told and tells, and where the robot really is, newest last."""
    link, heard = ScriptLink(''), {'page': [], 'cmd_vel': [], 'truth': []}
    for topic, kind, qos, inbox in (
        ('cmd_vel/page', TwistStamped, COMMAND, 'page'),
        ('cmd_vel', TwistStamped, COMMAND, 'cmd_vel'),
        ('ground_truth', Odometry, SENSOR, 'truth'),
    ):
        link.hear(kind, topic, qos, lambda one, inbox=inbox: heard[inbox].append(one.message))
    link.know(Trigger, ['sequence/abort'])
    link.start(lambda _: None)
    heard['link'] = link
    assert link.wait(lambda: heard['truth'], LIMIT)
    yield heard
    link.close()


@pytest.fixture(scope='module')
def shared(nodes, ears):
    with Robot(patience=LIMIT, silent_after=LIMIT) as found:
        yield found


@pytest.fixture
def robot(shared):
    yield shared
    shared.release()
    shared.cancel()


@contextmanager
def patience(robot, answer):
    """Let a robot wait so long for each answer [s]."""
    dispatch = vars(vars(robot)['_dispatch'])
    usual = dispatch['_patience']
    dispatch['_patience'] = usual._replace(answer=answer)
    try:
        yield
    finally:
        dispatch['_patience'] = usual


def place(ears):
    point = ears['truth'][-1].pose.pose.position
    return point.x, point.y


def moves(ears):
    return any(any(twist(one)) for one in ears['cmd_vel'])


def twist(message):
    return message.twist.linear.x, message.twist.linear.y, message.twist.angular.z


def test_it_goes_there_turning_first_where_no_heading_is_given(robot, ears):
    """Whole numbers are numbers: a message of rclpy takes 1 for 1.0 without a word, and sends 0."""
    robot.go_to(1, 1)
    assert not robot.is_done()
    told = []

    def done():
        told.append(robot.feedback())
        return robot.is_done()

    assert ears['link'].wait(done, LIMIT)
    assert robot.result() == (Outcome.SUCCEEDED, 'arrived')
    assert dist(place(ears), (1.0, 1.0)) < 0.06
    left = [one.distance_left for one in told]
    assert left[0] > 0.4
    assert left[-1] < 0.06
    assert {'turning', 'driving'} & {one.state for one in told}


def test_the_example_drives_there_and_tells_it(robot, ears, capfd):
    (script,) = (Path(__file__).parents[2] / 'launch_scripts' / 'examples').glob('16_*.py')
    runpy.run_path(str(script), run_name='__main__')
    lines = capfd.readouterr().out.splitlines()
    assert any('m left' in line for line in lines)
    assert lines[-2:] == ['there: arrived', 'turned: arrived']
    assert dist(place(ears), (1.0, 0.5)) < 0.06


@pytest.mark.parametrize(
    ('order', 'arguments', 'there'),
    [
        ('go_to', (2, 1.0, 1), (2.0, 1.0)),
        ('drive_arc', (0.8, 0.4, 0.4), None),
        ('spin', (-2, 2, 4), None),
        ('follow_route', ([(2.0, 1.0), (2.4, 1.0), (3, 1)],), (3.0, 1.0)),
    ],
)
def test_each_order_is_taken_and_done(robot, ears, order, arguments, there):
    getattr(robot, order)(*arguments)
    assert robot.wait(LIMIT) == (Outcome.SUCCEEDED, 'arrived')
    if there:
        assert dist(place(ears), there) < 0.06
    if order == 'go_to':
        assert pose_of(ears['truth'][-1].pose.pose).theta == pytest.approx(1.0, abs=0.1)


def test_a_sequence_is_performed(robot, tmp_path):
    file = tmp_path / 'two.yaml'
    file.write_text('actions:\n  - rotate: {by: 20}\n  - wait: 0.1\n')
    robot.perform(str(file))
    assert robot.wait(LIMIT) == (Outcome.SUCCEEDED, 'done')


@pytest.mark.parametrize(
    ('order', 'arguments', 'words'),
    [
        ('go_to', (float('nan'), 0.0), 'must be finite'),
        ('go_to', (0.0, 0.0, float('inf')), 'must be finite'),
        ('go_to', (1e9, 0.0), 'metres?'),
        ('spin', (1.0, 0.0), 'rate of a turn = 0.0 rad/s'),
        ('drive_arc', (1.0, -1.0), 'diameter'),
        ('follow_route', ([(0.0, 0.0)],), '2'),
        ('follow_route', ([(0.0, 0.0), (1.0, 0.0)], 0), 'laps = 0'),
        ('go_to', ('a', 0.0), 'give numbers'),
        ('go_to', (None, 0.0), 'give numbers'),
        ('follow_path', ([(1.0, 2.0)],), 'give numbers'),
        ('follow_route', ([(0.0, 0.0), (1.0, 0.0)], 2.5), 'a whole number'),
        ('follow_route', ([(0.0, 0.0), (1.0, 0.0)] * 15_000,), 'at most 20000'),
        ('follow_route', ([(0.1 * i, 0.0) for i in range(50)], 999), '20000 at most'),
        ('perform', ('nowhere.yaml',), "no file 'nowhere.yaml'"),
    ],
)
def test_what_it_cannot_do_is_told_and_changes_nothing(robot, order, arguments, words):
    before = robot.result()
    options = {'laps': arguments[1]} if order == 'follow_route' and len(arguments) > 1 else {}
    with pytest.raises(AgvMotionError, match=words.replace('?', r'\?')):
        getattr(robot, order)(*(arguments[:1] if options else arguments), **options)
    assert robot.result() == before


def test_an_order_that_was_not_answered_in_time_is_not_carried_out_later(robot, nodes, ears):
    robot.go_to(50.0, 0.0, 0.0)
    assert robot.cancel(LIMIT).outcome is Outcome.CANCELLED
    ghost = nodes['ghost_trajectory'].plain
    follower = vars(ghost)['_follower']
    before = follower.ghost
    with patience(robot, 0.0), pytest.raises(AgvMotionError, match='is told to leave the order'):
        robot.go_to(50.0, 0.0, 0.0)
    # it has set out, and has been told to end that
    assert ears['link'].wait(
        lambda: follower.ghost is not before and ghost.told == 'aborted', LIMIT
    )
    assert robot.pose().x < 20.0


def test_a_wait_ends_though_the_robot_does_not(robot):
    robot.go_to(50.0, 0.0)
    assert robot.wait(0.05).outcome is Outcome.RUNNING
    with pytest.raises(SignalError, match=r'wait \(seconds\) must be finite'):
        robot.wait(float('inf'))
    assert robot.feedback().distance_left > 10.0


def test_cancelled_it_stands_by_an_explicit_zero_and_leaves_the_wheels_to_others(robot, ears):
    robot.go_to(50.0, 0.0, 0.0)
    ears['page'].clear()
    assert ears['link'].wait(lambda: any(any(twist(one)) for one in ears['page']), LIMIT)
    assert robot.cancel(LIMIT).outcome is Outcome.CANCELLED
    assert ears['link'].wait(lambda: not any(twist(ears['page'][-1])), LIMIT)
    assert robot.cancel().outcome is Outcome.CANCELLED  # again: nothing happens


def test_a_new_order_takes_the_place_of_the_last(robot):
    robot.go_to(50.0, 0.0)
    robot.spin(0.3)
    assert robot.wait(LIMIT).succeeded


def test_an_order_of_somebody_else_is_told(robot, nodes):
    robot.go_to(50.0, 0.0)
    with Robot(patience=LIMIT) as other:
        other.spin(0.2)
        assert robot.wait(LIMIT) == (Outcome.CANCELLED, 'another order took its place')
        assert other.wait(LIMIT).succeeded


def test_stopped_it_stands_and_nothing_sets_off_when_it_is_released(robot, ears):
    robot.go_to(50.0, 0.0)
    robot.stop()
    result = robot.result()
    assert result.outcome is Outcome.FAILED
    assert 'STOP' in result.reason
    assert ears['link'].wait(lambda: not any(twist(ears['cmd_vel'][-1])), LIMIT)
    with pytest.raises(AgvMotionError, match=r'STOP holds: .*call release'):
        robot.go_to(0.0, 0.0)
    assert robot.feedback().why
    assert ears['link'].wait(lambda: robot.feedback().state == 'aborted', LIMIT)
    robot.release()
    ears['cmd_vel'].clear()
    assert not ears['link'].wait(lambda: moves(ears), 0.5)


def test_a_node_that_is_deactivated_has_lost_its_order(robot, nodes):
    ghost = nodes['ghost_trajectory']
    robot.go_to(50.0, 0.0)
    ghost.trigger_deactivate()
    try:
        assert robot.wait(LIMIT) == (Outcome.FAILED, 'not active')
    finally:
        ghost.trigger_activate()


def test_leaving_takes_the_order_back(nodes, ears):
    with Robot(patience=LIMIT) as mine:
        mine.go_to(50.0, 0.0)
    assert mine.result().outcome is Outcome.CANCELLED
    mine.close()  # again: nothing
    with pytest.raises(SourceError, match='closed'):
        mine.go_to(0.0, 0.0)
    with pytest.raises(SourceError, match='closed'):
        mine.stop()


def test_a_robot_that_is_not_there_is_told(nodes):
    with pytest.raises(SourceError, match=r"no robot in the namespace '/nowhere' within 0\.5 s"):
        Robot('/nowhere', patience=0.5)


def test_a_robot_that_is_no_tree_has_nothing_to_resume(robot):
    with patience(robot, 0.2), pytest.raises(SourceError, match='start motion_generator'):
        robot.resume()
