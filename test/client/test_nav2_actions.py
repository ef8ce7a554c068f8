"""Nav2's actions by a client of rclpy, over a robot whose nodes are live; needs nav2_msgs.

PyPI has no wheel of nav2_msgs: without it only what its absence is told by is tested.
"""

from __future__ import annotations

import sys
from math import dist, nan, pi

import pytest

rclpy = pytest.importorskip('rclpy')

from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient

from agv_motion.client.link import ScriptLink
from agv_motion.errors import ConfigurationError
from agv_motion.nodes.nav2_actions import MOST_GOALS, Nav2Actions, kinds
from agv_motion.planar import Pose
from agv_motion.ros.messages import fill_path, fill_pose
from agv_motion.ros.run import start

LIMIT = 60.0


def test_without_its_messages_the_node_says_what_is_missing(monkeypatch):
    monkeypatch.setitem(sys.modules, 'nav2_msgs.action', None)
    with pytest.raises(ConfigurationError, match='apt install ros-jazzy-nav2-msgs') as error:
        kinds()
    assert 'agv_motion.client' in str(error.value)


class Client:
    """Of one action: sends goals, and keeps what it is told."""

    def __init__(self, link, kind, name):
        self.link, self.kind = link, kind
        self.client = ActionClient(link.node, kind, name)
        self.feedback = []

    def send(self, **fields):
        goal = self.kind.Goal()
        for name, value in fields.items():
            setattr(goal, name, value)
        assert self.link.wait(self.client.server_is_ready, LIMIT)
        self.feedback.clear()
        (found,) = self.ask(
            lambda: self.client.send_goal_async(
                goal, lambda one: self.feedback.append(one.feedback)
            )
        )
        return found

    def end(self, handle):
        (found,) = self.ask(handle.get_result_async)
        return found.status, found.result

    def ask(self, *questions):
        """Return the answers; asked in the thread that spins: any other may miss a quick answer."""
        task = self.link.node.executor.create_task(lambda: [ask() for ask in questions])
        assert self.link.wait(
            lambda: task.done() and all(one.done() for one in task.result()), LIMIT
        )
        return [one.result() for one in task.result()]

    def run(self, **fields):
        return self.end(self.send(**fields))


@pytest.fixture(scope='module')
def link():
    """Return a client's node; the usual executor, since the other knows no actions."""
    from rclpy.executors import SingleThreadedExecutor

    from agv_motion.client import link as module

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, '_executor', lambda context: SingleThreadedExecutor(context=context))
        found = ScriptLink('')
        found.start(lambda _: None)
    yield found
    found.close()


@pytest.fixture(scope='module')
def actions(spun, link, wait_until):
    """Return a client of each action of a differential robot, and its nodes."""
    found = pytest.importorskip('nav2_msgs.action')
    from agv_motion.ros.live_node import LiveNode
    from agv_motion.ros.run import overrides

    with spun('differential', 4.0) as nodes:
        node = LiveNode(
            Nav2Actions, context=nodes['arbiter'].context,
            parameter_overrides=overrides(patience=LIMIT, silent_after=LIMIT),
        )  # fmt: skip
        start(node)
        wait_until(lambda: not nodes['ghost_trajectory'].plain.lost)
        clients = {
            name: Client(link, getattr(found, kind), name)
            for name, kind in (
                ('navigate_to_pose', 'NavigateToPose'), ('follow_path', 'FollowPath'),
                ('spin', 'Spin'), ('drive_on_heading', 'DriveOnHeading'),
            )
        }  # fmt: skip
        yield clients, nodes, node
        node.trigger_shutdown()
        node.destroy_node()


def stamped(x, y, theta, frame='map'):
    from geometry_msgs.msg import PoseStamped

    message = PoseStamped()
    message.header.frame_id = frame
    fill_pose(message.pose, Pose(x, y, theta))
    return message


def place(nodes):
    return nodes['ghost_trajectory'].plain.require_pose()


def test_it_navigates_to_a_pose(actions):
    clients, nodes, _ = actions
    client = clients['navigate_to_pose']
    status, result = client.run(pose=stamped(0.6, 0.2, 0.5))
    assert (status, result.error_code) == (GoalStatus.STATUS_SUCCEEDED, 0)
    assert dist(place(nodes)[:2], (0.6, 0.2)) < 0.06
    assert place(nodes).theta == pytest.approx(0.5, abs=0.1)
    told = client.feedback
    assert told[0].current_pose.header.frame_id == 'map'
    assert max(one.distance_remaining for one in told) > 0.3
    assert told[-1].distance_remaining < 0.1
    assert told[-1].navigation_time.sec + told[-1].navigation_time.nanosec > 0


