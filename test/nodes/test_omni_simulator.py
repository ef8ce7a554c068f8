"""Node `omni_simulator` over a real graph: a robot whose wheels are not quite as drawn."""

from __future__ import annotations

from math import pi

import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped
from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from sensor_msgs.msg import Imu, JointState
from std_srvs.srv import SetBool, Trigger

from agv_motion.errors import ConfigurationError
from agv_motion.nodes.localization import Localization
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.nodes.omni_simulator import OmniSimulator
from agv_motion.ros.messages import seconds_of
from agv_motion.ros.qos import SENSOR

FAST = {'time_factor': 20.0, 'command_timeout': 60.0, 'robot__wheel_noise': 0.0}
MECANUM = {
    'wheel_angles': [pi / 4, -pi / 4, 3 * pi / 4, -3 * pi / 4],
    'wheel_distances': [0.3] * 4,
    'wheel_directions': [0.0] * 4,
    'slide_angles': [pi / 4, -pi / 4, -pi / 4, pi / 4],
    'wheel_radii': [0.05] * 4,
    'joint_names': ['a', 'b', 'c', 'd'],
}
REAL = {'real_distances': [0.3] * 4, 'real_radii': [0.05] * 4}


def test_it_drives_measures_and_can_be_carried_away(tester):
    truth = tester.listen(Odometry, 'ground_truth', SENSOR)
    imu = tester.listen(Imu, 'imu', SENSOR)
    tester.start(OmniSimulator, **FAST)
    commands = tester.publisher(JointState, 'wheels/command')
    commands.publish(JointState(name=['wheel_0', 'wheel_1', 'wheel_2'], velocity=[2.0] * 3))
    last = tester.wait(truth, lambda m: m.twist.twist.angular.z < -0.49)
    assert last.twist.twist.angular.z == pytest.approx(-0.5, abs=0.01)
    tester.graph.spin_until(lambda: len(imu) > 50)
    rates = [m.angular_velocity.z for m in imu[-30:]]
    assert sum(rates) / 30 == pytest.approx(-0.5 + 0.01, abs=0.01)
    request = SetMap.Request()
    request.initial_pose.pose.pose.position.x = 9.0
    assert tester.ask(SetMap, 'omni_simulator/carry', request).success
    tester.wait(truth, lambda m: m.pose.pose.position.x == pytest.approx(9.0, abs=0.1))
    request.initial_pose.header.frame_id = 'odom'
    refused = tester.ask(SetMap, 'omni_simulator/carry', request)
    assert not refused.success
    carried = PoseWithCovarianceStamped()
    carried.pose.pose.position.x, carried.pose.pose.orientation.w = 6.0, 1.0
    tester.publisher(PoseWithCovarianceStamped, 'carry').publish(carried)
    tester.wait(truth, lambda m: m.pose.pose.position.x == pytest.approx(6.0, abs=0.1))
    assert tester.ask(SetBool, 'omni_simulator/pause', SetBool.Request(data=True)).success
    tester.graph.spin_for(0.1)
    truth.clear()
    tester.graph.spin_for(0.1)
    assert not truth
    assert tester.ask(Trigger, 'omni_simulator/reset', Trigger.Request()).success
    assert tester.ask(SetBool, 'omni_simulator/pause', SetBool.Request(data=False)).success
    assert tester.wait(truth).pose.pose.position.x == pytest.approx(0.0, abs=0.01)


def test_fixes_come_late_with_the_stamp_of_their_time(tester):
    fixes = tester.listen(PoseWithCovarianceStamped, 'fix', SENSOR)
    node = tester.start(OmniSimulator, uwb__latency=1.0, uwb__rate=10.0, **FAST)
    delays = []
    tester.graph.spin_until(
        lambda: fixes and (delays.append(node.plain.time - fixes[-1].header.stamp.sec
                           - 1e-9 * fixes[-1].header.stamp.nanosec), len(delays) > 50)[1]
    )  # fmt: skip
    assert max(delays) > 0.3
    steps = {fix.header.stamp.nanosec % 10_000_000 for fix in fixes}
    assert steps == {0}  # whole steps, to the nanosecond
    assert fixes[0].pose.covariance[0] == pytest.approx(0.0225)
    assert fixes[0].pose.covariance[35] == 0.0


