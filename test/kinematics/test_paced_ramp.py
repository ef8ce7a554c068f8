"""A ramp by the clock: even steps, whatever the times at which it is called."""

from __future__ import annotations

import pytest

from agv_motion.kinematics.paced_ramp import PacedRamp
from agv_motion.kinematics.twist_ramp import TwistRamp
from agv_motion.kinematics.wheel_limits import WheelLimits
from agv_motion.planar import REST, Twist

PERIOD = 0.1


@pytest.fixture
def paced():
    limits = WheelLimits(max_wheel_speed=10.0, max_wheel_acceleration=1.0)
    ramp = PacedRamp(TwistRamp([(1.0, 0.0, 0.0)], limits), PERIOD)
    ramp.ramp.set_target(Twist(5.0, 0.0, 0.0))
    return ramp


def test_the_first_step_is_one_period_however_long_the_rest_was(paced):
    assert paced.advance(1000.0).vx == pytest.approx(0.1)


def test_later_steps_count_as_they_are_up_to_two_periods(paced):
    paced.advance(1000.0)
    assert paced.advance(1000.15).vx == pytest.approx(0.25)
    assert paced.advance(1007.0).vx == pytest.approx(0.45)


def test_a_clock_that_goes_back_adds_nothing(paced):
    paced.advance(1000.0)
    assert paced.advance(990.0).vx == pytest.approx(0.1)
    assert paced.advance(990.1).vx == pytest.approx(0.2)


def test_after_a_stop_it_begins_from_rest_with_one_period(paced):
    for now in (0.0, 0.1, 0.2):
        paced.advance(now)
    paced.stop()
    assert paced.ramp.twist == REST
    paced.ramp.set_target(Twist(5.0, 0.0, 0.0))
    assert paced.advance(60.0).vx == pytest.approx(0.1)


def test_where_the_target_was_reached_the_next_one_begins_with_one_period(paced):
    paced.ramp.set_target(Twist(0.1, 0.0, 0.0))
    paced.advance(0.0)
    assert paced.ramp.settled
    paced.ramp.set_target(Twist(5.0, 0.0, 0.0))
    assert paced.advance(9.0).vx == pytest.approx(0.2)


def test_the_fastest_rim_is_the_greatest_of_all_whatever_its_sign():
    ramp = TwistRamp([(1.0, 0.0, -0.5), (1.0, 0.0, 0.5), (0.0, 2.0, 0.0)], WheelLimits())
    assert ramp.fastest(Twist(1.0, 0.0, 1.0)) == 1.5
    assert ramp.fastest(Twist(-1.0, 1.2, 1.0)) == 2.4
