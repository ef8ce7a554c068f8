"""The steering planner: one ICR at every step, no limit exceeded, and the wanted twist is made."""

from __future__ import annotations

from itertools import pairwise
from math import cos, inf, nan, pi, sin, tau

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.kinematics.steering import SteeringPlanner
from agv_motion.kinematics.steering_limits import SteeringLimits
from agv_motion.kinematics.steering_rest import braking_rate
from agv_motion.kinematics.steering_state import Limiter, SteeringState
from agv_motion.kinematics.turrets import Turrets, centre_of_rotation
from agv_motion.planar import REST, Twist
from agv_motion.simulation.steering_trial import SteeringTrial

TREE = Turrets([(1.18 * cos(a), 1.18 * sin(a)) for a in (-pi / 4, pi / 4, pi)])
LIMITS = SteeringLimits()
FORWARD, LEFT, SPIN = Twist(0.01, 0.0, 0.0), Twist(0.0, 0.01, 0.0), Twist(0.0, 0.0, 0.01)


def drive(state, twist, seconds, planner=None, watch=lambda: None):
    planner = planner or SteeringPlanner(TREE, LIMITS)
    for _ in range(round(seconds / 0.1)):
        planner.step(state, twist, 0.1)
        watch()
    return state


def made(state, turrets=TREE):
    return pytest.approx(tuple(state.twist(turrets)), abs=1e-12)


@settings(max_examples=60)
@given(st.integers(0, 10**6))
def test_laws_of_a_random_run(seed):
    """Every limit holds at every step, all axes meet, and what is then asked for is made."""
    trial = SteeringTrial(seed)
    worst = trial.steps(250)
    rounding = 1.0 + 1e-7
    assert worst.steering_rate <= rounding
    assert worst.steering_acceleration <= rounding
    assert worst.wheel_speed <= rounding
    assert worst.wheel_acceleration <= rounding
    assert worst.turn <= rounding
    assert worst.residual < 1e-9
    wanted = trial.twist(trial.random.choice(['steady', 'steady', 'about a turret']))
    trial.settle(wanted, 1e-6 * trial.limits.max_wheel_speed)


def test_from_rest_the_turrets_turn_first_and_no_wheel_rolls():
    """Hand calculation: a quarter turn at a quarter turn in 6 s, and 0.26 s more to speed up."""
    state = SteeringState([0.0] * 3)
    planner, time = SteeringPlanner(TREE, LIMITS), 0.0
    while not any(state.speeds):
        planner.step(state, LEFT, 0.1)
        time += 0.1
        assert state.limiter is Limiter.ALIGNING or any(state.speeds)
    assert 6.2 < time < 7.0
    assert state.angles == pytest.approx([pi / 2] * 3)


def test_the_wanted_twist_is_made_and_named_free_of_limits():
    state = drive(SteeringState([0.0] * 3), Twist(0.008, 0.004, 0.003), 30.0)
    assert made(state) == (0.008, 0.004, 0.003)
    assert state.limiter is Limiter.NONE


def test_a_platform_turns_aside_while_it_rolls():
    """Forward to left-forward: the wheels never stop, and all share one ICR."""
    state = drive(SteeringState([0.0] * 3), FORWARD, 5.0)
    slowest = []
    drive(state, Twist(0.007, 0.007, 0.0), 10.0, watch=lambda: slowest.append(min(state.speeds)))
    assert min(slowest) > 0.006
    assert made(state) == (0.007, 0.007, 0.0)


def test_opposite_motion_reverses_the_wheels_and_turns_no_turret():
    state = drive(SteeringState([0.0] * 3), FORWARD, 5.0)
    before = list(state.angles)
    drive(state, Twist(-0.01, 0.0, 0.0), 5.0)
    assert state.angles == before
    assert state.speeds == pytest.approx([-0.01] * 3)


