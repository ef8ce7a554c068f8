"""Benchmarks: ours beside a peer or the floor, in one run, as ratios of medians."""

from __future__ import annotations

import itertools
import os
import statistics
import subprocess
import sys
import time
from math import cos, pi, sin
from typing import TYPE_CHECKING, Any

import benchmark_bags
import benchmark_edits
import benchmark_odometry
import benchmark_recording
import benchmark_trajectory
import numpy as np
import rclpy
from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped, Vector3Stamped
from measure import Row, per_call, show
from rclpy.qos import qos_profile_sensor_data
from rich.progress import track
from sensor_msgs.msg import JointState
from turret_peer import LIMIT, POSITIONS, TWIST, wpilib_command
from wpimath.geometry import Rotation2d, Translation2d
from wpimath.kinematics import ChassisSpeeds, SwerveDrive3Kinematics

from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.planner import SteeringPlanner
from agv_motion.kinematics.steering.state import AtRest
from agv_motion.kinematics.turret_columns import command_columns, polar_to_cartesian
from agv_motion.kinematics.turrets import Turrets
from agv_motion.nodes.granier_probe import GranierProbe
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.planar import Twist
from agv_motion.ros.live_node import LiveNode
from agv_motion.ros.messages import TurretJoints
from agv_motion.ros.qos import COMMAND, SENSOR
from agv_motion.ros.run import EXECUTORS, overrides, start

if TYPE_CHECKING:
    from collections.abc import Callable


def turret_rows() -> list[Row]:
    """One command of three turrets, scalar and by columns, beside WPILib's kinematics."""
    tree, twist, held = Turrets(POSITIONS), Twist(*TWIST), [0.0] * 3
    n = 200_000
    rng = np.random.default_rng(1)
    v, theta, wz = rng.random(n) / 60, rng.uniform(-pi, pi, n), rng.uniform(-0.014, 0.014, n)
    columns = (*polar_to_cartesian(v, theta), wz)
    out = command_columns(tree, columns)
    batch = per_call(lambda: command_columns(tree, columns, None, LIMIT, out), calls=1)
    fresh = per_call(lambda: command_columns(tree, columns, None, LIMIT), calls=1)
    scalar = per_call(lambda: tree.command(twist, held, LIMIT))
    wpimath = per_call(wpilib_command)
    return [
        Row('turret command, 3 turrets', scalar, 'robotpy-wpimath', wpimath, '1.5 us'),
        Row('turret by columns, memory reused', batch / n / 3, 'scalar / 3', scalar / 3, '6 ns'),
        Row('turret by columns, fresh memory', fresh / n / 3, 'scalar / 3', scalar / 3),
    ]


def steering_rows() -> list[Row]:
    """One step of the steering planner, beside all that WPILib does for one command."""
    tree = Turrets(POSITIONS)
    planner, phase = SteeringPlanner(tree, SteeringLimits()), AtRest.at([0.0] * 3)
    peer = SwerveDrive3Kinematics(*(Translation2d(x, y) for x, y in POSITIONS))
    angles = [Rotation2d(0.3 * i) for i in range(3)]
    twists = [
        Twist(0.012 * cos(0.002 * k), 0.012 * sin(0.002 * k), 0.004 * sin(0.01 * k))
        for k in range(2000)
    ]
    for _ in range(400):
        phase = planner.step(phase, twists[0], 0.1)
    wandering = itertools.cycle(twists + twists[::-1])  # it rolls all the while: one phase

    def theirs() -> list[tuple[float, float]]:
        states = peer.toSwerveModuleStates(ChassisSpeeds(*next(wandering)))
        states = peer.desaturateWheelSpeeds(states, LIMIT)
        for each, angle in zip(states, angles, strict=True):
            each.optimize(angle)
        return [(each.angle.radians(), each.speed) for each in states]

    turning = per_call(lambda: planner.step(phase, next(wandering), 0.1))
    steady = Twist(0.01, 0.004, 0.003)
    for _ in range(400):
        phase = planner.step(phase, steady, 0.1)
    resting = per_call(lambda: planner.step(phase, steady, 0.1))
    wpimath = per_call(theirs)
    peer_name = 'robotpy-wpimath, no limits'
    return [
        Row('steering planner, twist wanders', turning, peer_name, wpimath, '10 us'),
        Row('steering planner, twist is made', resting, peer_name, wpimath, '10 us'),
    ]


