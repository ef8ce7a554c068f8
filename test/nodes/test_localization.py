"""Node `localization` over a real graph: what it believes, refuses, notices and tells."""

from __future__ import annotations

from math import atan2, cos, hypot, inf, nan, sin

import numpy as np
import pytest

rclpy = pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from nav_msgs.srv import SetMap
from sensor_msgs.msg import Imu
from std_srvs.srv import Trigger

from agv_motion.nodes.localization import Localization
from agv_motion.odometry.covariance import Covariance
from agv_motion.odometry.yaw_rate import YawRate
from agv_motion.planar import Pose, compose, wrap
from agv_motion.ros.covariances import fill_covariance
from agv_motion.ros.diagnosis import ERROR, WARN
from agv_motion.ros.messages import fill_pose, pose_of, stamp_of
from agv_motion.ros.qos import SENSOR

START = Pose(5.0, 3.0, 1.0)
"""Where `odom` begins, in the map."""
ROUND = Covariance(0.0225, 0.0, 0.0, 0.0225, 0.0, 0.0)
LOOKING = Covariance(0.0225, 0.0, 0.0, 0.0225, 0.0, 0.01)


class Robot:
    """Drives a circle of 1 m at 0.5 m/s in steps of 0.1 s, and tells the node what it measures."""

    def __init__(self, tester, covariance=ROUND, **parameters):
        self.tester, self.covariance = tester, covariance
        self.time, self.gone, self.random = 100.0, 0.0, np.random.default_rng(1)
        self.lifted = Pose(0.0, 0.0, 0.0)
        self.poses = tester.listen(PoseWithCovarianceStamped, 'pose', SENSOR)
        self.filtered = tester.listen(Odometry, 'odom/filtered', SENSOR)
        self.node = tester.start(Localization, **({'max_age': 1e10} | parameters))
        self.odom = tester.publisher(Odometry, 'odom', SENSOR)
        self.fix = tester.publisher(PoseWithCovarianceStamped, 'fix', SENSOR)
        self.imu = tester.publisher(Imu, 'imu', SENSOR)

    @property
    def in_odom(self):
        return Pose(sin(self.gone), 1.0 - cos(self.gone), wrap(self.gone))

    @property
    def truth(self):
        return compose(self.lifted, compose(START, self.in_odom))

    def odometry(self, time, pose):
        message = Odometry(child_frame_id='base_link')
        message.header.stamp, message.header.frame_id = stamp_of(round(time * 1e9)), 'odom'
        fill_pose(message.pose.pose, pose)
        message.twist.twist.linear.x, message.twist.twist.angular.z = 0.5, 0.5
        return message

    def sight(self, time, pose, covariance=None, noise=0.15):
        message = PoseWithCovarianceStamped()
        message.header.stamp, message.header.frame_id = stamp_of(round(time * 1e9)), 'map'
        x, y = self.random.normal(pose.x, noise), self.random.normal(pose.y, noise)
        fill_pose(message.pose.pose, Pose(x, y, pose.theta))
        fill_covariance(message.pose.covariance, covariance or self.covariance)
        return message

    def publish(self, publisher, message, inbox):
        """Publish, and spin until the node has answered or had the time to."""
        count = len(inbox)
        publisher.publish(message)
        self.tester.graph.spin_until(lambda: len(inbox) > count)

    def step(self, *, fixes=True):
        self.time += 0.1
        self.gone += 0.05
        self.publish(self.odom, self.odometry(self.time, self.in_odom), self.filtered)
        if fixes and round(self.time * 10) % 5 == 0:
            self.fix.publish(self.sight(self.time, self.truth))

    def run(self, seconds, **options):
        for _ in range(round(seconds * 10)):
            self.step(**options)
        self.tester.graph.spin_for(0.05)

    def missed(self):
        pose = pose_of(self.poses[-1].pose.pose)
        return hypot(pose.x - self.truth.x, pose.y - self.truth.y)

    def values(self):
        return self.node.plain.diagnose().values


