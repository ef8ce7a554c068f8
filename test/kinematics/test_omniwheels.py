"""Omnidirectional wheels: the seed's formulas, both maps inverse to each other, slip, refusals."""

from __future__ import annotations

from math import cos, inf, nan, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from agv_motion.errors import GeometryError, SignalError
from agv_motion.kinematics.omniwheel_placement import OmniWheel, mecanum_wheels, wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.planar import Twist

SEED_ANGLES = (pi / 6, 5 * pi / 6, 3 * pi / 2)
SPEED = st.floats(-3.0, 3.0)
TWISTS = st.builds(Twist, SPEED, SPEED, SPEED)
ANGLE = st.floats(-pi, pi)
WHEEL = st.builds(
    OmniWheel, SPEED, SPEED, ANGLE, st.floats(0.3, pi - 0.3) | st.floats(0.3 - pi, -0.3)
)


@st.composite
def bases(draw, least=3):
    """Three to six wheels of any kind anywhere, far enough from a singular placement."""
    wheels = draw(st.lists(WHEEL, min_size=least, max_size=6))
    try:
        base = OmniWheels(wheels)
    except GeometryError:
        assume(False)  # noqa: FBT003
    values = np.linalg.svd(base.matrix, compute_uv=False)
    assume(values[-1] > 0.05 * values[0])
    return base


@given(st.tuples(SPEED, SPEED, SPEED), st.floats(0.05, 2.0))
def test_the_three_wheels_of_the_seed(speeds, d):
    base = OmniWheels(wheels_on_circle(SEED_ANGLES, [d] * 3))
    a, b, c = speeds
    twist = base.twist(speeds).twist
    assert twist.wz == pytest.approx(-(a + b + c) / (3 * d), abs=1e-12 / d)
    assert twist.vx == pytest.approx((a + b - 2 * c) / 3, abs=1e-12)
    assert twist.vy == pytest.approx((b - a) / sqrt(3), abs=1e-12)


@given(st.tuples(SPEED, SPEED, SPEED), st.floats(0.05, 2.0))
def test_the_free_rollers_of_the_seed(speeds, d):
    base = OmniWheels(wheels_on_circle(SEED_ANGLES, [d] * 3))
    a, b, c = speeds
    free = base.free_roller_speeds(base.twist(speeds).twist)
    expected = [(b - c) / sqrt(3), (c - a) / sqrt(3), (a - b) / sqrt(3)]
    assert free == pytest.approx(expected, abs=1e-12)


def test_driving_forward_by_hand():
    """Hand calculation: at 1 m/s along x, V_j = sin(a_j), and the rollers turn at cos(a_j)."""
    base = OmniWheels(wheels_on_circle(SEED_ANGLES, [0.2] * 3))
    forward = Twist(1.0, 0.0, 0.0)
    assert base.command(forward).speed == pytest.approx([0.5, 0.5, -1.0], abs=1e-15)
    expected = [sqrt(3) / 2, -sqrt(3) / 2, 0.0]
    assert base.free_roller_speeds(forward) == pytest.approx(expected, abs=1e-15)


@given(TWISTS, st.floats(0.1, 1.0), st.floats(0.1, 1.0))
def test_mecanum_wheels_as_the_textbooks_have_them(twist, length, width):
    vx, vy, turn = twist.vx, twist.vy, (length + width) * twist.wz
    expected = [vx - vy - turn, vx + vy + turn, vx + vy - turn, vx - vy + turn]
    base = OmniWheels(mecanum_wheels(length, width))
    assert base.command(twist).speed == pytest.approx(expected, abs=1e-12)


@given(bases(), TWISTS)
def test_driven_and_free_speeds_make_up_the_velocity_of_each_wheel(base, twist):
    driven, free = base.command(twist).speed, base.free_roller_speeds(twist)
    for wheel, v, s in zip(base.wheels, driven, free, strict=True):
        slide = wheel.rolling + wheel.slide
        vx = v * cos(wheel.rolling) + s * cos(slide)
        vy = v * sin(wheel.rolling) + s * sin(slide)
        assert vx == pytest.approx(twist.vx - twist.wz * wheel.y, abs=1e-11)
        assert vy == pytest.approx(twist.vy + twist.wz * wheel.x, abs=1e-11)


