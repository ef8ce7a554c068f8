"""The whole tree as real nodes: the spruce's June moves it by day and lets it rest by night."""

from __future__ import annotations

from math import hypot, isfinite

import numpy as np
import pytest

rclpy = pytest.importorskip('rclpy')

from geometry_msgs.msg import TwistStamped
from sensor_msgs.msg import JointState

from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.simulator import Simulator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.probe.tables.time_format import parse_time
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.messages import seconds_of
from agv_motion.ros.qos import COMMAND
from agv_motion.ros.run import overrides, spin, start

FACTOR = 60.0
"""Simulated seconds a second"""
SECOND = 1_000_000_000
NOON = 1434366000
"""[s] when simulated time begins"""


class Walk:
    """What was commanded during a stretch of the recording, against the time of the recording."""

    def __init__(self, recording, begin, days, simulated, offsets):
        self.begin = parse_time(begin)
        self.speed = days * 86400.0 / simulated
        self.simulated = simulated
        self.probes = {
            'source': 'csv', 'csv.file': str(recording), 'csv.start': begin,
            'csv.speed': self.speed, 'csv.columns': ['delta_v_mv'] * 3,
            'csv.day_offsets': list(offsets), 'probe.solar_offset': 0.5,
        }  # fmt: skip
        self.twists, self.rates = [], []

    def live(self):
        """Walk with real nodes on a real graph."""
        context = rclpy.Context()
        rclpy.init(context=context)
        common = {'context': context, 'parameter_overrides': overrides(use_sim_time=True)}
        probes = overrides(use_sim_time=True, **self.probes)
        nodes = [
            LiveNode(GranierProbe, context=context, parameter_overrides=probes),
            LiveNode(MotionGenerator, **common, cli_args=['--ros-args', '-r', 'pose:=fix']),
            LiveNode(WheelKinematics, **common),
            LiveNode(Simulator, context=context, parameter_overrides=overrides(time_factor=FACTOR)),
        ]
        watcher = rclpy.lifecycle.LifecycleNode('watcher', context=context)
        watcher.create_subscription(TwistStamped, 'cmd_vel', self.twists.append, COMMAND)
        watcher.create_subscription(JointState, 'turrets/command', self.rates.append, COMMAND)
        for node in nodes:
            start(node)
        simulator, steps = nodes[-1].plain, int(self.simulated * 10)
        spin([*nodes, watcher], lambda: simulator.steps >= steps, context=context)
        rclpy.shutdown(context=context)
        return self

    def in_process(self):
        """Walk with the same nodes without middleware: a third of the computing."""

        def record(publisher, _, data):
            if publisher.topic == '/cmd_vel':
                self.twists.append(codec(TwistStamped).decode(data))

        graph = InProcessGraph(record, NOON * SECOND)
        for kind, given, names in (
            (GranierProbe, self.probes, {}), (MotionGenerator, {}, {'/pose': '/fix'}),
            (WheelKinematics, {}, {}), (Simulator, {}, {}),
        ):  # fmt: skip
            InProcessNode(graph, kind, given, names)
        graph.start()
        graph.run((NOON + round(self.simulated)) * SECOND)
        graph.stop()
        return self

    def moving_by_hour(self):
        """Return local hours of the recording, and whether the tree moved then."""
        stamps = np.array([seconds_of(m.header.stamp) for m in self.twists])
        moving = np.array([not resting(m.twist) for m in self.twists])
        timed = stamps > 0.0  # before the first /clock it only stands, and knows no time
        assert not moving[~timed].any()
        stamps, moving = stamps[timed], moving[timed]
        return (self.begin + (stamps - stamps[0]) * self.speed) / 3600.0 + 0.5, moving


def resting(twist):
    return hypot(twist.linear.x, twist.linear.y) == 0.0 == twist.angular.z


def moves_by_day_and_rests_by_night(hours, moving):
    night, day = (hours % 24 < 5.0), (hours % 24 > 11.0) & (hours % 24 < 17.0)
    assert moving[day].mean() > 0.7
    assert moving[night].mean() < 0.05


def test_it_moves_by_day_and_rests_by_night(springs):
    """One June, shifted by a day and by two."""
    walk = Walk(springs, '2013-06-10T00:00:00', 2.0, 110.0, offsets=(0.0, 1.0, 2.0)).live()
    moves_by_day_and_rests_by_night(*walk.moving_by_hour())
    rates = np.concatenate([message.velocity for message in walk.rates])
    assert np.isfinite(rates).all()
    assert np.abs(rates).max() <= 2.0 / 60.0 / 0.1 * (1 + 1e-12)
    assert all(isfinite(angle) for message in walk.rates for angle in message.position)
    assert not any(walk.rates[-1].velocity)


def test_the_end_of_the_heating_ends_in_rest(springs):
    """The first probe goes off in the middle of May 2012."""
    walk = Walk(springs, '2012-05-15T00:00:00', 4.0, 162.0, offsets=(0.0, 0.0, 0.0)).in_process()
    hours, moving = walk.moving_by_hour()
    off = hours > walk.begin / 3600.0 + 2 * 24.0
    assert off.any()
    assert moving[~off].any()
    assert not moving[off].any()


def test_a_gap_in_one_of_three_years_ends_in_rest(springs):
    """June 2014, the third probe, is silent from the 18th on; that of 2012 begins on the 14th."""
    walk = Walk(springs, '2012-06-16T00:00:00', 5.0, 180.0, (0.0, 365.0, 730.0)).in_process()
    hours, moving = walk.moving_by_hour()
    gap = hours > walk.begin / 3600.0 + 2.7 * 24.0
    assert gap.any()
    assert not moving[gap].any()
    whole_days = hours < walk.begin / 3600.0 + 1.75 * 24.0
    moves_by_day_and_rests_by_night(hours[whole_days], moving[whole_days])
