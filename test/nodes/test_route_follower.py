"""Node `route_follower` over a real graph: routes live and from files, and every way to stop."""

from __future__ import annotations

from math import hypot, nan

import pytest

rclpy = pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import PointStamped, PoseStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Path
from rclpy.parameter import Parameter
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

from agv_motion.nodes.route_follower import RouteFollowerNode
from agv_motion.ros.qos import LATCHED, SENSOR
from agv_motion.ros.run import StartError

FAST = {'rate': 100.0, 'follow__speed_coupling_ms': 0.0, 'follow__turn_coupling_ms': 0.0}


class Course:
    """A robot, the node that drives it, and its route."""

    def __init__(self, tester, robot, *, remap=(), **parameters):
        self.tester = tester
        self.states = tester.listen(String, 'route/state', LATCHED)
        self.robot = robot
        self.node = tester.start(RouteFollowerNode, remap=remap, **(FAST | parameters))
        self.route = tester.publisher(Path, 'route')

    def send(self, *points, frame='odom', of_each=''):
        message = Path()
        message.header.frame_id = frame
        for x, y in points:
            pose = PoseStamped()
            pose.header.frame_id = of_each
            pose.pose.position.x, pose.pose.position.y = float(x), float(y)
            message.poses.append(pose)
        self.route.publish(message)

    def says(self, words, timeout=60.0):
        return self.tester.wait(self.states, lambda m: words in m.data, timeout)

    def ask(self, service, data=None):
        kind = Trigger if data is None else SetBool
        request = kind.Request() if data is None else kind.Request(data=data)
        return self.tester.ask(kind, f'route_follower/{service}', request)


@pytest.fixture
def start(tester):
    return lambda **parameters: Course(tester, tester.driven_robot(), **parameters)


@pytest.fixture
def course(start):
    found = start()
    found.robot.find()
    return found


def test_a_live_route_is_followed_to_its_end_once(start):
    course = start(laps=3)  # of a route in a file
    course.robot.find()
    course.send((0, 0), (1, 0), (1, 0), (1, 1))
    course.says('following: segment 1 of 2')
    course.says('following: segment 2 of 2')
    course.says('arrived')
    assert hypot(course.robot.pose.x - 1.0, course.robot.pose.y - 1.0) < 0.05
    course.robot.stands()


def test_virtual_point_path_and_limiter_are_told(course):
    points = course.tester.listen(PointStamped, 'route/virtual_point', SENSOR)
    limits = course.tester.listen(DiagnosticStatus, 'route/limits', SENSOR)
    paths = course.tester.listen(Path, 'route/path', LATCHED)
    course.send((0, 0), (30, 0))
    point = course.tester.wait(points)
    assert point.header.frame_id == 'odom'
    assert point.point.x == pytest.approx(course.robot.pose.x + 0.4, abs=0.3)
    assert len(course.tester.wait(paths).poses) == 2
    told = course.tester.wait(limits)
    assert told.message in {'v(d)', 'v(dphi)', 'v(dn)', 'v(alpha)', 'coupling'}
    assert {'to_go', 'v_dphi', 'limiter'} <= {pair.key for pair in told.values}


def test_a_route_and_its_laps_from_a_file(start, tmp_path):
    path = tmp_path / 'square.yaml'
    path.write_text('waypoints: [[0, 0], [1.5, 0], [1.5, 1.5], [0, 1.5]]\nlaps: 2')
    course = start(route_file=str(path))
    course.says('stopped: no odom yet')
    course.robot.find()
    course.says('segment 3 of 4, lap 2 of 2')
    course.says('arrived')


def test_silence_of_odom_is_an_explicit_stop(start):
    course = start(report_after=0.1, stop_after=0.3)
    course.robot.find()
    course.send((0, 0), (30, 0))
    course.robot.moves()
    course.robot.silent = True
    course.says('stopped: no odom for 0.3 s')
    course.robot.stands()
    course.robot.silent = False
    course.robot.moves()


def test_pause_stops_and_goes_on(course):
    course.send((0, 0), (30, 0))
    course.robot.moves()
    assert course.ask('pause', data=True).success
    course.says('paused')
    course.robot.stands()
    assert course.ask('pause', data=False).success
    course.robot.moves()


def test_abort_stops_and_restart_begins_anew(course):
    assert 'no route' in course.ask('abort').message
    assert 'there has been no route' in course.ask('restart').message
    course.send((0, 0), (30, 0))
    course.robot.moves()
    assert course.ask('abort').success
    course.says('aborted')
    course.robot.stands()
    assert course.ask('restart').success
    course.robot.moves()


