"""Node `ghost_trajectory` over a real graph: goals of every kind, and every way to stop."""

from __future__ import annotations

from math import cos, hypot, nan, pi, sin

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped, Vector3Stamped
from nav_msgs.msg import Path
from rclpy.parameter import Parameter
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

from agv_motion.nodes.ghost_trajectory import GhostTrajectory
from agv_motion.planar import Pose
from agv_motion.ros.messages import pose_of
from agv_motion.ros.qos import COMMAND, LATCHED
from agv_motion.trajectory.arc import Arc

SWIFT = {
    'rate': 25.0, 'cruising_speed': 1.0, 'speed_ramps': 2.0, 'follow__ghost__wheel_speed': 5.0,
    'follow__ghost__lateral_acceleration': 5.0, 'follow__ghost__turn_rate': 9.0,
    'follow__delay': 0.0,
}  # fmt: skip
FAR = (30.0, 0.0, 0.0)


def stamped(x, y, theta, frame='odom'):
    message = PoseStamped()
    message.header.frame_id = frame
    message.pose.position.x, message.pose.position.y = float(x), float(y)
    message.pose.orientation.z, message.pose.orientation.w = sin(theta / 2), cos(theta / 2)
    return message


class Course:
    """A robot, the node that drives it, and its goals."""

    def __init__(self, tester, **parameters):
        self.tester = tester
        self.states = tester.listen(String, 'ghost/state', LATCHED)
        self.paths = tester.listen(Path, 'ghost/path', LATCHED)
        self.robot = tester.driven_robot(step=0.04)
        self.node = tester.start(GhostTrajectory, **(SWIFT | parameters))
        self.goal = tester.publisher(PoseStamped, 'goal_pose')

    def says(self, words, timeout=60.0):
        return self.tester.wait(self.states, lambda m: words in m.data, timeout)

    def ask(self, service, data=None):
        kind = Trigger if data is None else SetBool
        request = kind.Request() if data is None else kind.Request(data=data)
        return self.tester.ask(kind, f'ghost_trajectory/{service}', request)

    def is_at(self, x, y, theta):
        pose = self.robot.pose
        assert hypot(pose.x - x, pose.y - y) < 0.03
        assert abs(pose.theta - theta) < 0.05


@pytest.fixture
def course(tester):
    found = Course(tester)
    found.robot.find()
    return found


def test_a_goal_is_reached_and_path_report_and_ghost_are_told(course):
    ghosts = course.tester.listen(PoseStamped, 'ghost/pose')
    reports = course.tester.listen(String, 'ghost/report', LATCHED)
    course.goal.publish(stamped(0.8, 0.3, 0.5))
    course.says('driving')
    course.says('arrived')
    course.is_at(0.8, 0.3, 0.5)
    course.robot.stands()
    assert 'm in' in course.tester.wait(reports).data
    assert pose_of(course.paths[-1].poses[-1].pose) == pytest.approx((0.8, 0.3, 0.5))
    course.tester.wait(ghosts, lambda m: m.pose.position.x == pytest.approx(0.8, abs=1e-9))
    assert ghosts[-1].header.frame_id == 'odom'


def test_a_path_is_driven_through(course):
    publisher = course.tester.publisher(Path, 'path')
    message = Path()
    message.header.frame_id = 'odom'
    message.poses = [stamped(0.5, 0.2, 0.5), stamped(1.0, 0.2, -0.5)]
    publisher.publish(message)
    course.says('arrived')
    course.is_at(1.0, 0.2, -0.5)


def test_a_path_of_places_alone_is_followed(course):
    """A grid planner leaves every orientation at the identity: the robot looks along its path."""
    places = [(0.1 * k, 0.0) for k in range(6)] + [(0.5, 0.1 * k) for k in range(1, 6)]
    message = Path()
    message.header.frame_id = 'odom'
    message.poses = [stamped(x, y, 0.0) for x, y in places]
    course.tester.publisher(Path, 'path').publish(message)
    course.says('arrived')
    course.is_at(0.5, 0.5, pi / 2)
    for pose in map(pose_of, (stamped.pose for stamped in course.paths[-1].poses)):
        assert min(abs(pose.y), abs(pose.x - 0.5)) < 0.02