def set_pose(pose, covariance=None, frame='map'):
    request = SetMap.Request()
    request.initial_pose.header.frame_id = frame
    fill_pose(request.initial_pose.pose.pose, pose)
    if covariance:
        fill_covariance(request.initial_pose.pose.covariance, covariance)
    return request


@pytest.mark.parametrize('covariance', [ROUND, LOOKING], ids=['one tag', 'several tags'])
def test_it_finds_the_robot_and_keeps_it(tester, covariance):
    robot = Robot(tester, covariance)
    assert robot.node.plain.diagnose()[:2] == (WARN, 'no odom yet')
    robot.run(1.0, fixes=False)
    assert not robot.poses
    assert robot.node.plain.diagnose().level == WARN  # it begins: nothing is wrong
    robot.run(20.0)
    told = robot.poses[-1]
    assert robot.missed() < 0.15
    assert told.header.frame_id == 'map'
    assert told.header.stamp == robot.filtered[-1].header.stamp
    assert 0.0 < told.pose.covariance[0] < 0.0225 / 2
    assert told.pose.covariance[35] > 0.0
    assert robot.values()['state'] == 'tracking'


def test_a_pose_that_is_set_is_believed(tester):
    robot = Robot(tester)
    assert not tester.ask(SetMap, 'localization/set_pose', set_pose(START)).success
    robot.run(0.2, fixes=False)
    assert tester.ask(SetMap, 'localization/set_pose', set_pose(robot.truth)).success
    robot.run(0.2, fixes=False)
    assert robot.missed() < 0.05
    assert robot.poses[-1].pose.covariance[0] == pytest.approx(0.25, rel=0.05)
    for topic, x in (('initialpose', -4.0), ('set_pose', 7.0)):
        publisher = tester.publisher(PoseWithCovarianceStamped, topic)
        publisher.publish(robot.sight(0.0, Pose(x, 2.0, 0.0), LOOKING, noise=0.0))
        tester.graph.repeat(
            lambda: robot.run(0.1, fixes=False),
            until=lambda x=x: abs(robot.poses[-1].pose.pose.position.x - x) < 0.5,
        )
    for bad in (
        set_pose(Pose(nan, 0.0, 0.0)),
        set_pose(START, Covariance(0.1, 0.2, 0.0, 0.1, 0.0, 0.1)),
        set_pose(START, frame='odom'),
    ):
        assert not tester.ask(SetMap, 'localization/set_pose', bad).success


def edited(change):
    def make(robot):
        message = robot.sight(robot.time, robot.truth)
        change(message)
        return message

    return make


@pytest.mark.parametrize(
    ('change', 'word'),
    [
        (lambda m: m.pose.covariance.__setitem__(0, 0.0), 'not positive definite'),
        (lambda m: m.pose.covariance.__setitem__(35, -0.1), 'not positive definite'),
        (lambda m: [m.pose.covariance.__setitem__(i, 0.03) for i in (1, 6)], 'not positive'),
        (lambda m: m.pose.covariance.__setitem__(1, 0.01), 'a covariance is symmetric'),
        (lambda m: m.pose.covariance.__setitem__(7, nan), 'covariance of x, y and yaw'),
        (lambda m: setattr(m.pose.pose.position, 'x', inf), 'pose must be finite'),
        (lambda m: setattr(m.pose.pose.orientation, 'w', 0.0), 'must have length 1'),
        (lambda m: setattr(m.header, 'frame_id', 'odom'), "expected 'map'"),
    ],
)
def test_a_fix_that_is_no_measurement_is_refused_by_name(tester, change, word):
    robot = Robot(tester)
    message = robot.sight(robot.time, START._replace(theta=0.0))
    message.pose.pose.orientation.z = 0.0
    change(message)
    robot.fix.publish(message)
    tester.graph.spin_until(lambda: word in robot.node.complaint)
    assert not any(name.startswith('fixes') for name in robot.values())