class Chain:
    """Three nodes in a row and a sink, on one executor; what enters and when it has come out."""

    def __init__(self, executor: str, *, ours: bool) -> None:
        """Build the nodes of the package, or bare relays of the same message types."""
        self.context = rclpy.Context()
        rclpy.init(context=self.context)
        self.executor = EXECUTORS[executor](context=self.context)
        self._arrived = 0
        self._sink = self._add(rclpy.create_node('sink', context=self.context))
        self._sink.create_subscription(JointState, 'turrets/command', self._on_command, COMMAND)
        self.enter = self._package() if ours else self._relays()
        end = time.monotonic() + 1.5
        while time.monotonic() < end:
            self.executor.spin_once(timeout_sec=0.05)

    def _add(self, node: Any) -> Any:
        self.executor.add_node(node)
        return node

    def _package(self) -> Callable[[], None]:
        slow = {'report_after': 3000.0, 'stop_after': 3000.0}
        made = [
            LiveNode(kind, context=self.context, parameter_overrides=overrides(**values))
            for kind, values in (
                (GranierProbe, {'rate': 0.01, 'max_age': 1e5}),
                (MotionGenerator, {'rate': 0.1, 'rest__rest_below': 0.0, **slow}),
                (WheelKinematics, slow),
            )
        ]
        made[1].set_parameters(overrides(rest__wake_above=0.0))
        for node in made:
            start(self._add(node))
        pose = self._sink.create_publisher(PoseWithCovarianceStamped, 'pose', SENSOR)
        end = time.monotonic() + 1.0
        while time.monotonic() < end:
            pose.publish(PoseWithCovarianceStamped())
            self.executor.spin_once(timeout_sec=0.05)
        return made[0].plain.tick  # type: ignore[no-any-return]

    def _relays(self) -> Callable[[], None]:
        first, second, third = (
            self._add(rclpy.create_node(f'relay_{i}', context=self.context)) for i in range(3)
        )
        flow, twist, command = Vector3Stamped(), TwistStamped(), TurretJoints(3).message()
        TurretJoints(3).fill(command, [0.0] * 3, [0.0] * 3)
        out = third.create_publisher(JointState, 'turrets/command', COMMAND)
        third.create_subscription(TwistStamped, 'cmd_vel', lambda _: out.publish(command), COMMAND)
        middle = second.create_publisher(TwistStamped, 'cmd_vel', COMMAND)
        second.create_subscription(
            Vector3Stamped, 'granier/sap_flow', lambda _: middle.publish(twist),
            qos_profile_sensor_data,
        )  # fmt: skip
        enter = first.create_publisher(Vector3Stamped, 'granier/sap_flow', SENSOR)
        return lambda: enter.publish(flow)

    def _on_command(self, _: JointState) -> None:
        self._arrived = time.perf_counter_ns()

    def passage(self) -> float:
        """Return the time of one passage through all three nodes [s]."""
        self._arrived = 0
        begin = time.perf_counter_ns()
        self.enter()
        while not self._arrived:
            self.executor.spin_once(timeout_sec=0.05)
        return (self._arrived - begin) * 1e-9


def chain_rows() -> list[Row]:
    """Our three nodes beside three bare relays, passage by passage in turn."""
    rows = []
    for executor in EXECUTORS:
        ours, relays = Chain(executor, ours=True), Chain(executor, ours=False)
        pairs = [(ours.passage(), relays.passage()) for _ in range(3000)][500:]
        mine, floor = (statistics.median(column) for column in zip(*pairs, strict=True))
        rows.append(Row(f'probe to turrets, {executor}', mine, 'three relays', floor, 'ratio 1.15'))
        for chain in (ours, relays):
            rclpy.try_shutdown(context=chain.context)
    return rows


def process_rows() -> list[Row]:
    """Start to first command, and idle load, of the four nodes in one process at 10 Hz."""
    code = (
        'import time; begin = time.perf_counter()\n'
        'from pathlib import Path; import tempfile\n'
        'from agv_motion.demo.frame import Demo\n'
        'from agv_motion.demo.tree import TreeScenario\n'
        'folder = Path(tempfile.mkdtemp()) / "bag"\n'
        'with Demo(TreeScenario(20.0, {}, "", 1, 1.0), folder) as demo:\n'
        '    load = demo.idle(20.0)\n'
        'print(demo.recorder.arrivals["turrets/command"][0] * 1e-9 - begin, load)\n'
    )
    answer = subprocess.run(  # noqa: S603 - our own interpreter
        [sys.executable, '-c', code], capture_output=True, text=True, check=True
    )
    first, load = map(float, answer.stdout.split()[-2:])
    return [
        Row('start to first turret command', first, target='2 s'),
        Row('idle load of the process, share of a core', load, target='0.05', plain=True),
    ]


def main() -> None:
    """Measure everything and print one table."""
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    sections = (
        turret_rows, steering_rows, benchmark_odometry.rows, benchmark_trajectory.rows, chain_rows,
        process_rows, benchmark_recording.rows, benchmark_bags.rows, benchmark_edits.rows,
    )  # fmt: skip
    show([row for section in track(sections, 'Measuring') for row in section()])


if __name__ == '__main__':
    main()