def test_reversal_is_decided_for_the_whole_platform():
    """All wheels stop before any is reversed: at no step do two roll against each other."""
    state = drive(SteeringState([0.0] * 3), FORWARD, 5.0)
    signs = []
    drive(
        state,
        Twist(-0.008, 0.003, 0.0),
        20.0,
        watch=lambda: signs.append({s > 0 for s in state.speeds if s}),
    )
    assert all(len(kinds) <= 1 for kinds in signs)
    assert signs[0] == {True}
    assert signs[-1] == {False}


@pytest.mark.parametrize(('most', 'speed'), [(2 * pi / 3, 0.01), (pi / 2, -0.01)])
def test_the_reversal_angle_is_a_parameter(most, speed):
    """110 degrees: forwards where the ancestor's 2 pi / 3 allows it, else 70 degrees backwards."""
    planner = SteeringPlanner(TREE, SteeringLimits(reversal_angle=most))
    heading = 110.0 * pi / 180.0
    state = drive(
        SteeringState([0.0] * 3),
        Twist(0.01 * cos(heading), 0.01 * sin(heading), 0.0),
        15.0,
        planner,
    )
    assert state.speeds == pytest.approx([speed] * 3)


def test_noise_does_not_toggle_a_reversal():
    """Around a quarter turn, noise of a few degrees makes one decision, not many."""
    state, stops = drive(SteeringState([0.0] * 3), FORWARD, 5.0), []
    planner = SteeringPlanner(TREE, LIMITS)
    for k in range(600):
        heading = pi / 2 + 0.05 * sin(7.0 * k)
        planner.step(state, Twist(0.01 * cos(heading), 0.01 * sin(heading), 0.0), 0.1)
        stops.append(state.speed == 0.0)
    changes = sum(a != b for a, b in pairwise(stops))
    assert changes <= 2
    assert not stops[-1]


def test_the_centre_of_rotation_may_pass_through_a_turret():
    """Driving, the ICR goes from one side of turret 2 to the other; the platform does not stop."""
    x, y = TREE.positions[2]

    def about(off):
        return Twist(0.01 * (y + off), -0.01 * x, 0.01)

    planner = SteeringPlanner(TREE, LIMITS)
    state = drive(SteeringState([0.0] * 3), about(-0.3), 30.0, planner)
    for off in (0.0, 0.3):
        drive(state, about(off), 60.0, planner)
        centre = centre_of_rotation(state.twist(TREE))
        assert centre == pytest.approx((x, y + off), abs=1e-5)


def test_a_pivot_about_a_turret_from_rest_leaves_that_turret_alone():
    x, y = TREE.positions[2]
    state = drive(SteeringState([0.3, 0.3, 0.3]), Twist(0.01 * y, -0.01 * x, 0.01), 20.0)
    assert state.angles[2] == pytest.approx(0.3)
    assert state.speeds[2] == pytest.approx(0.0, abs=1e-12)
    assert state.speeds[0] != 0.0


def test_a_stop_is_smooth_and_holds_the_angles():
    state = drive(SteeringState([0.0] * 3), Twist(0.01, 0.01, 0.0), 20.0)
    held = list(state.angles)
    drive(state, REST, 1.0)
    assert state.speeds == [0.0] * 3
    assert state.angles == held


def test_an_emergency_stop_is_at_once():
    planner, state = SteeringPlanner(TREE, LIMITS), drive(SteeringState([0.0] * 3), FORWARD, 5.0)
    planner.stop(state)
    assert state.speeds == [0.0] * 3
    drive(state, FORWARD, 5.0)
    assert made(state) == (0.01, 0.0, 0.0)


def test_turns_are_counted_and_the_cables_hold():
    """A heading that goes round and round for ever is followed within one and a half turns."""
    planner, state, most, done = SteeringPlanner(TREE, LIMITS), SteeringState([0.0] * 3), 0.0, 0
    for k in range(20000):
        heading = 0.01 * k
        planner.step(state, Twist(0.01 * cos(heading), 0.01 * sin(heading), 0.0), 0.1)
        most = max(most, *map(abs, state.angles))
        done += state.speed > 0.005
    assert 0.75 * tau < most <= 1.5 * tau
    assert done > 13000