@pytest.mark.parametrize(
    ('change', 'word'),
    [
        (lambda m: setattr(m.pose.pose.position, 'y', nan), 'pose must be finite'),
        (lambda m: setattr(m.twist.twist.linear, 'x', nan), 'twist'),
        (lambda m: setattr(m.header, 'frame_id', 'map'), "expected 'odom'"),
        (lambda m: setattr(m, 'child_frame_id', 'wheel'), "expected 'base_link'"),
    ],
)
def test_odometry_that_cannot_be_is_refused(tester, change, word):
    robot = Robot(tester)
    message = robot.odometry(1.0, START)
    change(message)
    robot.odom.publish(message)
    tester.graph.spin_until(lambda: word in robot.node.complaint)
    assert not robot.filtered


def test_odometry_without_a_covariance_is_refused_where_one_is_asked_for(tester):
    robot = Robot(tester, odom_covariance='message')
    for x in (0.0, 0.1):
        robot.odom.publish(robot.odometry(1.0 + x, Pose(x, 0.0, 0.0)))
        tester.graph.spin_for(0.1)
    tester.graph.spin_until(lambda: "set odom_covariance to 'assumed'" in robot.node.complaint)


def test_late_and_disordered_messages_do_no_harm(tester):
    robot = Robot(tester, LOOKING)
    robot.run(10.0)
    old = robot.sight(robot.time - 0.8, compose(START, Pose(sin(robot.gone - 0.4),
                      1.0 - cos(robot.gone - 0.4), robot.gone - 0.4)))  # fmt: skip
    robot.fix.publish(old)
    robot.fix.publish(old)
    robot.fix.publish(robot.sight(robot.time - 20.0, robot.truth))
    robot.fix.publish(robot.sight(robot.time + 500.0, robot.truth))
    tester.graph.spin_until(lambda: robot.values().get('fixes early') == '1')
    assert robot.values()['fixes duplicate'] == robot.values()['fixes late'] == '1'
    assert 'odom is at' in robot.node.complaint
    count = len(robot.filtered)
    robot.odom.publish(robot.odometry(robot.time - 0.3, Pose(0.0, 0.0, 0.0)))
    tester.graph.spin_for(0.1)
    assert len(robot.filtered) == count
    robot.run(1.0)
    assert robot.missed() < 0.15


def test_kidnapping_is_noticed_told_and_mended(tester):
    robot = Robot(tester, LOOKING, fusion__kidnap_time=2.0, fusion__kidnap_fixes=5)
    robot.run(10.0)
    robot.lifted = Pose(3.0, 2.0, 1.0)
    robot.run(2.0)
    assert robot.values()['state'] == 'doubtful'
    assert robot.missed() > 2.0
    robot.run(10.0)
    assert robot.values()['fixes kidnapped'] == '1'
    assert robot.values()['state'] == 'tracking'
    assert robot.missed() < 0.3


def test_odometry_that_begins_anew_moves_nobody(tester):
    robot = Robot(tester, LOOKING)
    robot.run(10.0)
    before = robot.poses[-1].pose.pose.position
    moved = compose(Pose(40.0, -7.0, 2.0), robot.in_odom)
    robot.odom.publish(robot.odometry(robot.time + 0.1, moved))
    tester.graph.spin_until(lambda: 'cannot follow the last' in robot.node.complaint)
    robot.publish(robot.odom, robot.odometry(robot.time + 0.2, moved), robot.filtered)
    tester.graph.spin_for(0.05)
    after = robot.poses[-1].pose.pose.position
    assert hypot(after.x - before.x, after.y - before.y) < 0.1


def test_a_pose_that_has_become_a_guess_is_no_longer_told(tester):
    robot = Robot(tester, LOOKING, max_position_deviation=0.2, odom_timeout=0.3)
    robot.run(10.0)
    robot.run(60.0, fixes=False)
    count = len(robot.poses)
    robot.run(1.0, fixes=False)
    assert len(robot.poses) == count
    assert robot.node.plain.diagnose().message.startswith('pose not told: no fix for a while')
    assert robot.node.plain.diagnose().level == ERROR
    assert robot.values()['state'] == 'odometry_only'
    tester.graph.spin_until(lambda: robot.node.plain.diagnose().message == 'odom is lost')