def test_after_the_end_cmd_vel_is_free_for_others(course):
    course.send((0, 0), (0.5, 0))
    course.says('arrived')
    course.tester.graph.quiet(course.robot.commands)


def test_the_last_word_is_zero(course):
    course.send((0, 0), (30, 0))
    course.robot.moves()
    course.robot.commands.clear()
    course.node.trigger_shutdown()
    course.tester.wait(course.robot.commands, lambda command: not any(command))
    assert not any(course.robot.commands[-1])


@pytest.mark.parametrize(
    ('points', 'frames', 'reason'),
    [
        ([], ('odom', ''), '0 waypoints'),
        ([(1, 1)], ('odom', ''), '1 waypoints'),
        ([(1, 1), (1, 1)], ('odom', ''), '1 of them distinct'),
        ([(0, 0), (nan, 1)], ('odom', ''), 'must be finite'),
        ([(0, 0), (1, 1)], ('map', ''), "this node drives in 'odom'"),
        ([(0, 0), (1, 1)], ('odom', 'map'), "this node drives in 'odom'"),
    ],
)
def test_a_bad_route_is_refused_and_the_old_one_goes_on(course, points, frames, reason):
    course.send((0, 0), (30, 0))
    course.robot.moves()
    frame, of_each = frames
    course.send(*points, frame=frame, of_each=of_each)
    course.tester.graph.spin_until(lambda: reason in course.node.complaint)
    course.robot.moves()


def test_odometry_in_another_frame_is_refused(course):
    course.robot.report(frame='map')
    course.tester.graph.spin_until(lambda: "frame 'map'" in course.node.complaint)


def test_the_pose_of_a_localisation_drives_it_as_well(start, tester):
    """With position = pose, and the topic remapped."""
    remap = ['pose:=localised']
    course = start(remap=remap, position='pose', frame='map')
    pose = tester.publisher(PoseWithCovarianceStamped, 'localised', SENSOR)
    course.send((0, 0), (5, 0), frame='map')
    message = PoseWithCovarianceStamped()
    message.header.frame_id = 'map'
    pose.publish(message)
    course.says('following')


def test_tables_may_change_at_run_time_and_bad_ones_are_refused(course):
    course.send((0, 0), (30, 0))
    course.robot.moves()
    bad, good = course.node.set_parameters(
        [
            Parameter('follow.v_dphi', value=[0.0, 0.3, 1.0, 0.0]),
            Parameter('follow.v_dphi', value=[0.0, 0.125]),
        ]
    )
    assert not bad.successful
    assert 'stalls short of the goal' in bad.reason
    assert good.successful
    course.robot.commands.clear()
    course.tester.wait(course.robot.commands, lambda command: command.vx == 0.125)


def test_another_file_at_run_time(course, tmp_path):
    path = tmp_path / 'r.csv'
    path.write_text('x,y\n0,0\n3,0\n')
    refused, taken = course.node.set_parameters(
        [Parameter('route_file', value='none.csv'), Parameter('route_file', value=str(path))]
    )
    assert "no file 'none.csv'" in refused.reason
    assert taken.successful
    course.says('arrived')


@pytest.mark.parametrize('name', ['secret.csv', 'secret.yaml', 'secret'])
def test_no_word_of_a_file_goes_over_the_network(course, tmp_path, capfd, name):
    path = tmp_path / name
    path.write_text('root:x:0:0:root:/root:/bin/sh\nsecret: *secret\n')
    (refused,) = course.node.set_parameters([Parameter('route_file', value=str(path))])
    assert f'{path}, line 1, column 1: ' in refused.reason or ': no YAML' in refused.reason
    told = refused.reason.removeprefix(str(path)) + capfd.readouterr().err.replace(str(path), '')
    assert 'root' not in told
    assert 'secret' not in told


def test_a_file_that_is_no_route_stops_the_start(tester, tmp_path, capfd):
    path = tmp_path / 'r.csv'
    path.write_text('x,y\n0,0\n')
    with pytest.raises(StartError):
        tester.start(RouteFollowerNode, route_file=str(path))
    assert '1 waypoints' in capfd.readouterr().err


def test_it_warns_of_tables_that_could_circle_for_ever(tester, capfd):
    tester.start(RouteFollowerNode, follow__v_dphi=[0.0, 2.0])
    assert 'could circle for ever' in capfd.readouterr().err
