"""The steering planner: one ICR at every step, no limit exceeded, and the wanted twist is made."""

from __future__ import annotations

from itertools import pairwise
from math import cos, inf, nan, pi, sin, tau

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.kinematics.steering.limits import SteeringLimits
from agv_motion.kinematics.steering.planner import SteeringPlanner
from agv_motion.kinematics.steering.state import AtRest, Limiter, Rolling
from agv_motion.kinematics.turrets import Turrets, centre_of_rotation
from agv_motion.planar import REST, Twist
from agv_motion.simulation.trials.steering import SteeringTrial

TREE = Turrets([(1.18 * cos(a), 1.18 * sin(a)) for a in (-pi / 4, pi / 4, pi)])
LIMITS = SteeringLimits()
FORWARD, LEFT, SPIN = Twist(0.01, 0.0, 0.0), Twist(0.0, 0.01, 0.0), Twist(0.0, 0.0, 0.01)


class Platform:
    """A platform under way, step by step; its set points by name."""

    def __init__(self, angles=(0.0, 0.0, 0.0), turrets=TREE, limits=LIMITS):
        self.turrets, self.planner = turrets, SteeringPlanner(turrets, limits)
        self.phase = AtRest.at(angles)

    def __getattr__(self, name):
        """Return a set point."""
        return getattr(self.phase.setpoints, name)

    @property
    def made(self):
        return self.phase.setpoints.twist(self.turrets)

    def step(self, twist, period=0.1):
        self.phase = self.planner.step(self.phase, twist, period)

    def drive(self, twist, seconds, watch=lambda _: None):
        for _ in range(round(seconds / 0.1)):
            self.step(twist)
            watch(self)
        return self


def close(twist):
    return pytest.approx(tuple(twist), abs=1e-12)


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
    tree, time = Platform(), 0.0
    while not any(tree.speeds):
        assert isinstance(tree.phase, AtRest)
        tree.step(LEFT)
        time += 0.1
        assert tree.limiter is Limiter.ALIGNING or any(tree.speeds)
    assert isinstance(tree.phase, Rolling)
    assert 6.2 < time < 7.0
    assert tree.angles == pytest.approx([pi / 2] * 3)


def test_the_wanted_twist_is_made_and_named_free_of_limits():
    tree = Platform().drive(Twist(0.008, 0.004, 0.003), 30.0)
    assert tree.made == close((0.008, 0.004, 0.003))
    assert tree.limiter is Limiter.NONE


def test_a_platform_turns_aside_while_it_rolls():
    """Forward to left-forward: the wheels never stop, and all share one ICR."""
    tree, slowest = Platform().drive(FORWARD, 5.0), []
    tree.drive(Twist(0.007, 0.007, 0.0), 10.0, lambda now: slowest.append(min(now.speeds)))
    assert min(slowest) > 0.006
    assert tree.made == close((0.007, 0.007, 0.0))


def test_opposite_motion_reverses_the_wheels_and_turns_no_turret():
    tree = Platform().drive(FORWARD, 5.0)
    before = list(tree.angles)
    tree.drive(Twist(-0.01, 0.0, 0.0), 5.0)
    assert tree.angles == before
    assert tree.speeds == pytest.approx([-0.01] * 3)


def test_reversal_is_decided_for_the_whole_platform():
    """All wheels stop before any is reversed: at no step do two roll against each other."""
    tree, signs = Platform().drive(FORWARD, 5.0), []
    tree.drive(
        Twist(-0.008, 0.003, 0.0), 20.0, lambda now: signs.append({s > 0 for s in now.speeds if s})
    )
    assert all(len(kinds) <= 1 for kinds in signs)
    assert signs[0] == {True}
    assert signs[-1] == {False}


