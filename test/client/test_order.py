"""What ends an order though its node says nothing: STOP, silence, standing; and trees."""

from __future__ import annotations

from types import SimpleNamespace as Some

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path
from std_msgs.msg import String

from agv_motion.client.drivers import GHOST, TREE
from agv_motion.client.link import Heard
from agv_motion.client.order import Order, Patience, TreeGoal, TreeOrder
from agv_motion.client.task import Outcome
from agv_motion.planar import Pose
from agv_motion.ros.messages import fill_path, fill_pose

PATIENCE = Patience(answer=1.0, silence=10.0, standing=60.0)


class View(Some):
    """A robot at a pose; `now` is when all of it was heard last."""

    def silence(self, node, now):
        return now - self.heard

    def odometry_silence(self, now):
        return now - self.wheels

    def pose_in(self, frame):
        return self.odometry

    def why(self, now):
        return 'a crate is in the way'

    def state(self, driver):
        return 'driving'

    def clock_of(self, node):
        return self.clock


@pytest.fixture
def view():
    return View(stop='', clock=None, heard=0.0, wheels=0.0, odometry=Pose(0.0, 0.0, 0.0))


@pytest.fixture
def order(view):
    made = Order(GHOST, view, PATIENCE, 0.0)
    path = Path()
    fill_path(path, [Pose(0.0, 0.0, 0.0), Pose(4.0, 0.0, 0.0)])
    made.receive('ghost/path', Heard(path, 0.0))
    assert made.task.accepted
    return made


def alive(view, now):
    view.heard = view.wheels = now


def test_it_goes_on_as_long_as_the_robot_moves_and_speaks(order, view):
    for second in range(200):
        alive(view, float(second))
        view.odometry = Pose(0.02 * second, 0.0, 0.0)
        order.receive('odom', Heard(None, float(second)))
        order.look(second + 0.5)
    assert not order.task.ended
    assert order.distance_left() == pytest.approx(4.0 - 0.02 * 199)


def test_a_stop_ends_it_at_once_and_says_what_to_do(order, view):
    view.stop = 'asked for on cmd_vel/stop'
    order.look(0.1)
    outcome, reason = order.task.result
    assert outcome is Outcome.FAILED
    assert reason.startswith('STOP: asked for')
    assert 'release()' in reason


@pytest.mark.parametrize(
    ('heard', 'wheels', 'words'),
    [(1.0, 12.0, 'ghost_trajectory is silent'), (12.0, 1.0, 'no odom')],
)
def test_silence_of_node_or_wheels_ends_it(order, view, heard, wheels, words):
    view.heard, view.wheels = heard, wheels
    order.look(10.9)
    assert not order.task.ended
    order.look(11.1)
    assert order.task.result.outcome is Outcome.FAILED
    assert words in order.task.result.reason


def test_standing_ends_it_with_the_reason(order, view):
    for now in (59.0, 61.0):
        alive(view, now)
        order.look(now)
        assert order.task.ended is (now > 60.0)
    assert order.task.result.reason == 'stands for 60 s: a crate is in the way'


def test_one_that_was_not_taken_waits_for_the_answer_alone(view):
    order = Order(GHOST, view, PATIENCE, 0.0)
    view.stop = 'held'
    order.look(1000.0)
    assert not order.task.ended


def goal(x, y):
    message = PoseStamped()
    fill_pose(message.pose, Pose(x, y, 0.0))
    return Heard(message, 0.0)


@pytest.fixture
def tree(view):
    made = TreeOrder(TreeGoal((5.0, 0.0), 1.0), view, PATIENCE, 0.0)
    made.receive('goal', goal(9.0, 9.0))  # that of before
    assert not made.task.accepted
    made.receive('goal', goal(5.0, 0.0))
    assert made.task.accepted
    return made


def test_a_tree_has_arrived_where_it_is_near(tree, view):
    view.odometry = Pose(3.9, 0.0, 0.0)
    tree.receive('pose', Heard(None, 1.0))
    assert not tree.task.ended
    assert tree.distance_left() == pytest.approx(1.1)
    view.odometry = Pose(4.1, 0.0, 0.0)
    tree.receive('pose', Heard(None, 2.0))
    assert tree.task.result.outcome is Outcome.SUCCEEDED


@pytest.mark.parametrize(('x', 'outcome'), [(2.0, Outcome.CANCELLED), (4.5, Outcome.SUCCEEDED)])
def test_a_tree_that_takes_another_goal_has_arrived_or_left_this_one(tree, view, x, outcome):
    view.odometry = Pose(x, 0.0, 0.0)
    tree.receive('goal', goal(9.0, 9.0))
    assert tree.task.result.outcome is outcome


@pytest.mark.parametrize(('end', 'left'), [(9.0, 5.0), (5.0, 9.0)])
def test_the_path_of_another_goal_is_not_its_own(tree, end, left):
    """Two metres there and back more, on the way of its own; else straight there."""
    path = Path()
    fill_path(path, [Pose(x, 0.0, 0.0) for x in (0.0, 7.0, end)])
    tree.receive('path', Heard(path, 0.0))
    tree.receive('pose', Heard(None, 0.0))
    assert tree.distance_left() == pytest.approx(left)


def test_the_same_goal_told_again_is_no_other(tree):
    tree.receive('goal', goal(5.0, 0.0))
    tree.receive(TREE.state, Heard(String(data='walking'), 0.0))
    assert not tree.task.ended


def test_a_path_told_before_the_order_is_that_of_another_though_it_comes_late(view):
    """It is latched: who joined a moment ago may hear it after the order is sent."""
    view.clock = 100.0  # when the node told how it is, which was before the order
    order, path = Order(GHOST, view, PATIENCE, 0.0), Path()
    fill_path(path, [Pose(0.0, 0.0, 0.0), Pose(4.0, 0.0, 0.0)])
    path.header.stamp.sec = 99
    order.receive('ghost/path', Heard(path, 0.1))
    assert not order.task.accepted
    path.header.stamp.sec = 100
    order.receive('ghost/path', Heard(path, 0.2))
    assert order.task.accepted
    assert order.task.result.outcome is Outcome.RUNNING
