"""Node `simulator` over a real graph: a platform that follows, a clock, sun and noise."""

from __future__ import annotations

import time

import pytest

rclpy = pytest.importorskip('rclpy')

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Illuminance, JointState
from std_srvs.srv import SetBool, Trigger

from agv_motion.errors import ConfigurationError
from agv_motion.nodes.simulator import Simulator
from agv_motion.ros.messages import TurretJoints, seconds_of
from agv_motion.ros.qos import SENSOR

FAST = {'time_factor': 20.0, 'command_timeout': 60.0}


def drive(tester, rate):
    message = TurretJoints(3).message()
    TurretJoints(3).fill(message, [0.0] * 3, [rate] * 3)
    tester.publisher(JointState, 'turrets/command').publish(message)


def test_the_platform_goes_where_its_wheels_roll(tester):
    truth = tester.listen(Odometry, 'ground_truth', SENSOR)
    tester.start(Simulator, start_x=2.0, start_y=3.0, **FAST)
    drive(tester, 0.1)  # wheels of 0.1 m: 0.01 m/s
    last = tester.wait(truth, lambda m: m.pose.pose.position.x > 2.1)
    assert last.pose.pose.position.y == pytest.approx(3.0)
    assert last.twist.twist.linear.x == pytest.approx(0.01, rel=1e-3)


def test_the_clock_runs_as_fast_as_asked(tester):
    clock = tester.listen(Clock, '/clock', SENSOR)
    tester.start(Simulator, start_time='2015-06-15T08:00:00Z', **FAST)
    begun = time.monotonic()
    tester.wait(clock)
    start = seconds_of(clock[0].clock)
    assert 1434355200.0 < start < 1434355210.0
    tester.wait(clock, lambda m: seconds_of(m.clock) > start + 10.0)
    passed = time.monotonic() - begun  # a busy machine may be slower than asked, never faster
    assert seconds_of(clock[-1].clock) - start < FAST['time_factor'] * (passed + 0.1)


def test_fixes_are_noisy_and_say_how_much(tester):
    fixes = tester.listen(PoseWithCovarianceStamped, 'fix', SENSOR)
    tester.start(Simulator, start_x=2.0, fixes__rate=10.0, **FAST)
    tester.graph.spin_until(lambda: len(fixes) > 100)
    errors = [fix.pose.pose.position.x - 2.0 for fix in fixes]
    assert 0.1 < (sum(e * e for e in errors) / len(errors)) ** 0.5 < 0.2
    assert fixes[0].pose.covariance[0] == pytest.approx(0.15**2)
    assert fixes[0].header.frame_id == 'map'


def test_its_diagnostics_have_the_simulated_time(tester):
    reports = tester.listen(DiagnosticArray, '/diagnostics')
    tester.start(Simulator, **FAST)
    report = tester.wait(reports, lambda m: m.status[0].message == 'running')
    assert 1434366000.0 <= seconds_of(report.header.stamp) < 1434366000.0 + 1000.0


def test_there_is_light_by_day(tester):
    light = tester.listen(Illuminance, 'sunlight', SENSOR)
    tester.start(Simulator, start_time='2015-06-15T12:00:00', **FAST)
    assert 50_000.0 < tester.wait(light).illuminance < 130_000.0


def test_pause_and_reset(tester):
    truth = tester.listen(Odometry, 'ground_truth', SENSOR)
    tester.start(Simulator, start_x=2.0, **FAST)
    drive(tester, 0.1)
    tester.wait(truth, lambda m: m.pose.pose.position.x > 2.05)
    assert tester.ask(SetBool, 'simulator/pause', SetBool.Request(data=True)).success
    tester.graph.spin_for(0.1)
    truth.clear()
    tester.graph.spin_for(0.3)
    assert not truth
    assert tester.ask(Trigger, 'simulator/reset', Trigger.Request()).success
    assert tester.ask(SetBool, 'simulator/pause', SetBool.Request(data=False)).success
    assert tester.wait(truth).pose.pose.position.x == pytest.approx(2.0, abs=0.01)


@pytest.mark.parametrize(
    ('parameters', 'word'),
    [
        ({'start_time': 'yesterday'}, 'ISO 8601'),
        ({'obstacle_x': [1.0]}, 'all four of every obstacle'),
        ({'turret_x': [1.0, 2.0, float('nan')]}, 'finite'),
    ],
)
def test_parameters_that_make_no_sense_are_refused(tester, parameters, word):
    with pytest.raises(ConfigurationError, match=word):
        tester.start(Simulator, **parameters)


def test_of_two_simulated_trees_one_follows_the_clock_of_the_other(tester):
    """The second makes no clock; its truth has the stamps of the first, also after a reset."""
    clock = tester.listen(Clock, '/clock', SENSOR)
    truth = tester.listen(Odometry, 'ash/ground_truth', SENSOR)
    tester.start(Simulator, **FAST)
    tester.start(Simulator, remap=['__ns:=/ash'], clock='follow', start_x=4.0)
    assert tester.wait(truth).pose.pose.position.x == 4.0
    tester.graph.spin_until(lambda: len(truth) > 50)
    stamps = {seconds_of(message.header.stamp) for message in truth}
    assert len(stamps) == len(truth)
    assert stamps <= {seconds_of(message.clock) for message in clock}
    last = seconds_of(truth[-1].header.stamp)
    truth.clear()
    assert tester.ask(Trigger, 'simulator/reset', Trigger.Request()).success
    tester.wait(truth, lambda m: seconds_of(m.header.stamp) < last)


def test_two_that_make_time_pass_are_told_of(tester):
    reports = tester.listen(DiagnosticArray, '/diagnostics')
    tester.start(Simulator, **FAST)
    tester.start(Simulator, remap=['__ns:=/ash'], **FAST)
    word = '/ash/simulator, /simulator all tell the time on /clock'
    tester.wait(reports, lambda m: any(status.message == word for status in m.status))