def test_it_follows_a_path_of_a_planner(actions):
    """Pose by pose, 5 cm from one to the next, as planners tell it."""
    from nav_msgs.msg import Path

    clients, nodes, _ = actions
    here = place(nodes)
    path = Path()
    path.header.frame_id = 'map'
    fill_path(path, [Pose(here.x - 0.05 * i, here.y, pi) for i in range(20)])
    status, result = clients['follow_path'].run(path=path)
    assert (status, result.error_code) == (GoalStatus.STATUS_SUCCEEDED, 0)
    assert dist(place(nodes)[:2], (here.x - 0.95, here.y)) < 0.1
    assert clients['follow_path'].feedback[-1].speed >= 0.0


def test_it_spins_and_drives_straight_both_ways(actions):
    clients, nodes, _ = actions
    client = clients['spin']
    status, result = client.run(target_yaw=-4.0)
    assert (status, result.error_code) == (GoalStatus.STATUS_SUCCEEDED, 0)
    assert client.feedback[-1].angular_distance_traveled == pytest.approx(-4.0, abs=0.5)
    assert result.total_elapsed_time.sec >= 0
    for way in (0.4, -0.4):
        before = place(nodes)
        client = clients['drive_on_heading']
        goal = client.kind.Goal().target
        goal.x = way
        status, result = client.run(target=goal, speed=0.5 * way)
        assert (status, result.error_code) == (GoalStatus.STATUS_SUCCEEDED, 0)
        assert dist(place(nodes)[:2], before[:2]) == pytest.approx(0.4, abs=0.1)


@pytest.mark.parametrize(
    ('name', 'fields', 'code', 'words'),
    [
        ('navigate_to_pose', {'pose': stamped(nan, 0.0, 0.0)}, 103, 'finite'),
        ('navigate_to_pose', {'pose': stamped(1e9, 0.0, 0.0)}, 103, 'm'),
        ('navigate_to_pose', {'pose': stamped(1.0, 0.0, 0.0, 'moon')}, 102, "'moon'"),
        ('follow_path', {}, 103, 'no poses'),
        ('follow_path', {'controller_id': 'MPPI'}, 101, 'route_follower, ghost_trajectory'),
        ('spin', {'target_yaw': nan}, 700, 'finite'),
        ('drive_on_heading', {'speed': -1.0}, 724, 'same sign'),
    ],
)
def test_what_is_no_goal_is_aborted_with_its_number(actions, name, fields, code, words):
    status, result = actions[0][name].run(**fields)
    assert (status, result.error_code) == (GoalStatus.STATUS_ABORTED, code)
    assert words in result.error_msg


def test_a_goal_that_takes_too_long_is_aborted_and_the_robot_stands(actions):
    from builtin_interfaces.msg import Duration

    clients, nodes, _ = actions
    status, result = clients['spin'].run(target_yaw=1000.0, time_allowance=Duration(sec=1))
    assert (status, result.error_code) == (GoalStatus.STATUS_ABORTED, 701)
    assert nodes['ghost_trajectory'].plain.told == 'aborted'


def test_cancelled_it_stands(actions):
    clients, nodes, _ = actions
    handle = clients['navigate_to_pose'].send(pose=stamped(50.0, 0.0, 0.0))
    assert clients['navigate_to_pose'].link.wait(
        lambda: bool(clients['navigate_to_pose'].feedback), LIMIT
    )
    handle.cancel_goal_async()
    status, result = clients['navigate_to_pose'].end(handle)
    assert (status, result.error_code) == (GoalStatus.STATUS_CANCELED, 0)
    assert nodes['ghost_trajectory'].plain.told == 'aborted'


def test_a_new_goal_of_another_action_takes_its_place(actions):
    clients, _, _ = actions
    first = clients['navigate_to_pose'].send(pose=stamped(50.0, 0.0, 0.0))
    status, result = clients['spin'].run(target_yaw=0.3)
    assert (status, result.error_code) == (GoalStatus.STATUS_SUCCEEDED, 0)
    status, result = clients['navigate_to_pose'].end(first)
    assert status == GoalStatus.STATUS_ABORTED
    assert result.error_msg == 'another goal took its place'


def test_of_a_flood_of_goals_the_newest_taken_is_carried_out(actions):
    clients, _, _ = actions
    client = clients['spin']
    goal = client.kind.Goal(target_yaw=1000.0)
    many = MOST_GOALS
    handles = client.ask(*[lambda: client.client.send_goal_async(goal)] * many)
    taken = [one for one in handles if one.accepted]
    assert taken
    handle = client.send(target_yaw=0.2)
    while not handle.accepted:  # four at once are enough
        handle = client.send(target_yaw=0.2)
    assert client.end(handle)[0] == GoalStatus.STATUS_SUCCEEDED
    assert {client.end(one)[0] for one in taken} == {GoalStatus.STATUS_ABORTED}


def test_deactivated_it_takes_the_goal_back(actions):
    clients, nodes, node = actions
    client = clients['navigate_to_pose']
    handle = client.send(pose=stamped(50.0, 0.0, 0.0))
    assert client.link.wait(lambda: bool(client.feedback), LIMIT)
    node.trigger_deactivate()
    assert nodes['ghost_trajectory'].plain.told == 'aborted'
    assert handle.accepted
