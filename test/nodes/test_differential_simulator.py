"""Node `differential_simulator`, and the whole robot as it is configured, on one real graph."""

from __future__ import annotations

from math import hypot, pi

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, Vector3Stamped
from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.nodes.differential_simulator import DifferentialSimulator
from agv_motion.nodes.ghost_trajectory import GhostTrajectory
from agv_motion.planar import Pose
from agv_motion.ros.config import find_config
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.messages import fill_pose, pose_of
from agv_motion.ros.qos import LATCHED, SENSOR
from agv_motion.ros.run import overrides, start
from agv_motion.trajectory.arc import Arc

STIFF = {'robot__traction_lag': 0.0, 'robot__slip_noise': 0.0}


def test_it_drives_measures_pauses_and_begins_again(tester):
    """Rates of 4 and 8 rad/s on 5 cm: 0.2 and 0.4 m/s, so 0.3 m/s and 0.2 / 0.3 rad/s."""
    truth = tester.listen(Odometry, 'ground_truth', SENSOR)
    states = tester.listen(JointState, 'wheels/state', SENSOR)
    fixes = tester.listen(PoseWithCovarianceStamped, 'fix', SENSOR)
    tester.start(DifferentialSimulator, time_factor=4.0, **STIFF)
    command = tester.publisher(JointState, 'wheels/command')
    command.publish(JointState(name=['right_wheel', 'left_wheel'], velocity=[8.0, 4.0]))
    moving = tester.wait(truth, lambda m: m.twist.twist.linear.x > 0.1)
    assert moving.twist.twist.linear.x == pytest.approx(0.3)
    assert moving.twist.twist.angular.z == pytest.approx(0.2 / 0.3)
    state = tester.wait(states, lambda m: m.position[0] > 1.0)
    assert list(state.velocity) == pytest.approx([4.0, 8.0])
    assert state.position[1] == pytest.approx(2.0 * state.position[0], abs=0.01)
    assert tester.wait(fixes).pose.covariance[0] == pytest.approx(1e-4)
    ask = lambda kind, name, **data: tester.ask(  # noqa: E731
        kind, f'differential_simulator/{name}', kind.Request(**data)
    )
    assert ask(SetBool, 'pause', data=True).success
    tester.graph.spin_for(0.1)
    truth.clear()
    tester.graph.spin_for(0.1)
    assert not truth
    assert ask(Trigger, 'reset').success
    assert ask(SetBool, 'pause', data=False).success
    assert tester.wait(truth).pose.pose.position.x == pytest.approx(0.0, abs=0.01)


def test_activated_again_it_stands_until_a_command_comes(tester):
    truth = tester.listen(Odometry, 'ground_truth', SENSOR)
    node = tester.start(DifferentialSimulator, command_timeout=60.0, **STIFF)
    command = tester.publisher(JointState, 'wheels/command')
    rolling = JointState(name=['right_wheel', 'left_wheel'], velocity=[4.0, 4.0])
    command.publish(rolling)
    tester.wait(truth, lambda m: m.twist.twist.linear.x > 0.1)
    node.trigger_deactivate()
    tester.graph.quiet(truth)
    node.trigger_activate()
    assert tester.wait(truth).twist.twist.linear.x == 0.0
    command.publish(rolling)
    tester.wait(truth, lambda m: m.twist.twist.linear.x > 0.1)


def test_a_command_for_one_wheel_is_refused(tester):
    node = tester.start(DifferentialSimulator)
    command = tester.publisher(JointState, 'wheels/command')
    command.publish(JointState(name=['left_wheel'], velocity=[1.0]))
    tester.graph.spin_until(lambda: 'give the velocity of' in node.complaint)


class Hare:
    """The robot of config/differential.yaml, twice as fast as life."""

    def __init__(self, tester):
        self.tester = tester
        self.states = tester.listen(String, 'ghost/state', LATCHED)
        self.truth = tester.listen(Odometry, 'ground_truth', SENSOR)
        self.simulator = self.start(DifferentialSimulator, time_factor=2.0)
        self.start(DifferentialKinematics, use_sim_time=True)
        self.ghost = self.start(GhostTrajectory, use_sim_time=True)
        tester.graph.spin_until(lambda: not self.ghost.plain.lost)

    def start(self, kind, **changes):
        arguments = [
            '--ros-args', '--params-file', str(find_config('differential.yaml')),
            '-r', 'pose:=fix',
        ]  # fmt: skip
        node = LiveNode(
            kind, context=self.tester.graph.context, cli_args=arguments,
            parameter_overrides=overrides(**changes),
        )  # fmt: skip
        self.tester.graph.add(node)
        start(node)
        return node

    def says(self, words):
        self.tester.wait(self.states, lambda m: words in m.data)

    def is_at(self, x, y, theta):
        pose = pose_of(self.truth[-1].pose.pose)
        assert hypot(pose.x - x, pose.y - y) < 0.04
        assert abs(pose.theta - theta) < 0.08


def test_the_whole_robot_reaches_its_goals_with_slip_lag_and_noise(tester):
    hare = Hare(tester)
    goal = PoseStamped()
    goal.header.frame_id = 'map'
    fill_pose(goal.pose, Pose(0.8, 0.3, 0.5))
    tester.publisher(PoseStamped, 'goal_pose').publish(goal)
    hare.says('driving')
    hare.says('arrived')
    hare.is_at(0.8, 0.3, 0.5)
    hare.states.clear()
    arc = Vector3Stamped()
    arc.vector.x, arc.vector.y, arc.vector.z = -pi / 2, 0.3, -0.4
    begin = pose_of(hare.truth[-1].pose.pose)
    tester.publisher(Vector3Stamped, 'arc').publish(arc)
    hare.says('arrived')
    hare.is_at(*Arc(-pi / 2, 0.3, 0.3, -0.4, 0.4).end(begin))


def test_the_whole_robot_is_kidnapped_and_stops(tester):
    hare = Hare(tester)
    goal = PoseStamped()
    fill_pose(goal.pose, Pose(20.0, 0.0, 0.0))
    tester.publisher(PoseStamped, 'goal_pose').publish(goal)
    tester.wait(hare.truth, lambda m: m.twist.twist.linear.x > 0.1)
    request = SetMap.Request()
    request.initial_pose.pose.pose.position.y = 3.0
    assert tester.ask(SetMap, 'differential_simulator/carry', request).success
    hare.says('lost')
    hare.truth.clear()
    tester.wait(hare.truth, lambda m: abs(m.twist.twist.linear.x) < 1e-3)
