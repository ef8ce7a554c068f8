"""One step of a rolling platform. Hand calculations: 2 m/s2 in 0.1 s are 0.2 m/s."""

from __future__ import annotations

from math import pi

import pytest

from agv_motion.kinematics.steering.chassis import measure
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.rolling import roll
from agv_motion.kinematics.steering.state import AtRest, Limiter, Rolling, Stance
from agv_motion.kinematics.turrets import Turrets

PAIR = Turrets([(0.5, 0.0), (-0.5, 0.0)])
LIMITS = SteeringLimits(
    max_wheel_speed=0.5, wheel_acceleration=2.0, steering_rate=2.0, steering_acceleration=50.0
)
CHASSIS = measure(PAIR, LIMITS)
AHEAD, SPIN = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def platform(direction=AHEAD, angles=(0.0, 0.0)):
    return Rolling(AtRest.at(angles).setpoints, Stance(direction, [1.0, 1.0]))


def test_wheels_speed_up_hold_their_limit_and_brake():
    phase = platform()
    told, seen = phase.setpoints, []
    for size in (0.7, 0.7, 0.7, 0.3, 0.3, 0.0, 0.0):
        phase = roll(CHASSIS, phase, AHEAD if size else None, size, 0.1)
        seen.append((round(told.speeds[0], 9), told.limiter))
    assert seen == [
        (0.2, Limiter.WHEEL_ACCELERATION),
        (0.4, Limiter.WHEEL_ACCELERATION),
        (0.5, Limiter.WHEEL_SPEED),
        (0.3, Limiter.NONE),
        (0.3, Limiter.NONE),
        (0.1, Limiter.WHEEL_ACCELERATION),
        (0.0, Limiter.NONE),
    ]
    assert isinstance(phase, AtRest)
    assert phase.stance == Stance(AHEAD, [1.0, 1.0])
    assert phase.setpoints is told


def test_wheels_of_a_rotation_roll_against_each_other_where_one_is_reversed():
    phase = platform(SPIN, (pi / 2, pi / 2))
    phase.setpoints.signs[1] = -1.0
    phase = roll(CHASSIS, phase, SPIN, 0.1, 0.1)
    assert phase.setpoints.speeds == pytest.approx([0.1, -0.1])
    assert phase.setpoints.twist(PAIR) == pytest.approx((0.0, 0.0, 0.2), abs=1e-15)


def test_angles_follow_the_direction():
    phase = platform()
    phase.speed, phase.setpoints.speeds = 0.1, [0.1, 0.1]
    phase = roll(CHASSIS, phase, (0.8, 0.6, 0.0), 0.1, 0.05)
    told = phase.setpoints
    assert told.angles[0] == told.angles[1] > 0.0
    assert told.rates == pytest.approx([told.angles[0] / 0.05] * 2)
    assert told.rates[0] <= LIMITS.steering_rate
    for _ in range(20):
        phase = roll(CHASSIS, phase, (0.8, 0.6, 0.0), 0.1, 0.05)
    assert phase.direction == pytest.approx((0.8, 0.6, 0.0), abs=1e-12)
    assert told.rates == [0.0, 0.0]
    assert told.limiter is Limiter.NONE


def test_a_platform_that_has_to_stop_stops():
    phase = platform()
    phase.speed, phase.setpoints.speeds = 0.3, [0.3, 0.3]
    phase = roll(CHASSIS, phase, (-1.0, 0.0, 0.0), 0.3, 0.1)
    assert phase.stopping
    assert phase.setpoints.limiter is Limiter.STOPPING
    assert phase.setpoints.speeds == pytest.approx([0.1, 0.1])
    assert isinstance(roll(CHASSIS, phase, (-1.0, 0.0, 0.0), 0.3, 0.1), AtRest)


def test_at_rest_there_is_no_stance_while_a_turret_still_turns():
    phase = platform()
    phase.free_turret, phase.setpoints.rates = 1, [0.0, 1.0]
    phase.setpoints.angles = [0.0, 0.3]
    at_rest = roll(CHASSIS, phase, None, 0.0, 0.01)
    assert isinstance(at_rest, AtRest)
    assert at_rest.stance is None
    assert at_rest.setpoints.rates == [0.0, 0.5]
