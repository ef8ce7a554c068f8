"""Node `motion_generator` over a real graph: the equations of motion, rest, and silence."""

from __future__ import annotations

from math import atan2, hypot, nan, pi

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Path
from std_msgs.msg import Bool
from std_srvs.srv import SetBool

from agv_motion.errors import ConfigurationError
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.ros.qos import LATCHED
from agv_motion.ros.run import StartError


@pytest.fixture
def senses(make_senses):
    return make_senses()


def test_sap_flow_drives_the_tree_to_its_goal(senses):
    """Hand calculation: at (7, 1) looking at 1 rad, the goal lies 5 m away at 0.9273 rad."""
    senses.stand(7.0, 1.0, 1.0)
    senses.feel(0.6, 0.75, 0.2)
    twist = senses.moves().twist
    assert hypot(twist.linear.x, twist.linear.y) == pytest.approx(0.6 / 60.0)
    assert atan2(twist.linear.y, twist.linear.x) == pytest.approx(atan2(4.0, 3.0) - 1.0)
    assert twist.angular.z == pytest.approx(0.5 / 60.0 / 1.18)


def test_at_the_goal_it_turns_on_the_spot(senses):
    senses.stand(9.5, 5.0, 0.0)
    senses.feel(1.0, 1.0, 0.5)
    twist = senses.moves().twist
    assert twist.linear.x == twist.linear.y == 0.0
    assert twist.angular.z > 0.0


def test_it_rests_while_the_sap_stands(senses):
    senses.stand(7.0, 1.0, 0.0)
    senses.feel(0.9, 0.9, 0.9)
    senses.moves()
    senses.feel(0.05, 0.0, 0.1)
    senses.rests()
    senses.tester.wait(senses.states, lambda m: 'the sap stands' in m.data)


def test_a_probe_not_to_be_believed_means_rest(senses):
    senses.stand(7.0, 1.0, 0.0)
    senses.feel(0.9, 0.9, 0.9)
    senses.moves()
    senses.valid.publish(Bool(data=False))
    senses.rests()
    senses.valid.publish(Bool(data=True))
    senses.commands.clear()
    senses.moves()


@pytest.mark.parametrize('silent', ['sap flow', 'pose'])
def test_silence_of_an_input_means_an_explicit_stop(tester, make_senses, silent):
    senses = make_senses(report_after=0.2, stop_after=0.5)
    senses.stand(7.0, 1.0, 0.0)
    senses.feel(0.9, 0.9, 0.9)
    senses.moves()
    senses.tester.graph.repeat(
        lambda: senses.feel(0.9, 0.9, 0.9) if silent == 'pose' else senses.stand(7.0, 1.0, 0.0),
        until=lambda: not senses.moving(senses.commands[-1]),
    )
    tester.wait(senses.states, lambda m: f'no {silent}' in m.data)


@pytest.mark.parametrize('flow', [(nan, 0.5, 0.5), (1.5, 0.5, 0.5), (0.5, -0.1, 0.5)])
def test_a_sap_flow_out_of_its_range_is_refused(senses, flow):
    senses.stand(7.0, 1.0, 0.0)
    senses.feel(*flow)
    senses.tester.graph.spin_until(lambda: 'sap flow' in senses.node.complaint)
    assert not any(senses.moving(command) for command in senses.commands)


def test_a_pose_in_another_frame_or_without_orientation_is_refused(senses):
    senses.stand(7.0, 1.0, 0.0, frame='odom')
    senses.tester.graph.spin_until(lambda: "expected 'map'" in senses.node.complaint)
    senses.pose.publish(PoseWithCovarianceStamped())
    senses.pose.publish(PoseWithCovarianceStamped(pose=zero_quaternion()))
    senses.tester.graph.spin_until(lambda: 'quaternion' in senses.node.complaint)


def zero_quaternion():
    message = PoseWithCovarianceStamped().pose
    message.pose.orientation.w = 0.0
    return message


def test_a_clicked_goal_is_taken_and_told(senses):
    goals = senses.tester.listen(PoseStamped, 'goal', LATCHED)
    first = senses.tester.wait(goals)
    assert (first.pose.position.x, first.pose.position.y) == (10.0, 5.0)
    clicked = PoseStamped()
    clicked.header.frame_id = 'map'
    clicked.pose.position.x = 7.0
    clicked.pose.position.y = 8.0
    senses.tester.publisher(PoseStamped, 'goal_pose').publish(clicked)
    senses.tester.wait(goals, lambda m: m.pose.position.y == 8.0)
    senses.stand(7.0, 1.0, pi / 2)
    senses.feel(1.0, 0.5, 0.5)
    twist = senses.moves().twist
    assert (twist.linear.x, twist.linear.y) == pytest.approx((1 / 60.0, 0.0), abs=1e-12)


def test_pause_stops_and_goes_on(senses):
    senses.stand(7.0, 1.0, 0.0)
    senses.feel(0.9, 0.9, 0.9)
    senses.moves()
    ask = senses.tester.ask
    assert ask(SetBool, 'motion_generator/pause', SetBool.Request(data=True)).success
    senses.rests()
    assert ask(SetBool, 'motion_generator/pause', SetBool.Request(data=False)).success
    senses.commands.clear()
    senses.moves()