@pytest.mark.parametrize(('most', 'speed'), [(2 * pi / 3, 0.01), (pi / 2, -0.01)])
def test_the_reversal_angle_is_a_parameter(most, speed):
    """110 degrees: forwards where the original installation's 2 pi / 3 does, else back."""
    heading = 110.0 * pi / 180.0
    tree = Platform(limits=SteeringLimits(reversal_angle=most))
    tree.drive(Twist(0.01 * cos(heading), 0.01 * sin(heading), 0.0), 15.0)
    assert tree.speeds == pytest.approx([speed] * 3)


def test_noise_does_not_toggle_a_reversal():
    """Around a quarter turn, noise of a few degrees makes one decision, not many."""
    tree, stops = Platform().drive(FORWARD, 5.0), []
    for k in range(600):
        heading = pi / 2 + 0.05 * sin(7.0 * k)
        tree.step(Twist(0.01 * cos(heading), 0.01 * sin(heading), 0.0))
        stops.append(isinstance(tree.phase, AtRest))
    changes = sum(a != b for a, b in pairwise(stops))
    assert changes <= 2
    assert not stops[-1]


def test_the_centre_of_rotation_may_pass_through_a_turret():
    """Driving, the ICR goes from one side of turret 2 to the other; the platform does not stop."""
    x, y = TREE.positions[2]

    def about(off):
        return Twist(0.01 * (y + off), -0.01 * x, 0.01)

    tree = Platform().drive(about(-0.3), 30.0)
    for off in (0.0, 0.3):
        tree.drive(about(off), 60.0)
        assert centre_of_rotation(tree.made) == pytest.approx((x, y + off), abs=1e-5)


def test_a_pivot_about_a_turret_from_rest_leaves_that_turret_alone():
    x, y = TREE.positions[2]
    tree = Platform([0.3, 0.3, 0.3]).drive(Twist(0.01 * y, -0.01 * x, 0.01), 20.0)
    assert tree.angles[2] == pytest.approx(0.3)
    assert tree.speeds[2] == pytest.approx(0.0, abs=1e-12)
    assert tree.speeds[0] != 0.0


def test_a_stop_is_smooth_and_holds_the_angles():
    tree = Platform().drive(Twist(0.01, 0.01, 0.0), 20.0)
    held = list(tree.angles)
    tree.drive(REST, 1.0)
    assert isinstance(tree.phase, AtRest)
    assert tree.speeds == [0.0] * 3
    assert tree.angles == held


def test_an_emergency_stop_is_at_once():
    tree = Platform().drive(FORWARD, 5.0)
    tree.phase = tree.planner.stop(tree.phase)
    assert isinstance(tree.phase, AtRest)
    assert tree.speeds == [0.0] * 3
    tree.drive(FORWARD, 5.0)
    assert tree.made == close((0.01, 0.0, 0.0))


def test_turns_are_counted_and_the_cables_hold():
    """A heading that goes round and round for ever is followed within one and a half turns."""
    tree, most, done = Platform(), 0.0, 0
    for k in range(20000):
        heading = 0.01 * k
        tree.step(Twist(0.01 * cos(heading), 0.01 * sin(heading), 0.0))
        most = max(most, *map(abs, tree.angles))
        done += isinstance(tree.phase, Rolling) and tree.phase.speed > 0.005
    assert 0.75 * tau < most <= 1.5 * tau
    assert done > 13000


def test_unwinding_turns_each_turret_to_the_nearest_angle_along_its_line():
    tree = Platform([6.4, -3.0, 0.4])
    while not tree.planner.unwind(tree.phase, 0.1):
        assert tree.limiter is Limiter.UNWINDING
    assert tree.angles == pytest.approx([6.4 - tau, -3.0 + pi, 0.4])
    tree.drive(FORWARD, 10.0)
    assert tree.made == close((0.01, 0.0, 0.0))


def test_a_rolling_platform_is_not_unwound():
    tree = Platform().drive(FORWARD, 5.0)
    with pytest.raises(SignalError, match='stop it before unwinding'):
        tree.planner.unwind(tree.phase, 0.1)