def test_unwinding_turns_each_turret_to_the_nearest_angle_along_its_line():
    planner, state = SteeringPlanner(TREE, LIMITS), SteeringState([6.4, -3.0, 0.4])
    while not planner.unwind(state, 0.1):
        assert state.limiter is Limiter.UNWINDING
    assert state.angles == pytest.approx([6.4 - tau, -3.0 + pi, 0.4])
    drive(state, FORWARD, 10.0)
    assert made(state) == (0.01, 0.0, 0.0)


def test_a_rolling_platform_is_not_unwound():
    state = drive(SteeringState([0.0] * 3), FORWARD, 5.0)
    with pytest.raises(SignalError, match='stop it before unwinding'):
        SteeringPlanner(TREE, LIMITS).unwind(state, 0.1)


def test_between_two_translations_the_platform_never_rotates():
    """So a delicate floor, where only translation is allowed, is safe while the turrets steer."""
    state = drive(SteeringState([0.0] * 3), FORWARD, 5.0)
    rotations = []
    drive(
        state, Twist(0.006, 0.008, 0.0), 15.0, watch=lambda: rotations.append(state.twist(TREE).wz)
    )
    assert max(map(abs, rotations)) < 1e-15


def test_a_twist_above_the_limit_is_scaled_and_its_icr_stays():
    wanted = Twist(0.05, 0.02, 0.03)
    state = drive(SteeringState([0.0] * 3), wanted, 40.0)
    assert max(map(abs, state.speeds)) == pytest.approx(LIMITS.max_wheel_speed)
    assert centre_of_rotation(state.twist(TREE)) == pytest.approx(centre_of_rotation(wanted))
    assert state.limiter is Limiter.WHEEL_SPEED


def test_any_number_of_turrets_anywhere_even_in_the_centre():
    platform = Turrets([(0.0, 0.0), (0.5, 0.1), (0.5, 0.1), (-2.0, 1.0), (0.3, -0.7)])
    planner, wanted = SteeringPlanner(platform, LIMITS), Twist(0.004, -0.002, 0.006)
    state = drive(SteeringState([0.0] * 5), wanted, 30.0, planner)
    assert tuple(wanted) == made(state, platform)


@pytest.mark.parametrize('bad', [nan, inf, -inf])
def test_what_is_not_finite_is_refused_and_nothing_changes(bad):
    state = drive(SteeringState([0.0] * 3), FORWARD, 3.0)
    before = list(state.angles), list(state.speeds), state.direction
    with pytest.raises(SignalError, match='must be finite'):
        SteeringPlanner(TREE, LIMITS).step(state, Twist(bad, 0.0, 0.0), 0.1)
    assert (state.angles, state.speeds, state.direction) == before
    with pytest.raises(SignalError, match='must be finite'):
        SteeringState([0.0, bad, 0.0])


@pytest.mark.parametrize('period', [0.0, -0.1, nan, inf])
def test_a_period_must_be_positive(period):
    with pytest.raises(SignalError, match='must be positive and finite'):
        SteeringPlanner(TREE, LIMITS).step(SteeringState([0.0] * 3), FORWARD, period)


def test_the_state_of_another_platform_is_refused():
    with pytest.raises(SignalError, match='a state of 2 turrets for 3'):
        SteeringPlanner(TREE, LIMITS).step(SteeringState([0.0] * 2), FORWARD, 0.1)


def test_limits_are_checked():
    with pytest.raises(ConfigurationError, match=r'turn_limit = 0\.2'):
        SteeringLimits(turn_limit=0.2)
    with pytest.raises(ConfigurationError, match='steering_rate = nan'):
        SteeringLimits(steering_rate=nan)


@given(st.floats(0.0, 10.0), st.floats(0.01, 100.0), st.floats(0.001, 1.0))
def test_a_braking_rate_stops_in_time(distance, acceleration, period):
    """Step by step, each rate lower by what the acceleration allows: never past the mark."""
    rate, way = braking_rate(distance, acceleration, period), 0.0
    for _ in range(10000):
        way += rate * period
        rate = max(rate - acceleration * period, 0.0)
        if not rate:
            break
    assert way <= distance * (1.0 + 1e-9) + acceleration * period**2 / 8.0