def test_a_dead_encoder_is_found_among_four_and_odometry_does_without(tester):
    """The whole robot: an encoder dies, is named, left out, and the odometry stays true."""
    odometry = tester.listen(Odometry, 'odom', SENSOR)
    truth = tester.listen(Odometry, 'ground_truth', SENSOR)
    simulator = tester.start(OmniSimulator, **(FAST | MECANUM | REAL | {'time_factor': 4.0}))
    node = tester.start(
        OmniKinematics, use_sim_time=True, report_after=60.0, stop_after=60.0, **MECANUM
    )
    cmd_vel = tester.publisher(TwistStamped, 'cmd_vel')
    assert simulator.set_parameters([rclpy.Parameter('faulty_wheel', value=2)])[0].successful
    refused = simulator.set_parameters([rclpy.Parameter('faulty_wheel', value=4)])[0]
    assert 'there are wheels 0 to 3' in refused.reason
    message = TwistStamped()

    def wiggled():
        wiggle = int(simulator.plain.elapsed) % 3
        message.twist.linear.x, message.twist.linear.y = 0.3 - 0.2 * wiggle, 0.2 * wiggle
        message.twist.angular.z = 0.3 * wiggle - 0.2
        cmd_vel.publish(message)

    tester.graph.repeat(
        wiggled,
        until=lambda: 'goes on without c' in node.plain.diagnose().message,
        every=0.02,
        timeout=150.0,
    )
    odometry.clear()
    truth.clear()
    wanted, real = message.twist, {}

    def settled():
        """Return the odometry of an instant at which the robot drove as it was told last."""
        real.update((seconds_of(m.header.stamp), m.twist.twist) for m in truth)
        return [
            m
            for m in odometry
            if (true := real.get(seconds_of(m.header.stamp)))
            and abs(true.linear.x - wanted.linear.x) < 1e-3
            and abs(true.linear.y - wanted.linear.y) < 1e-3
            and abs(true.angular.z - wanted.angular.z) < 1e-3
        ]

    tester.graph.repeat(lambda: cmd_vel.publish(message), until=lambda: len(settled()) > 5)
    measured = settled()[-1].twist.twist
    assert measured.linear.x == pytest.approx(wanted.linear.x, abs=0.02)
    assert measured.linear.y == pytest.approx(wanted.linear.y, abs=0.02)


def test_the_whole_robot_is_kidnapped_and_finds_itself(tester):
    poses = tester.listen(PoseWithCovarianceStamped, 'pose', SENSOR)
    truth = tester.listen(Odometry, 'ground_truth', SENSOR)
    simulator = tester.start(OmniSimulator, uwb__rate=5.0, uwb__heading_noise=0.05, **FAST)
    tester.start(OmniKinematics, use_sim_time=True, report_after=60.0, stop_after=60.0)
    localization = tester.start(
        Localization, use_sim_time=True, odom_covariance='message', fusion__kidnap_time=2.0
    )
    cmd_vel = tester.publisher(TwistStamped, 'cmd_vel')
    message = TwistStamped()
    message.twist.linear.x, message.twist.angular.z = 0.3, 0.2
    cmd_vel.publish(message)

    def near():
        if not poses or not truth:
            return False
        told, real = poses[-1].pose.pose.position, truth[-1].pose.pose.position
        return (told.x - real.x) ** 2 + (told.y - real.y) ** 2 < 0.2**2

    tester.graph.spin_until(lambda: simulator.plain.elapsed > 5.0 and near())
    request = SetMap.Request()
    request.initial_pose.pose.pose.position.x = 9.0
    assert tester.ask(SetMap, 'omni_simulator/carry', request).success
    tester.graph.spin_until(
        lambda: localization.plain.diagnose().values.get('fixes kidnapped') == '1' and near()
    )


def test_a_robot_that_cannot_be_is_refused(tester):
    with pytest.raises(ConfigurationError, match='2 real_radii for 3 wheels'):
        tester.start(OmniSimulator, real_radii=[0.05, 0.05])