def test_between_two_translations_the_platform_never_rotates():
    """So a delicate floor, where only translation is allowed, is safe while the turrets steer."""
    tree, rotations = Platform().drive(FORWARD, 5.0), []
    tree.drive(Twist(0.006, 0.008, 0.0), 15.0, lambda now: rotations.append(now.made.wz))
    assert max(map(abs, rotations)) < 1e-15


def test_a_twist_above_the_limit_is_scaled_and_its_icr_stays():
    wanted = Twist(0.05, 0.02, 0.03)
    tree = Platform().drive(wanted, 40.0)
    assert max(map(abs, tree.speeds)) == pytest.approx(LIMITS.max_wheel_speed)
    assert centre_of_rotation(tree.made) == pytest.approx(centre_of_rotation(wanted))
    assert tree.limiter is Limiter.WHEEL_SPEED


def test_any_number_of_turrets_anywhere_even_in_the_centre():
    five = Turrets([(0.0, 0.0), (0.5, 0.1), (0.5, 0.1), (-2.0, 1.0), (0.3, -0.7)])
    wanted = Twist(0.004, -0.002, 0.006)
    assert Platform([0.0] * 5, five).drive(wanted, 30.0).made == close(wanted)


@pytest.mark.parametrize('bad', [nan, inf, -inf])
def test_what_is_not_finite_is_refused_and_nothing_changes(bad):
    tree = Platform().drive(FORWARD, 3.0)
    before = list(tree.angles), list(tree.speeds), tree.phase, tree.phase.direction
    with pytest.raises(SignalError, match='must be finite'):
        tree.step(Twist(bad, 0.0, 0.0))
    assert (tree.angles, tree.speeds, tree.phase, tree.phase.direction) == before
    with pytest.raises(SignalError, match='must be finite'):
        AtRest.at([0.0, bad, 0.0])


@pytest.mark.parametrize('period', [0.0, -0.1, nan, inf])
def test_a_period_must_be_positive(period):
    with pytest.raises(SignalError, match='must be positive and finite'):
        Platform().step(FORWARD, period)


def test_the_state_of_another_platform_is_refused():
    with pytest.raises(SignalError, match='a state of 2 turrets for 3'):
        Platform([0.0] * 2).step(FORWARD)


@pytest.mark.parametrize('twist', [(1e200, 0, 0), (0, -1e160, 0), (0, 0, 1e300), (1e308, 1e308, 0)])
def test_a_twist_beyond_any_robot_is_refused(twist):
    """It made the platform stand without an end, as if its turrets were turning."""
    planner = SteeringPlanner(Turrets([(0.5, 0.0), (-0.5, 0.0)]), SteeringLimits())
    with pytest.raises(SignalError, match='at most 1000 m/s and rad/s; look at the units'):
        planner.step(AtRest.at([0.0, 0.0]), Twist(*twist), 0.05)


def test_out_of_straight_ahead_no_wheel_is_too_fast_for_a_step():
    """All wheels are at their limit; about the first, the far one would gain 15 % in one step."""
    turrets = Turrets([(0.0, 0.0), (5.5, 0.0), (1.0, 0.0)])
    limits = SteeringLimits(
        max_wheel_speed=0.4, wheel_acceleration=0.1, steering_rate=6.0, steering_acceleration=600.0
    )
    planner, phase = SteeringPlanner(turrets, limits), AtRest.at([0.0] * 3)
    while max(phase.setpoints.speeds) < 0.4:
        phase = planner.step(phase, Twist(0.4, 0.0, 0.0), 0.1)
    for _ in range(200):
        before = list(phase.setpoints.speeds)
        phase = planner.step(phase, Twist(0.0, 0.0, 0.07), 0.1)
        speeds = phase.setpoints.speeds
        assert max(map(abs, speeds)) <= 0.4 + 1e-9
        changes = [abs(now - last) for now, last in zip(speeds, before, strict=True)]
        assert max(changes) <= 0.1 * 0.1 + 1e-9
    assert phase.setpoints.twist(turrets) == pytest.approx((0.0, 0.0, 0.07), abs=1e-6)