@given(bases(), TWISTS)
def test_the_fit_of_a_command_is_its_twist(base, twist):
    fit = base.twist(base.command(twist).speed)
    assert fit.twist == pytest.approx(twist, abs=1e-11)
    assert fit.residual < 1e-11


@given(bases(), st.lists(SPEED, min_size=6, max_size=6))
def test_the_fit_is_the_least_squares_one(base, speeds):
    measured = speeds[: len(base)]
    fit = base.twist(measured)
    best, *_ = np.linalg.lstsq(base.matrix, np.array(measured), rcond=None)
    error = base.matrix @ best - measured
    assert fit.twist == pytest.approx(tuple(best), abs=1e-9)
    assert fit.residual == pytest.approx(sqrt(np.mean(error**2)), abs=1e-9)


def test_slip_of_one_mecanum_wheel_by_hand():
    """Hand calculation: each wheel takes a quarter of the 0.4 m/s, none can be explained."""
    base = OmniWheels(mecanum_wheels(0.3, 0.2))
    fit = base.twist([0.4, 0.0, 0.0, 0.0])
    assert fit.twist == pytest.approx((0.1, -0.1, -0.2), abs=1e-15)
    assert fit.residual == pytest.approx(0.1, abs=1e-15)


@given(bases(), TWISTS, st.floats(0.01, 1.0))
def test_scaling_keeps_the_direction_and_the_limit(base, twist, limit):
    free, command = base.command(twist), base.command(twist, limit)
    assert max(map(abs, command.speed)) <= limit * (1 + 1e-15)
    assert free.scale == 1.0
    assert command.speed == pytest.approx([command.scale * s for s in free.speed], abs=1e-15)
    assert command.scale == 1.0 or max(map(abs, command.speed)) == pytest.approx(limit, rel=1e-14)


@given(bases(least=4), TWISTS, st.integers(0, 3), st.floats())
def test_one_missing_wheel_is_done_without(base, twist, missing, nonsense):
    rest = np.delete(base.matrix, missing, axis=0)
    values = np.linalg.svd(rest, compute_uv=False)
    assume(values[-1] > 0.05 * values[0])
    speeds = base.command(twist).speed
    speeds[missing] = nonsense
    fit = base.twist(speeds, missing={missing})
    assert fit.twist == pytest.approx(twist, abs=1e-11)
    assert fit.residual < 1e-11


@pytest.mark.parametrize(
    ('wheels', 'message'),
    [
        ([OmniWheel(1, 0, 0), OmniWheel(0, 1, 0)], r'2 wheel\(s\) cannot tell a twist'),
        ([OmniWheel(0, y, 0) for y in range(4)], r'moves along \(0, 1\)'),
        (wheels_on_circle([0, 1, 2], [0, 0, 0]), r'rotates about \(0, 0\) m'),
        ([OmniWheel(2 + cos(a), sin(a), a) for a in (0, 2, 4)], r'rotates about \(2, 0\) m'),
        ([OmniWheel(1, 0, 0), OmniWheel(0, 1, 0), OmniWheel(nan, 0, 0)], 'wheel 2 must be finite'),
        ([OmniWheel(1, 0, 0, pi)] * 3, 'wheel 0 slides along its own rolling direction'),
    ],
)
def test_an_impossible_placement_is_named(wheels, message):
    with pytest.raises(GeometryError, match=message):
        OmniWheels(wheels)


def test_wheels_that_no_longer_suffice_are_named():
    base = OmniWheels([OmniWheel(0, 1, 0), OmniWheel(0, -1, 0), *mecanum_wheels(1, 1)[:1]])
    with pytest.raises(SignalError, match=r'only wheels \(0, 1\) of 3 measure'):
        base.twist([0.0] * 3, missing=[2])
    four = OmniWheels(
        [OmniWheel(0, 0, 0), OmniWheel(0, 1, 0), OmniWheel(0, 2, 0), OmniWheel(0, 0, 1)]
    )
    with pytest.raises(SignalError, match=r'only wheels \(0, 1, 2\) of 4 measure, .* \(0, -?1\)'):
        four.twist([0.0] * 4, missing=[3])


