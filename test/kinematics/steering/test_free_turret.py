"""A turret at the centre of rotation turns alone. Hand calculations: 4 rad/s2 in 0.1 s."""

from __future__ import annotations

from math import pi

import pytest

from agv_motion.kinematics.steering.free_turret import brake_free_turret, turn_free_turrets
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.state import AtRest, Rolling, Stance

LIMITS = SteeringLimits(steering_rate=2.0, steering_acceleration=4.0, turn_limit=1.5)


def platform(angle=0.0, rate=0.0):
    rest = AtRest.at([0.7, angle])
    rest.setpoints.rates[1] = rate
    return Rolling(rest.setpoints, Stance((0.0, 0.0, 1.0), [2.0, 0.0]))


def turn(rolling, line):
    return turn_free_turrets(rolling, LIMITS, [(1, line)], 0.1)


@pytest.mark.parametrize(
    ('line', 'rate', 'sign'),
    [(1.0, 0.4, 1.0), (-1.0, -0.4, 1.0), (pi - 0.5, -0.4, -1.0), (0.5 - pi, 0.4, -1.0)],
)
def test_it_turns_the_shorter_way_to_its_line(line, rate, sign):
    rolling = platform()
    assert not turn(rolling, line)
    assert rolling.setpoints.angles == pytest.approx([0.7, 0.1 * rate])
    assert rolling.setpoints.rates == pytest.approx([0.0, rate])
    assert rolling.setpoints.signs == [1.0, sign]
    assert rolling.free_turret == 1
    assert rolling.stance is None


@pytest.mark.parametrize(('angle', 'way'), [(9.3, -1.0), (-9.3, 1.0)])
def test_its_cables_hold(angle, way):
    """Half a radian on is beyond one and a half turns: it goes back instead, and is reversed."""
    rolling = platform(angle)
    assert not turn(rolling, angle - 0.5 * way)
    assert rolling.setpoints.angles[1] == pytest.approx(angle + 0.04 * way)
    assert rolling.setpoints.signs[1] == -1.0


@pytest.mark.parametrize(
    ('rate', 'done'), [(0.0, True), (0.19, True), (-0.19, True), (0.21, False)]
)
def test_it_is_there_when_it_stands_along_the_line_and_could_stop(rate, done):
    rolling = platform(0.5, rate)
    assert turn(rolling, 0.5) == turn(platform(0.5, rate), 0.5 - pi) == done
    assert rolling.free_turret == (None if done else 1)


def test_all_of_them_must_be_there():
    rolling = platform(0.5)
    assert not turn_free_turrets(rolling, LIMITS, [(0, 0.0), (1, 0.5)], 0.1)


def test_it_waits_while_the_direction_turns():
    rolling = platform()
    rolling.velocity = (0.1, 0.0, 0.0)
    assert not turn(rolling, 1.0)
    assert rolling.setpoints.angles == [0.7, 0.0]


def test_it_holds_its_fastest_rate():
    rolling = platform(0.0, 1.9)
    assert not turn(rolling, 1.5)
    assert rolling.setpoints.rates[1] == pytest.approx(2.0)


def test_it_brakes_where_it_is_not_needed_any_more():
    rolling = platform(0.0, 0.7)
    rolling.free_turret = 1
    brake_free_turret(rolling, LIMITS, 0.1)
    assert rolling.setpoints.rates[1] == pytest.approx(0.3)
    assert rolling.setpoints.angles[1] == pytest.approx(0.03)
    assert rolling.free_turret == 1
    brake_free_turret(rolling, LIMITS, 0.1)
    assert rolling.setpoints.rates[1] == 0.0
    assert rolling.free_turret is None