@pytest.mark.parametrize(
    ('topic', 'message', 'word'),
    [
        ('arc', (125.0, 10.0, 0.02), 'at most 7200 s'),
        ('arc', (0.01, 9e15, 5e-324), 'must lie in'),
        ('goal_pose', stamped(1e4, 0.0, 0.0), 'a way of 10000 m: at most 1000 m'),
        ('goal_pose', stamped(1e308, -1e308, 0.0), 'must be within 1e+07 m of the origin'),
        ('path', 1001, '1001 poses: at most 1000'),
    ],
)
def test_what_would_take_too_long_is_refused_at_once_and_the_next_goal_is_driven(
    course, topic, message, word
):
    if topic == 'path':
        kind, message = Path, Path(poses=[PoseStamped()] * message)
    elif topic == 'arc':
        kind, vector = Vector3Stamped, message
        message = Vector3Stamped()
        message.vector.x, message.vector.y, message.vector.z = vector
    else:
        kind = PoseStamped
    course.tester.publisher(kind, topic).publish(message)
    course.tester.graph.spin_until(lambda: word in course.node.complaint)
    assert not any(map(any, course.robot.commands))
    course.tester.graph.repeat(  # the robot's pose may be old by now, which refuses a goal too
        lambda: course.goal.publish(stamped(0.2, 0.0, 0.0)),
        lambda: any('driving' in state.data for state in course.states),
        every=0.5,
    )


def test_an_arc_of_half_an_hour_is_planned_and_drawn_in_few_poses(course):
    message = Vector3Stamped()
    message.vector.x, message.vector.y, message.vector.z = 4.0, 10.0, 0.02
    course.tester.publisher(Vector3Stamped, 'arc').publish(message)
    course.says('driving')
    drawn = course.tester.wait(course.paths, lambda m: len(m.poses) > 10)
    assert len(drawn.poses) <= 502


def test_a_turn_on_the_spot_goes_the_long_way_round_if_asked(course):
    """More than half a turn to the left; what is no turn is refused and changes nothing."""
    message = Vector3Stamped()
    message.vector.x, message.vector.y, message.vector.z = 4.0, 8.0, 4.0
    publisher = course.tester.publisher(Vector3Stamped, 'turn')
    publisher.publish(message)
    course.says('arrived')
    course.is_at(0.0, 0.0, 4.0 - 2.0 * pi)
    assert all(twist.wz >= -0.05 for twist in course.robot.commands)
    message.vector.x = nan
    publisher.publish(message)
    course.tester.graph.spin_until(lambda: 'finite' in course.node.complaint)


def test_one_place_told_twice_is_straight_there_turning_first(course):
    path = Path(poses=[stamped(-1.0, 0.0, 0.0)] * 2)
    course.tester.publisher(Path, 'path').publish(path)
    course.says('arrived')
    assert hypot(course.robot.pose.x + 1.0, course.robot.pose.y) < 0.03
    assert abs(abs(course.robot.pose.theta) - pi) < 0.06


def test_where_it_stands_already_it_turns_to_no_heading_but_one_that_is_asked(course):
    """Two centimetres aside, as a robot stands that has arrived, have no direction of their own."""
    path = Path(poses=[stamped(-0.02, 0.01, 0.0)] * 2)
    course.tester.publisher(Path, 'path').publish(path)
    course.says('arrived')
    assert tuple(course.robot.pose) == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)
    course.goal.publish(stamped(0.01, -0.02, 1.0))
    course.tester.graph.spin_until(lambda: abs(course.robot.pose.theta - 1.0) < 0.05)
    course.is_at(0.0, 0.0, 1.0)
    assert all(abs(twist.vx) < 0.01 for twist in course.robot.commands)
    far = Path(poses=[stamped(-0.5, 0.0, 0.0)] * 2)
    course.tester.publisher(Path, 'path').publish(far)
    course.tester.graph.spin_until(lambda: abs(course.robot.pose.x + 0.5) < 0.03)


def test_an_arc_ends_where_it_was_predicted(course):
    """A quarter turn to the right round an inner circle of 0.6 m."""
    publisher = course.tester.publisher(Vector3Stamped, 'arc')
    message = Vector3Stamped()
    message.vector.x, message.vector.y, message.vector.z = -pi / 2, 0.6, 1.0
    publisher.publish(message)
    course.says('arrived')
    track = course.node.parameters.follow.ghost.track
    course.is_at(*Arc(-pi / 2, 0.6, track, 1.0, 1.0).end(Pose(0.0, 0.0, 0.0)))


def test_backwards_by_a_parameter_that_may_change(course):
    (taken,) = course.node.set_parameters([Parameter('backward', value=True)])
    assert taken.successful
    course.goal.publish(stamped(-0.6, 0.0, 0.0))
    course.says('backing')
    course.says('arrived')
    course.is_at(-0.6, 0.0, 0.0)


