"""The trial of the steering planner measures what it says, and a seed is a trial."""

from __future__ import annotations

from math import pi, tau

import pytest

from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.planner import SteeringPlanner
from agv_motion.kinematics.steering.state import AtRest
from agv_motion.kinematics.turrets import Turrets
from agv_motion.planar import Twist
from agv_motion.simulation.trials.steering import SteeringTrial, Worst

AHEAD = Twist(0.2, 0.0, 0.0)


def trial(**limits):
    """Return a trial with two turrets in a row, both ahead, and brisk motors."""
    found = SteeringTrial(1)
    found.turrets = Turrets([(0.5, 0.0), (-0.5, 0.0)])
    brisk = {'max_wheel_speed': 0.5, 'wheel_acceleration': 1.0, 'steering_rate': 2.0,
             'steering_acceleration': 40.0}  # fmt: skip
    found.limits = SteeringLimits(**(brisk | limits))
    found.planner = SteeringPlanner(found.turrets, found.limits)
    found.phase, found.period = AtRest.at([0.0, 0.0]), 0.1
    return found


def test_speeding_up_by_hand():
    """A tenth of a second at 1 m/s2 are 0.1 m/s: all of the acceleration, a fifth of the speed."""
    found = trial()
    assert found.step(AHEAD, 0.1) == (0.0,) * 6  # the turrets are looked at first
    worst = found.step(AHEAD, 0.1)
    assert worst == pytest.approx((0.0, 0.0, 0.2, 1.0, 0.0, 0.0), abs=1e-9)


def test_turning_to_the_side_keeps_the_limits_of_the_turrets():
    found, worst = trial(), Worst(*[0.0] * 6)
    for _ in range(15):
        worst = worst.with_(found.step(Twist(0.0, 0.2, 0.0), 0.1))
    assert 0.5 < worst.steering_rate <= 1.0 + 1e-9
    assert 0.0 < worst.steering_acceleration <= 1.0 + 1e-9
    most = found.limits.turn_limit * tau
    assert worst.turn == pytest.approx(pi / 2 / most)


def test_the_turret_that_turns_fastest_counts():
    """About the one that stands, the other turns."""
    found = trial()
    found.turrets = Turrets([(0.5, 0.0), (0.0, 0.0)])
    found.planner = SteeringPlanner(found.turrets, found.limits)
    rates = [found.step(Twist(0.2, 0.0, 0.3), 0.1).steering_rate for _ in range(5)]
    assert 0.5 < max(rates) <= 1.0 + 1e-9


def test_the_error_is_measured_from_what_the_wheels_can_make():
    """At rest all is missing: 0.2 m/s; of 2 m/s, which they cannot, the 0.5 that they can."""
    found = trial()
    assert found.error(AHEAD) == pytest.approx(0.2)
    assert found.error(Twist(2.0, 0.0, 0.0)) == pytest.approx(0.5)
    for _ in range(10):
        found.step(Twist(2.0, 0.0, 0.0), 0.1)
    assert found.error(Twist(2.0, 0.0, 0.0)) == pytest.approx(0.0, abs=1e-9)


def test_time_to_settle_counts_beyond_speeding_up():
    """Twice 0.5 m/s at 1 m/s2 is a second, in which a quarter turn is made too."""
    assert trial().settle(AHEAD, 1e-6) == 0.0
    slow = trial(steering_rate=0.5).settle(Twist(0.0, 0.2, 0.0), 1e-6)
    assert pi - 1.0 < slow < pi + 1.0
    with pytest.raises(AssertionError, match='is not made within'):
        trial().settle(AHEAD, -1.0)


def test_a_seed_is_a_trial():
    one, other = (SteeringTrial(7).steps(60) for _ in range(2))
    assert one == other
    assert max(one[:5]) <= 1.0 + 1e-6
    assert SteeringTrial(8).limits != SteeringTrial(7).limits


def test_twists_about_a_turret_leave_it_still():
    found = SteeringTrial(3)
    for _ in range(20):
        twist = found.twist('about a turret')
        least = min(
            abs(complex(twist.vx - twist.wz * y, twist.vy + twist.wz * x))
            for x, y in found.turrets.positions
        )
        assert least <= abs(twist.wz) * 0.03 + 1e-12
    assert found.twist('zero') == (0.0, 0.0, 0.0)
