"""What each of Nav2's goals orders, refuses and tells; its messages are stood in for."""

from __future__ import annotations

from math import nan, pi
from types import SimpleNamespace as Some

import pytest

pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path

from agv_motion.client.goal_runner import ControllerError, GoalError, GoalProgress
from agv_motion.client.nav2_goals import ACTIONS, allowance_of, fill_duration
from agv_motion.errors import AgvMotionError, ConfigurationError
from agv_motion.planar import Pose
from agv_motion.ros.messages import fill_path, fill_pose

BY_NAME = {action.name: action for action in ACTIONS}
DRIVE = 'drive_on_heading'
PROGRESS = GoalProgress(2.5, Pose(1.0, 2.0, 0.5), 3.0, 0.5, 1.25, -0.75)


class Robot:
    """Writes down what it is ordered to do."""

    def __init__(self, *, headings=True):
        self.orders, self.headings = [], headings

    def takes_headings(self):
        return self.headings

    def __getattr__(self, name):
        """Return an order of that name."""
        return lambda *given, **named: self.orders.append((name, given, named))


def stamped(x, y, theta, frame='map'):
    message = PoseStamped()
    message.header.frame_id = frame
    fill_pose(message.pose, Pose(x, y, theta))
    return message


def path(*poses, frame='map'):
    message = Path()
    message.header.frame_id = frame
    fill_path(message, poses)
    return message


def point(x, y=0.0, z=0.0):
    return Some(x=x, y=y, z=z)


def ordered(name, **request):
    robot = Robot()
    BY_NAME[name].order(robot, Some(**request))
    return robot.orders


def test_each_goal_is_an_order():
    ((name, given, named),) = ordered('navigate_to_pose', pose=stamped(1.0, 2.0, 0.5))
    assert (name, named) == ('go_to', {'frame': 'map'})
    assert given == pytest.approx((1.0, 2.0, 0.5))
    assert ordered('spin', target_yaw=-2 * pi) == [('spin', (-2 * pi,), {})]
    assert ordered('drive_on_heading', target=point(-1.5), speed=-0.2) == [
        ('drive_straight', (-1.5, 0.2), {})
    ]
    way = path(Pose(0.0, 0.0, 0.0), Pose(1.0, 0.5, 0.25))
    for controller in ('', 'route_follower'):
        assert ordered('follow_path', path=way, controller_id=controller) == [
            ('follow_route', ([(0.0, 0.0), (1.0, 0.5)],), {'frame': 'map'})
        ]
    ((name, (poses,), named),) = ordered('follow_path', path=way, controller_id='ghost_trajectory')
    assert (name, named) == ('follow_path', {'frame': 'map'})
    assert poses[1] == pytest.approx((1.0, 0.5, 0.25))


def test_a_tree_is_told_no_heading():
    robot = Robot(headings=False)
    BY_NAME['navigate_to_pose'].order(robot, Some(pose=stamped(1.0, 2.0, 0.5)))
    assert robot.orders[0][1] == (1.0, 2.0, None)


@pytest.mark.parametrize(
    ('name', 'request_', 'error', 'words'),
    [
        ('follow_path', {'path': path(), 'controller_id': 'FollowPath'}, ControllerError,
         "'FollowPath': there are route_follower, ghost_trajectory"),
        ('follow_path', {'path': path(), 'controller_id': ''}, ConfigurationError, 'no poses'),
        (DRIVE, {'target': point(1.0), 'speed': -0.2}, ConfigurationError, 'same sign'),
        (DRIVE, {'target': point(-1.0), 'speed': 0.2}, ConfigurationError, 'same sign'),
        (DRIVE, {'target': point(1.0), 'speed': 0.0}, ConfigurationError, 'same sign'),
        (DRIVE, {'target': point(1.0, 0.1), 'speed': 0.2}, ConfigurationError, 'give x only'),
        (DRIVE, {'target': point(nan), 'speed': 0.2}, AgvMotionError, 'finite'),
        (DRIVE, {'target': point(1.0), 'speed': nan}, AgvMotionError, 'finite'),
        ('navigate_to_pose', {'pose': stamped(nan, 0.0, 0.0)}, AgvMotionError, 'finite'),
    ],
)  # fmt: skip
def test_what_is_no_goal_is_refused(name, request_, error, words):
    with pytest.raises(error, match=words):
        ordered(name, **request_)