def test_locked_it_waits_for_the_word(tester):
    course = Course(tester, lock_goals=True)
    course.robot.find()
    course.goal.publish(stamped(0.5, 0.0, 0.0))
    course.says('locked')
    course.tester.graph.spin_for(0.3)
    assert course.robot.pose == (0.0, 0.0, 0.0)
    assert course.ask('lock', data=False).success
    course.says('arrived')


def test_lock_brings_it_to_a_halt_and_abort_ends_it(course):
    course.goal.publish(stamped(*FAR))
    course.robot.moves()
    assert course.ask('lock', data=True).success
    course.says('locked')
    course.robot.stands()
    assert course.ask('abort').success
    course.says('aborted')
    assert 'nothing to abort' in course.ask('abort').message


def test_abort_brakes_and_cmd_vel_is_free_afterwards(course):
    course.goal.publish(stamped(*FAR))
    course.tester.wait(course.robot.commands, lambda twist: twist.vx > 0.6)
    course.robot.commands.clear()
    assert course.ask('abort').success
    course.says('aborted')
    speeds = [twist.vx for twist in course.robot.commands if any(twist)]
    assert any(0.1 < speed < 0.4 for speed in speeds)  # a ramp, no jump
    course.robot.stands()
    course.tester.graph.quiet(course.robot.commands)


def test_silence_of_the_pose_is_an_explicit_stop(tester):
    course = Course(tester, report_after=0.1, stop_after=0.3)
    course.robot.find()
    course.goal.publish(stamped(*FAR))
    course.robot.moves()
    course.robot.silent = True
    course.says('stopped: no odom for 0.3 s')
    course.robot.stands()
    ghosts = []
    for _ in range(20):  # what the robot had said may be heard only now, and let it go on
        ghosts.append(course.node.plain._follower.ghost.pose)  # noqa: SLF001 - no run to the goal
        if ghosts[-1:] == ghosts[-2:-1]:
            break
        course.tester.graph.spin_for(0.3)
    assert ghosts[-1] == ghosts[-2]
    course.robot.silent = False
    course.robot.report()
    course.robot.moves()


def test_a_robot_carried_away_is_lost_and_stops(course):
    course.goal.publish(stamped(*FAR))
    course.robot.moves()
    course.robot.pose = course.robot.pose._replace(y=2.0)
    course.says('lost: ')
    course.robot.stands()
    assert course.node.plain.diagnose().level == b'\x02'


def test_the_last_word_is_zero_and_the_goal_is_forgotten(course):
    course.goal.publish(stamped(*FAR))
    course.robot.moves()
    course.node.trigger_deactivate()
    course.tester.graph.spin_until(lambda: not any(course.robot.commands[-1]))
    course.node.trigger_activate()
    course.tester.graph.spin_for(0.3)
    assert not any(course.robot.commands[-1])


@pytest.mark.parametrize(
    ('message', 'word'),
    [
        (stamped(nan, 0, 0), 'must be finite'),
        (stamped(1, 0, 0, frame='map'), "frame 'map': this node drives in 'odom'"),
        (PoseStamped(pose=stamped(1, 0, 0).pose), ''),
    ],
)
def test_what_cannot_be_a_goal_is_refused(course, message, word):
    course.goal.publish(message)
    if not word:
        course.says('driving')
        return
    course.tester.graph.spin_until(lambda: word in course.node.complaint)
    assert not any(map(any, course.robot.commands))


def test_no_goal_before_the_pose_is_known(tester):
    course = Course(tester)
    course.goal.publish(stamped(*FAR))
    tester.graph.spin_until(lambda: 'no odom yet' in course.node.complaint)


def test_impossible_arcs_and_empty_paths_are_refused(course):
    arc = course.tester.publisher(Vector3Stamped, 'arc', COMMAND)
    arc.publish(Vector3Stamped())
    course.tester.graph.spin_until(lambda: 'speed' in course.node.complaint)
    course.tester.publisher(Path, 'path').publish(Path())
    course.tester.graph.spin_until(lambda: 'no goal given' in course.node.complaint)


def test_gains_may_change_on_the_way_but_not_to_anything(course):
    change = course.node.set_parameters
    (taken,) = change([Parameter('follow.kanayama.along', value=2.0)])
    (refused,) = change([Parameter('follow.pace.wait_beyond', value=0.05)])
    assert taken.successful
    assert 'in this order, rising' in refused.reason
    assert course.node.plain._follower.parameters.kanayama.along == 2.0  # noqa: SLF001
