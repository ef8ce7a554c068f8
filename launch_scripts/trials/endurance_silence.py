"""Inputs that are lost in every way: how long until the wheels are told to stand, at the longest.

    python launch_scripts/trials/endurance_silence.py --trials 1000

Each trial runs the nodes themselves, in simulated time, with limits, rates and phases by chance,
until the robot drives; then one of their inputs falls silent, repeats its last message or comes
with stamps that are too old or too far ahead. Exits with 1 where a wheel turns longer than the
limit of that input plus one period of its watch; behind `cmd_vel` the wheels are braked within
their limits as well.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from math import cos, inf, sin
from typing import TYPE_CHECKING, Any

import numpy as np
from geometry_msgs.msg import PoseWithCovarianceStamped, TwistStamped, Vector3Stamped
from nav_msgs.msg import Odometry, Path
from rich.progress import track
from sensor_msgs.msg import JointState

from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.nodes.arbiter import ArbiterNode
from agv_motion.nodes.differential_kinematics import DifferentialKinematics
from agv_motion.nodes.motion_generator import MotionGenerator
from agv_motion.nodes.omni_kinematics import OmniKinematics
from agv_motion.nodes.route_follower import RouteFollowerNode
from agv_motion.nodes.wheel_kinematics import WheelKinematics
from agv_motion.nodes.wheels import WheelsParameters
from agv_motion.planar import REST, Pose, Twist, integrate
from agv_motion.ros.cdr import codec
from agv_motion.ros.in_process_graph import InProcessGraph
from agv_motion.ros.in_process_node import InProcessNode
from agv_motion.ros.messages import TurretJoints, fill_path, fill_pose, stamp_of

if TYPE_CHECKING:
    from agv_motion.ros.in_process_topic import InProcessEnd

SECOND = 1_000_000_000
START = 1_434_366_000 * SECOND
WAYS = 'silence', 'repetition', 'age', 'ahead'
DRIVES = '/wheels/command', '/turrets/command'


@dataclass(frozen=True)
class Case:
    """Which nodes, which of their inputs are there, and whose loss is looked at."""

    nodes: tuple[Any, ...]
    """from the one with the input to the one with the wheels"""
    inputs: tuple[str, ...]
    lost: str
    braking: float = 0.0
    """in which wheels that are told to stand come to rest, where they are braked [s]"""
    limits: tuple[str, ...] = ('report_after', 'stop_after')
    """parameters of the first node that are the limit of the input"""


TREE = SteeringLimits()
BRAKING = TREE.max_wheel_speed / TREE.wheel_acceleration
WHEELS = WheelsParameters()
ROUTE_SPEED = 0.5
"""[m/s] of the route follower as it is by default"""
DRIVEN_SPEED = 0.3
"""[m/s] that is asked for on `cmd_vel`"""
ROUTE_BRAKING = ROUTE_SPEED / WHEELS.max_wheel_deceleration + 1.0 / WHEELS.rate
CASES = {
    'differential, cmd_vel': Case((DifferentialKinematics,), ('cmd_vel',), 'cmd_vel'),
    'differential, wheels/state': Case(
        (DifferentialKinematics,), ('cmd_vel', 'wheels/state'), 'wheels/state'
    ),
    'omni, cmd_vel': Case((OmniKinematics,), ('cmd_vel',), 'cmd_vel'),
    'turrets, cmd_vel': Case((WheelKinematics,), ('cmd_vel',), 'cmd_vel'),
    'turrets, turrets/state': Case(
        (WheelKinematics,), ('cmd_vel', 'turrets/state'), 'turrets/state'
    ),
    'route, odom': Case(
        (RouteFollowerNode, DifferentialKinematics), ('odom',), 'odom', ROUTE_BRAKING
    ),
    'dead-man, differential': Case(
        (ArbiterNode, DifferentialKinematics),
        ('cmd_vel/manual',),
        'cmd_vel/manual',
        limits=('timeouts.manual',),
    ),
    'dead-man, turrets': Case(
        (ArbiterNode, WheelKinematics),
        ('cmd_vel/manual',),
        'cmd_vel/manual',
        limits=('timeouts.manual',),
    ),
    'arbiter, agent': Case(
        (ArbiterNode, DifferentialKinematics),
        ('cmd_vel/agent',),
        'cmd_vel/agent',
        DRIVEN_SPEED / WHEELS.max_wheel_deceleration + 1.0 / WHEELS.rate,
        ('timeouts.agent',),
    ),
    'tree, sap flow': Case(
        (MotionGenerator, WheelKinematics),
        ('granier/sap_flow', 'pose'),
        'granier/sap_flow',
        BRAKING,
    ),
    'tree, pose': Case(
        (MotionGenerator, WheelKinematics), ('granier/sap_flow', 'pose'), 'pose', BRAKING
    ),
}


class Trial:
    """One loss of one input."""

    def __init__(self, case: Case, way: str, seed: int) -> None:
        """Start the nodes, with limits and rates by chance."""
        self._case, self._way, self._random = case, way, np.random.default_rng(seed)
        draw = self._random.uniform
        self.limit = draw(0.2, 2.0)
        self.max_age = draw(0.1, 3.0)
        self.moving: list[tuple[int, bool]] = []
        """when the wheels were commanded [ns], and whether to turn"""
        self._pose, self._twist, self._at = Pose(0.0, 0.0, 0.0), REST, START
        self._graph = InProcessGraph(self._record, START)
        limits = dict.fromkeys(case.limits, self.limit) | {'max_age': self.max_age}
        for i, kind in enumerate(case.nodes):
            InProcessNode(self._graph, kind, limits if i == 0 else {})
        self._graph.start()
        self._period = {name: round(draw(0.02, 0.45 * self.limit) * SECOND) for name in case.inputs}

    @property
    def bound(self) -> float:
        """Limit of the input plus one period of its watch, and the braking after a zero [s]."""
        return self.limit + min(0.1, self.limit / 4.0) + self._case.braking

    def run(self) -> float:
        """Return how long the wheels went on turning after the last good message [s]."""
        begin = START + round(self._random.uniform(8.0, 10.0) * SECOND)
        lost_at, last = begin, START
        if 'odom' in self._case.inputs:
            self._say('odom', START, START)
            self._graph.feed('/route', START, codec(Path).encode(_route()))
        due = {name: START + round(self._random.random() * p) for name, p in self._period.items()}
        repeated = START
        while True:
            name = min(due, key=lambda each: due[each])
            now = due[name]
            if now > lost_at + round((self.bound + 1.0) * SECOND):
                break
            due[name] += self._period[name]
            stamp = now
            if name == self._case.lost:
                if now < lost_at:
                    last = repeated = now
                else:
                    off = round((self.max_age + 0.01) * SECOND)
                    stamp = {'repetition': repeated, 'age': now - off, 'ahead': now + off}.get(
                        self._way, 0
                    )
            if stamp:
                self._say(name, now, stamp)
        self._graph.run(lost_at + round((self.bound + 1.0) * SECOND))
        if not any(turns for at, turns in self.moving if at <= last):
            msg = 'the robot did not drive'
            raise RuntimeError(msg)
        turning = [i for i, (_, turns) in enumerate(self.moving) if turns]
        zeros = [at for at, _ in self.moving[turning[-1] + 1 :]]
        return (zeros[0] - last) * 1e-9 if zeros else inf

    def _say(self, name: str, now: int, stamp: int) -> None:
        self._graph.run(now - 1)
        self._pose = integrate(self._pose, self._twist, (now - self._at) * 1e-9)
        self._at = now
        message = self._message(name)
        message.header.stamp = stamp_of(stamp)
        self._graph.feed(f'/{name}', now, codec(type(message)).encode(message))

    def _message(self, name: str) -> Any:
        if name.startswith('cmd_vel'):
            message = TwistStamped()
            message.twist.linear.x = DRIVEN_SPEED
            return message
        if name == 'wheels/state':
            return JointState(name=['left_wheel', 'right_wheel'], position=[0.0, 0.0])
        if name == 'turrets/state':
            joints = TurretJoints(3)
            joints.fill(state := joints.message(), [0.0] * 3, [0.0] * 3)
            return state
        if name == 'granier/sap_flow':
            flow = Vector3Stamped()
            flow.vector.x, flow.vector.y, flow.vector.z = 0.9, 0.8, 0.9
            return flow
        message = Odometry() if name == 'odom' else PoseWithCovarianceStamped()
        fill_pose(message.pose.pose, self._pose)
        return message

    def _record(self, publisher: InProcessEnd, stamp: int, data: Any) -> None:
        if publisher.topic == '/cmd_vel':
            twist = codec(TwistStamped).decode(data).twist
            self._twist = Twist(twist.linear.x, twist.linear.y, twist.angular.z)
        elif publisher.topic in DRIVES:
            self.moving.append((stamp, any(codec(JointState).decode(data).velocity)))


def _route() -> Path:
    """Return a spiral that no trial comes to the end of."""
    path = Path()
    poses = [Pose((1.0 + k) * cos(0.5 * k), (1.0 + k) * sin(0.5 * k), 0.0) for k in range(30)]
    fill_path(path, poses)
    return path


def longest(name: str, trials: int) -> tuple[float, float]:
    """Return the longest time that wheels turned on [s], and the largest excess over its bound."""
    times, excess = [], []
    for seed in range(trials):
        trial = Trial(CASES[name], WAYS[seed % len(WAYS)], seed)
        times.append(trial.run())
        excess.append(times[-1] - trial.bound)
    return max(times), max(excess)


def main() -> None:
    """Lose every input in every way."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--trials', type=int, default=1000)
    each = -(-parser.parse_args().trials // len(CASES))
    found = {name: longest(name, each) for name in track(CASES, 'Losing inputs')}
    for name, (time, excess) in found.items():
        print(
            f'{name}: {each} losses; wheels turned {time:.3f} s at most, {-excess:.3f} s to spare'
        )
    sys.exit(0 if all(excess <= 1e-6 for _, excess in found.values()) else 1)


if __name__ == '__main__':
    main()