def test_a_path_of_two_frames_is_refused():
    way = path(Pose(0.0, 0.0, 0.0))
    way.poses.append(stamped(1.0, 0.0, 0.0, 'odom'))
    with pytest.raises(ConfigurationError, match="a pose in 'odom' on a path in 'map'"):
        ordered('follow_path', path=way, controller_id='')


def duration():
    return Some(sec=0, nanosec=0)


def test_feedback_tells_how_it_goes():
    told = Some(
        current_pose=PoseStamped(), navigation_time=duration(), distance_remaining=0.0,
        estimated_time_remaining=duration(), distance_to_goal=0.0, speed=0.0,
        angular_distance_traveled=0.0, distance_traveled=0.0,
    )  # fmt: skip
    for action in ACTIONS:
        action.fill(told, PROGRESS, 'map')
    assert told.current_pose.header.frame_id == 'map'
    assert told.current_pose.pose.position.y == 2.0
    assert (told.navigation_time.sec, told.navigation_time.nanosec) == (2, 500_000_000)
    assert told.estimated_time_remaining.sec == 6
    assert (told.distance_remaining, told.distance_to_goal, told.speed) == (3.0, 3.0, 0.5)
    assert (told.angular_distance_traveled, told.distance_traveled) == (-0.75, 1.25)


def test_what_nobody_knows_is_no_nan():
    told = Some(navigation_time=duration(), distance_remaining=1.0, distance_to_goal=1.0, speed=0.0)
    unknown = PROGRESS._replace(pose=None, distance_left=nan)
    BY_NAME['navigate_to_pose'].fill(told, unknown, '')
    BY_NAME['follow_path'].fill(told, unknown, '')
    assert (told.distance_remaining, told.distance_to_goal) == (0.0, 0.0)


def test_the_numbers_are_those_of_jazzy():
    """As nav2_msgs of its branch jazzy has them; where it is installed, equal to its constants."""
    codes = {action.name: {e.name: action.codes[e] for e in GoalError} for action in ACTIONS}
    assert codes['navigate_to_pose'] == codes['follow_path'] == {
        'NONE': 0, 'UNKNOWN': 100, 'CONTROLLER': 101, 'FRAME': 102, 'REFUSED': 103,
        'NO_PROGRESS': 105, 'TIMEOUT': 107,
    }  # fmt: skip
    assert [codes['spin'][name] for name in ('NONE', 'UNKNOWN', 'TIMEOUT', 'FRAME')] == [
        0, 700, 701, 702,
    ]  # fmt: skip
    drive = codes['drive_on_heading']
    assert [drive[name] for name in ('NONE', 'UNKNOWN', 'TIMEOUT', 'FRAME', 'REFUSED')] == [
        0, 720, 721, 722, 724,
    ]  # fmt: skip
    found = pytest.importorskip('nav2_msgs.action')
    assert codes['follow_path']['REFUSED'] == found.FollowPath.Result.INVALID_PATH
    assert codes['follow_path']['NO_PROGRESS'] == found.FollowPath.Result.FAILED_TO_MAKE_PROGRESS
    assert codes['spin']['TIMEOUT'] == found.Spin.Result.TIMEOUT
    assert drive['REFUSED'] == found.DriveOnHeading.Result.INVALID_INPUT


def test_time_that_a_goal_may_take():
    assert allowance_of(Some()) == 0.0
    assert allowance_of(Some(time_allowance=Some(sec=2, nanosec=500_000_000))) == 2.5
    assert allowance_of(Some(time_allowance=Some(sec=-1, nanosec=0))) == 0.0
    told = duration()
    fill_duration(told, 3.25)
    assert (told.sec, told.nanosec) == (3, 250_000_000)