def test_restart_forgets(tester):
    robot = Robot(tester, LOOKING)
    robot.run(10.0)
    assert tester.ask(Trigger, 'localization/restart', Trigger.Request()).success
    count = len(robot.poses)
    robot.run(0.3, fixes=False)
    assert len(robot.poses) == count
    assert robot.values()['state'] == 'waiting'


def test_a_gyroscope_mends_the_turns_of_the_wheels(tester, monkeypatch):
    """Wheels that see 10 % of each turn too little: over one round 36 degrees, with it a few."""
    add, taken = YawRate.add, []
    monkeypatch.setattr(
        YawRate, 'add', lambda gyro, *rate, **how: (add(gyro, *rate, **how), taken.append(rate))
    )
    robot = Robot(tester, odom_noise__turning=0.2, gyro__bias=0.001)
    for i in range(126):
        imu = Imu()
        imu.header.stamp, imu.header.frame_id = stamp_of(round((100.0 + 0.1 * i) * 1e9)), 'imu_link'
        imu.angular_velocity.z = 0.5
        robot.imu.publish(imu)
        tester.graph.spin_until(lambda: len(taken) > i)  # noqa: B023 - at once
        wrong = Pose(sin(0.045 * i), 1.0 - cos(0.045 * i), wrap(0.045 * i))
        robot.publish(robot.odom, robot.odometry(100.0 + 0.1 * i, wrong), robot.filtered)
    heading = pose_of(robot.filtered[-1].pose.pose).theta
    assert abs(wrap(heading - 0.05 * 125)) < 0.1
    assert robot.values()['gyroscope'].startswith('bias')
    imu.header.stamp.sec += 1
    imu.angular_velocity.z = nan
    robot.imu.publish(imu)
    tester.graph.spin_until(lambda: 'yaw rate' in robot.node.complaint)


def test_an_imu_without_a_gyroscope_tells_no_rate_of_zero(tester):
    """Its first covariance is -1 then, says sensor_msgs/Imu; the wheels turned by half a radian."""
    robot = Robot(tester)
    for i in range(11):
        imu = Imu()
        imu.header.stamp, imu.header.frame_id = stamp_of(round((100.0 + 0.1 * i) * 1e9)), 'imu_link'
        imu.angular_velocity_covariance[0] = -1.0
        robot.imu.publish(imu)
        tester.graph.spin_until(lambda: robot.node.port.complaints.count > i)  # noqa: B023 - at once
        turned = Pose(0.0, 0.0, 0.05 * i)
        robot.publish(robot.odom, robot.odometry(100.0 + 0.1 * i, turned), robot.filtered)
    assert pose_of(robot.filtered[-1].pose.pose).theta == pytest.approx(0.5)
    assert robot.values()['gyroscope'] == 'none'
    assert 'it tells no rate' in robot.node.complaint


def test_transforms_where_tf2_msgs_is_installed(tester):
    """Chained, they are the pose that is told."""
    tf2_msgs = pytest.importorskip('tf2_msgs.msg')
    transforms = tester.listen(tf2_msgs.TFMessage, '/tf')
    robot = Robot(tester, LOOKING)
    robot.run(10.0)
    found = {(t.header.frame_id, t.child_frame_id): t for t in transforms[-1].transforms}
    assert set(found) == {('map', 'odom'), ('odom', 'base_link')}
    chain = [
        Pose(move.translation.x, move.translation.y, 2.0 * atan2(move.rotation.z, move.rotation.w))
        for move in (found['map', 'odom'].transform, found['odom', 'base_link'].transform)
    ]
    assert compose(*chain) == pytest.approx(pose_of(robot.poses[-1].pose.pose), abs=1e-9)


def test_without_a_clock_no_fix_is_blamed_for_its_stamp(tester):
    told = tester.listen(DiagnosticArray, '/diagnostics', 10)
    robot = Robot(tester, use_sim_time=True, max_age=2.0)
    tester.node.create_timer(0.02, lambda: robot.fix.publish(robot.sight(1e9, START)))
    tester.wait(told, lambda m: 'no time has come on /clock yet' in m.status[0].message)
    tester.graph.spin_for(0.1)
    assert not robot.node.complaint