def test_the_last_word_is_zero(senses):
    senses.stand(7.0, 1.0, 0.0)
    senses.feel(0.9, 0.9, 0.9)
    senses.moves()
    senses.node.trigger_shutdown()
    senses.tester.graph.spin_until(lambda: not senses.moving(senses.commands[-1]))


def test_thresholds_that_contradict_each_other_are_refused(tester):
    with pytest.raises(ConfigurationError, match='fall asleep at once'):
        tester.start(MotionGenerator, rest__rest_below=0.5)


COLUMN = """
boundary: [[0, 0], [20, 0], [20, 10], [0, 10]]
holes: [[[9, 4], [11, 4], [11, 6], [9, 6]]]
"""


@pytest.fixture
def zone(tmp_path):
    path = tmp_path / 'zone.yaml'
    path.write_text(COLUMN)
    return str(path)


def test_it_walks_round_what_stands_in_the_way(tester, make_senses, zone):
    """From (5, 5) to (15, 5) past the column: the first heading is off the straight line."""
    senses = make_senses(zone_file=zone, goal=[15.0, 5.0])
    paths = tester.listen(Path, 'path', LATCHED)
    senses.stand(5.0, 5.0, 0.0)
    senses.feel(1.0, 0.5, 0.5)
    twist = senses.moves().twist
    assert abs(atan2(twist.linear.y, twist.linear.x)) > 0.2
    assert len(tester.wait(paths).poses) > 2


def test_outside_its_zone_it_stops_and_says_so(tester, make_senses, zone):
    senses = make_senses(zone_file=zone, goal=[15.0, 5.0])
    senses.stand(10.0, 5.0, 0.0)
    senses.feel(1.0, 1.0, 1.0)
    tester.wait(senses.states, lambda m: 'lies in hole 1' in m.data)
    assert not any(senses.moving(command) for command in senses.commands)


def test_a_goal_outside_the_zone_is_refused_and_the_old_one_stays(tester, make_senses, zone):
    senses = make_senses(zone_file=zone, goal=[15.0, 5.0])
    clicked = PoseStamped()
    clicked.pose.position.x = 30.0
    clicked.pose.orientation.w = 1.0
    tester.publisher(PoseStamped, 'goal_pose').publish(clicked)
    tester.graph.spin_until(lambda: 'lies outside the zone' in senses.node.complaint)
    senses.stand(14.5, 5.0, 0.0)
    senses.feel(1.0, 1.0, 0.5)
    tester.wait(senses.states, lambda m: 'at the goal' in m.data)


def test_a_zone_that_is_no_polygon_stops_the_start(tester, tmp_path, capfd):
    path = tmp_path / 'zone.yaml'
    path.write_text('boundary: [[0, 0], [4, 4], [4, 0], [0, 4]]')
    with pytest.raises(StartError):
        tester.start(MotionGenerator, zone_file=str(path))
    assert 'boundary is no polygon' in capfd.readouterr().err


def keeps_telling(senses, until):
    """Tell sap flow and pose again and again, the same pose, until ``until()``."""

    def tell():
        senses.stand(7.0, 1.0, 0.0)
        senses.feel(0.9, 0.9, 0.9)

    senses.tester.graph.repeat(tell, until, every=0.05)


def says(senses, words):
    return any(words in message.data for message in senses.states)


def test_a_tree_that_does_not_move_though_told_to_is_blocked_until_a_person_lets_it_go_on(
    make_senses,
):
    """15 mm/s: 7 mm in 0.5 s, which 1 mm of the pose would show."""
    senses = make_senses(blocked__after=0.5, blocked__distance=0.001, blocked__then='stop')
    keeps_telling(senses, lambda: says(senses, 'blocked: told to move by 0.0'))
    senses.commands.clear()
    keeps_telling(senses, lambda: len(senses.commands) > 5)
    assert not any(map(senses.moving, senses.commands))
    assert senses.node.plain.diagnose().level == b'\x02'
    assert senses.tester.ask(SetBool, 'motion_generator/pause', SetBool.Request()).success
    senses.commands.clear()
    keeps_telling(senses, lambda: any(map(senses.moving, senses.commands)))


def test_or_tries_again_by_itself(make_senses):
    senses = make_senses(blocked__after=0.5, blocked__distance=0.001, blocked__retry_after=0.3)
    keeps_telling(senses, lambda: says(senses, 'trying again in 0.3 s'))
    senses.commands.clear()
    keeps_telling(senses, lambda: any(map(senses.moving, senses.commands)))


def test_activated_again_it_rests_until_sap_flow_and_pose_are_told_anew(senses):
    """What it knew before may be hours old; what was latched meanwhile is heard."""
    keeps_telling(senses, lambda: any(map(senses.moving, senses.commands)))
    senses.node.trigger_deactivate()
    senses.rests()
    senses.valid.publish(Bool(data=False))
    senses.tester.graph.spin_for(0.3)
    senses.commands.clear()
    senses.node.trigger_activate()
    senses.tester.graph.spin_until(lambda: len(senses.commands) > 5)
    senses.feel(0.9, 0.9, 0.9)
    senses.tester.graph.spin_for(0.3)
    assert not any(map(senses.moving, senses.commands))
    keeps_telling(senses, lambda: says(senses, 'a probe cannot be believed'))
    senses.valid.publish(Bool(data=True))
    senses.commands.clear()
    keeps_telling(senses, lambda: any(map(senses.moving, senses.commands)))