@pytest.mark.parametrize('bad', [nan, inf, -inf])
def test_what_is_not_finite_is_refused(bad):
    base = OmniWheels(mecanum_wheels(0.3, 0.2))
    with pytest.raises(SignalError, match='twist must be finite'):
        base.command(Twist(0.0, bad, 0.0))
    with pytest.raises(SignalError, match='twist must be finite'):
        base.free_roller_speeds(Twist(bad, 0.0, 0.0))
    with pytest.raises(SignalError, match='wheel speeds must be finite'):
        base.twist([0.0, bad, 0.0, 0.0])
    with pytest.raises(SignalError, match='wheel speeds must be finite'):
        base.command(Twist(1e308, 1e308, 1e308))


def test_a_wrong_number_is_refused():
    with pytest.raises(SignalError, match='2 speeds for 4 wheels'):
        OmniWheels(mecanum_wheels(0.3, 0.2)).twist([0.0, 0.0])
    with pytest.raises(GeometryError, match='2 angles and 3 distances'):
        wheels_on_circle([0, 1], [1, 1, 1])


def test_polar_positions_and_radii():
    base = OmniWheels.from_polar(SEED_ANGLES, [0.2] * 3, [0.05, 0.1, 0.2])
    assert base.wheels == OmniWheels(wheels_on_circle(SEED_ANGLES, [0.2] * 3)).wheels
    speeds = base.command(Twist(1.0, 0.0, 0.0)).speed
    assert base.rates(speeds) == pytest.approx([10.0, 5.0, -5.0])
    assert base.speeds(base.rates(speeds)) == pytest.approx(speeds)


@pytest.mark.parametrize(
    ('radii', 'message'),
    [
        ([0.1] * 2, '2 wheel_radii for 3 wheels'),
        ([0.1, 0.0, 0.1], r'radius of wheel 1 = 0\.0 m: must be finite and above 0'),
        ([0.1, 0.1, -0.1], 'radius of wheel 2'),
        ([inf, 0.1, 0.1], 'radius of wheel 0 = inf m'),
        ([nan, 0.1, 0.1], 'radius of wheel 0 = nan m'),
    ],
)
def test_an_impossible_radius_is_refused(radii, message):
    with pytest.raises(GeometryError, match=message):
        OmniWheels.from_polar(SEED_ANGLES, [0.2] * 3, radii)


def test_rates_need_radii_and_one_number_a_wheel():
    with pytest.raises(GeometryError, match='give wheel_radii'):
        OmniWheels.from_polar(SEED_ANGLES, [0.2] * 3).rates([0.0] * 3)
    base = OmniWheels.from_polar(SEED_ANGLES, [0.2] * 3, [0.1] * 3)
    with pytest.raises(SignalError, match='2 wheel speeds for 3 wheels'):
        base.rates([0.0] * 2)
    with pytest.raises(SignalError, match='wheel rates must be finite'):
        base.speeds([0.0, nan, 0.0])


@pytest.mark.parametrize(
    ('rolling', 'message'),
    [(pi / 4, r'\(0\.7071, -0\.7071\)'), (-pi / 4, r'\(0\.7071, 0\.7071\)'), (pi / 2, r'\(1, ')],
)
def test_a_motion_that_turns_no_wheel_is_named_forwards(rolling, message):
    with pytest.raises(GeometryError, match=f'moves along {message}'):
        OmniWheels([OmniWheel(cos(a), sin(a), rolling) for a in (0.0, 1.0, 2.0)])


@pytest.mark.parametrize('missing', [(4,), (-1,), (0, 9)])
def test_a_missing_wheel_that_there_is_not_is_refused(missing):
    """It was passed over, and the wheel that was meant believed."""
    with pytest.raises(SignalError, match=r'missing = .*: there are wheels 0 to 3'):
        OmniWheels(mecanum_wheels(0.3, 0.2)).twist([0.0] * 4, missing)


def test_speeds_whose_twist_no_number_can_hold_are_refused():
    with pytest.raises(SignalError, match=r'the twist of wheel speeds .* must be finite'):
        OmniWheels(mecanum_wheels(0.3, 1e-3)).twist([1e308, -1e308, 1e308, -1e308])
