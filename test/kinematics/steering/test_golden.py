"""Runs of the planner as they were: every set point now and then, to nine digits.

A run that changes on purpose is written anew, and its change told, by

    python test/kinematics/steering/test_golden.py
"""

from __future__ import annotations

import json
import random
from math import cos, pi, sin
from pathlib import Path

import pytest

from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.planner import SteeringPlanner
from agv_motion.kinematics.steering.state import AtRest
from agv_motion.kinematics.turrets import Turrets
from agv_motion.planar import REST, Twist

FILE = Path(__file__).with_name('golden.json')
TREE = Turrets([(1.18 * cos(a), 1.18 * sin(a)) for a in (-pi / 4, pi / 4, pi)])
PAIR = Turrets([(0.5, 0.1), (-0.5, 0.0)])
FIVE = Turrets([(0.0, 0.0), (0.5, 0.1), (0.5, 0.1), (-2.0, 1.0), (0.3, -0.7)])
BRISK = SteeringLimits(
    max_wheel_speed=0.5, steering_rate=2.0, steering_acceleration=20.0, wheel_acceleration=2.0,
    turn_limit=0.6, reversal_angle=2.0,
)  # fmt: skip
SLUGGISH = SteeringLimits(
    max_wheel_speed=0.5, steering_rate=1.0, steering_acceleration=0.4, wheel_acceleration=0.1
)
WEAK = SteeringLimits(
    max_wheel_speed=0.4, steering_rate=3.0, steering_acceleration=9.0, wheel_acceleration=0.3
)
PLATFORMS = {
    'tree': (TREE, SteeringLimits(), 0.1, 4),
    'pair, brisk': (PAIR, BRISK, 0.05, 1),
    'five, sluggish': (FIVE, SLUGGISH, 0.1, 3),
    'tree, weak wheels': (TREE, WEAK, 0.02, 3),
}
"""Each with its limits, the period of its steps [s], and how many times longer it takes."""


def commands(turrets, top, longer, draw):
    """Yield what is asked for, step by step: a twist, or a word."""
    for _ in range(24):
        kind = draw.choice(
            ['any', 'any', 'turn', 'about', 'past', 'back', 'noisy', 'rest', 'stop', 'unwind']
        )
        size, heading = draw.uniform(0.2, 1.2) * top, draw.uniform(-pi, pi)
        twist = Twist(size * cos(heading), size * sin(heading), draw.uniform(-0.5, 0.5) * size)
        x, y = draw.choice(turrets.positions)
        for step in range(longer * draw.randrange(10, 70)):
            k = step / longer
            if kind == 'turn':
                yield Twist(twist.vx, twist.vy * cos(0.03 * k), twist.wz + 0.01 * top * k)
            elif kind in {'about', 'past'}:
                off = 0.0 if kind == 'about' else 0.1 * size / top - 0.005 * k
                yield Twist(size * (y + off), -size * x, size)
            elif kind == 'back':
                yield Twist(-twist.vx, -twist.vy, twist.wz * (1 if k > 20 else -1))
            elif kind == 'noisy':
                yield Twist(twist.vx * draw.uniform(0.8, 1.2), twist.vy, twist.wz)
            elif kind == 'any':
                yield twist
            else:
                yield kind if kind == 'unwind' or step == 0 else REST


def run(name):
    """Return rows of the limiter, the angles [rad] and the speeds [m/s], every so many steps."""
    turrets, limits, period, longer = PLATFORMS[name]
    draw = random.Random(name)  # noqa: S311 - no secret
    planner, rows = SteeringPlanner(turrets, limits), []
    phase = AtRest.at([draw.uniform(-3.0, 3.0) for _ in range(len(turrets))])
    wanted = commands(turrets, limits.max_wheel_speed, longer, draw)
    for number, now in enumerate(wanted):
        step = period * draw.uniform(0.7, 1.4)
        if now == 'stop':
            phase = planner.stop(phase)
        elif now == 'unwind' and isinstance(phase, AtRest):
            planner.unwind(phase, step)
        else:
            phase = planner.step(phase, now if isinstance(now, Twist) else REST, step)
        if number % (10 * longer) == 0:
            told = phase.setpoints
            numbers = (float(f'{value:.10g}') for value in (*told.angles, *told.speeds))
            rows.append([told.limiter.name, *numbers])
    return rows


@pytest.mark.parametrize('name', PLATFORMS)
def test_the_run_is_as_it_was(name):
    for number, (row, before) in enumerate(
        zip(run(name), json.loads(FILE.read_text())[name], strict=True)
    ):
        assert row[0] == before[0], f'sample {number}'
        assert row[1:] == pytest.approx(before[1:], rel=1e-8, abs=1e-9), f'sample {number}'


if __name__ == '__main__':
    runs = ',\n'.join(
        f'"{name}": [\n' + ',\n'.join(map(json.dumps, run(name))) + '\n]' for name in PLATFORMS
    )
    FILE.write_text('{' + runs + '}\n')
