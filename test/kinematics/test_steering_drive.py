"""The steering planner at work: time, turrets turned by hand, cables, the end of a stop."""

from __future__ import annotations

from math import cos, pi

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.steering_drive import LOST_TURRET, SteeringDrive
from agv_motion.kinematics.steering_limits import SteeringLimits
from agv_motion.kinematics.turrets import Turrets
from agv_motion.planar import REST, Twist

PAIR = Turrets([(0.5, 0.0), (-0.5, 0.0)])
LIMITS = SteeringLimits(
    max_wheel_speed=0.5, steering_rate=2.0, steering_acceleration=50.0, wheel_acceleration=2.0
)
AHEAD = Twist(0.3, 0.0, 0.0)


def drive(unwind_after=0.0):
    return SteeringDrive(PAIR, LIMITS, 0.1, unwind_after)


def steps(one, count, now=0.0):
    """Let so many periods pass; return the time after them."""
    for _ in range(count):
        now += 0.1
        assert one.step(now, 0.05)
    return now


def test_nothing_is_commanded_while_nothing_is_known_or_wanted():
    one = drive()
    assert not one.step(0.0, 0.05)
    one.want(REST)
    assert one.plan is None
    one.want(AHEAD)
    assert one.plan.angles == [0.0, 0.0]


def test_a_step_that_is_not_due_waits():
    one = drive()
    one.want(AHEAD)
    assert one.step(1.0, 0.05)
    speeds = list(one.plan.speeds)
    assert not one.step(1.04, 0.05)
    assert one.plan.speeds == speeds
    assert one.step(1.06, 0.05)
    assert one.plan.speeds > speeds


def test_after_a_gap_or_a_leap_back_one_period_counts():
    for leap in (50.0, -50.0):
        one = drive()
        one.want(AHEAD)
        now = steps(one, 1)
        before = one.plan.speeds[0]
        assert one.step(now + leap, 0.05)
        assert one.plan.speeds[0] - before <= LIMITS.wheel_acceleration * 0.1 + 1e-12


def test_a_turret_turned_by_hand_at_rest_is_taken_from_where_it_stands():
    one = drive()
    one.see([0.0, 0.0])
    now = steps(one, 2)
    one.see([0.0, LOST_TURRET - 0.01])
    now = steps(one, 1, now)
    assert one.plan.angles == [0.0, 0.0]
    one.see([0.0, LOST_TURRET + 0.01])
    steps(one, 1, now)
    assert one.plan.angles == pytest.approx([0.0, LOST_TURRET + 0.01])


def test_it_rolls_as_far_as_the_worst_turret_has_turned():
    one = drive()
    one.see([0.0, 0.0])
    assert one.share() == 1.0
    one.want(AHEAD)
    steps(one, 5)
    one.see([0.0, 1.0])
    assert one.share() == pytest.approx(cos(1.0))


def test_cables_are_unwound_when_asked_or_after_a_rest():
    for unwind_after in (0.0, 2.0):
        one = drive(unwind_after)
        one.see([pi, 0.0])
        now = steps(one, 10)
        assert one.plan.angles == [pi, 0.0]
        if not unwind_after:
            assert one.unwind() == 'unwinding, the furthest turret by 180 deg'
        for _ in range(40):
            now = steps(one, 1, now)
            one.see(list(one.plan.angles))
        assert one.plan.angles == pytest.approx([0.0, 0.0])
        assert not one.unwinding


def test_cables_are_not_unwound_while_driving_or_where_there_is_nothing_to_do():
    one = drive()
    assert one.unwind().startswith('nothing to unwind')
    one.see([pi, pi])
    one.want(AHEAD)
    with pytest.raises(ConfigurationError, match='zero cmd_vel'):
        one.unwind()


def test_a_stop_holds_the_angles_and_the_next_start_takes_them_as_they_are():
    one = drive()
    one.see([0.0, 0.0])
    one.want(Twist(0.2, 0.2, 0.0))
    steps(one, 20)
    angles = list(one.plan.angles)
    one.stop()
    assert one.plan.speeds == [0.0, 0.0]
    assert one.plan.angles == angles
    one.see([0.3, 0.3])
    one.start_anew()
    assert one.plan.angles == pytest.approx([0.3, 0.3])
