"""Turrets: no slip, one ICR, and both maps inverse to each other, over generated platforms."""

from __future__ import annotations

from math import atan2, cos, hypot, inf, nan, pi, sin

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from agv_motion.errors import GeometryError, SignalError
from agv_motion.kinematics.turrets import Turrets, centre_of_rotation
from agv_motion.planar import REST, STANDSTILL, Twist

TREE = Turrets([(1.18 * cos(a), 1.18 * sin(a)) for a in (-pi / 4, pi / 4, pi)])
COORDINATE = st.floats(-3.0, 3.0)
TWISTS = st.builds(Twist, COORDINATE, COORDINATE, COORDINATE)


@st.composite
def platforms(draw):
    """Two to six turrets, not all at one point."""
    points = draw(st.lists(st.tuples(COORDINATE, COORDINATE), min_size=2, max_size=6))
    assume(max(hypot(x - points[0][0], y - points[0][1]) for x, y in points) > 0.1)
    return Turrets(points)


def test_turning_on_the_spot_sets_the_tree_on_its_circle():
    """Hand calculation: each wheel is square to its arm and rolls at omega R."""
    command = TREE.command(Twist(0.0, 0.0, 0.01), [0.0, 0.0, 0.0])
    assert command.angle == pytest.approx([pi / 4, 3 * pi / 4, -pi / 2], abs=1e-15)
    assert command.speed == pytest.approx([0.0118] * 3, abs=1e-15)


@pytest.mark.parametrize(('v', 'theta', 'omega'), [(1.0, 0.3, 0.5), (0.2, -2.0, -1.0), (0, 0, 1)])
def test_the_dimensionless_equations_of_the_tree(v, theta, omega):
    """R_i = 1 in the model whose unit of length is the radius of the platform."""
    alphas = (-pi / 4, pi / 4, pi)
    unit = Turrets([(cos(a), sin(a)) for a in alphas])
    twist = Twist(v * cos(theta), v * sin(theta), omega)
    command = unit.command(twist, [0.0] * 3)
    for alpha, angle, speed in zip(alphas, command.angle, command.speed, strict=True):
        x = v * cos(theta) - omega * sin(alpha)
        y = v * sin(theta) + omega * cos(alpha)
        assert speed == pytest.approx(hypot(x, y), abs=1e-15)
        assert angle == pytest.approx(atan2(y, x), abs=1e-15)


@given(platforms(), TWISTS)
def test_wheels_roll_without_slipping(turrets, twist):
    command = turrets.command(twist, [0.0] * len(turrets))
    for (x, y), angle, speed in zip(turrets.positions, command.angle, command.speed, strict=True):
        body = np.cross([0.0, 0.0, twist.wz], [x, y, 0.0])[:2] + twist[:2]
        assert speed * cos(angle) == pytest.approx(body[0], abs=1e-12)
        assert speed * sin(angle) == pytest.approx(body[1], abs=1e-12)


@given(platforms(), TWISTS)
def test_every_wheel_axis_passes_through_the_icr(turrets, twist):
    centre = centre_of_rotation(twist)
    assume(centre is not None)
    assume(abs(twist.wz) > 1e-3)
    command = turrets.command(twist, [0.0] * len(turrets))
    for (x, y), angle, speed in zip(turrets.positions, command.angle, command.speed, strict=True):
        rolling_component = (centre[0] - x) * cos(angle) + (centre[1] - y) * sin(angle)
        assert speed < 1e-9 or abs(rolling_component) < 1e-8


def test_a_translation_has_its_icr_at_infinity():
    assert centre_of_rotation(Twist(1.0, 0.5, 0.0)) is None
    assert centre_of_rotation(REST) is None
    assert centre_of_rotation(Twist(1.0, 0.0, 0.5)) == (0.0, 2.0)


@given(platforms(), TWISTS)
def test_the_fit_of_a_command_is_its_twist(turrets, twist):
    fit = turrets.twist(*turrets.command(twist, [0.0] * len(turrets))[:2])
    assert fit.twist == pytest.approx(twist, abs=1e-10)
    assert fit.residual < 1e-12 + STANDSTILL


def test_turrets_that_fight_show_their_residual():
    """Hand calculation: two wheels pulling apart at 0.1 m/s each leave 0.1 m/s unexplained."""
    pair = Turrets([(1.0, 0.0), (-1.0, 0.0)])
    fit = pair.twist([0.0, pi], [0.1, 0.1])
    assert fit.twist == pytest.approx(REST, abs=1e-15)
    assert fit.residual == pytest.approx(0.1, abs=1e-15)


@given(platforms(), TWISTS, st.floats(0.01, 1.0))
def test_scaling_keeps_the_icr_and_the_limit(turrets, twist, limit):
    held = [0.0] * len(turrets)
    free = turrets.command(twist, held)
    command = turrets.command(twist, held, limit)
    assert max(command.speed) <= limit * (1 + 1e-15)
    assert command.angle == free.angle
    assert command.speed == pytest.approx([command.scale * s for s in free.speed], abs=1e-15)
    assert command.scale == 1.0 or max(command.speed) == pytest.approx(limit, rel=1e-14)


@given(platforms(), st.lists(st.floats(-20, 20), min_size=6, max_size=6))
def test_a_wheel_at_standstill_keeps_its_angle(turrets, angles):
    held = angles[: len(turrets)]
    command = turrets.command(REST, held)
    assert command.angle == held
    assert command.speed == [0.0] * len(turrets)


@pytest.mark.parametrize(
    'positions',
    [
        [], [(0.0, 0.0)], [(1.0, 1.0)] * 3, [(0.0, nan), (1.0, 0.0)], [(0, 0), (inf, 0)],
        [(1e200, 0.0), (-1e200, 0.0)],
    ],
)  # fmt: skip
def test_an_impossible_platform_is_refused(positions):
    with pytest.raises(GeometryError, match='turret'):
        Turrets(positions)


@pytest.mark.parametrize('twist', [(nan, 0, 0), (0, inf, 0), (0, 0, -inf), (1e308, 1e308, 1e308)])
def test_a_twist_that_is_not_finite_is_refused(twist):
    with pytest.raises(SignalError, match='must be finite'):
        TREE.command(Twist(*twist), [0.0] * 3)


def test_a_wrong_number_of_angles_is_refused():
    with pytest.raises(SignalError, match='2 angles for 3 turrets'):
        TREE.command(REST, [0.0] * 2)
    with pytest.raises(SignalError, match='2 angles and 3 speeds for 3 turrets'):
        TREE.twist([0.0] * 2, [0.0] * 3)
    with pytest.raises(SignalError, match='wheel speeds must be finite'):
        TREE.twist([0.0] * 3, [0.0, nan, 0.0])


def test_polar_positions():
    polar = Turrets.from_polar([-pi / 4, pi / 4, pi], [1.18] * 3)
    assert np.array(polar.positions) == pytest.approx(np.array(TREE.positions), abs=1e-15)
    with pytest.raises(GeometryError, match='2 angles and 3 distances'):
        Turrets.from_polar([0.0, 1.0], [1.0, 1.0, 1.0])


def test_wheels_that_stand_are_straight_unless_they_were_held_otherwise():
    assert TREE.command(REST) == ([0.0] * 3, [0.0] * 3, 1.0)
    assert TREE.command(Twist(0.1, 0.2, 0.3)) == TREE.command(Twist(0.1, 0.2, 0.3), [0.0] * 3)


def test_columns_are_solved_to_the_bit_as_one_by_one():
    rng = np.random.default_rng(3)
    angles, speeds = rng.uniform(-3, 3, (3, 10)), rng.uniform(-1, 1, (3, 10))
    found = np.array(TREE.solve_columns(angles, speeds)).T.tolist()
    pairs = zip(angles.T.tolist(), speeds.T.tolist(), strict=True)
    assert found == [list(TREE.solve(angle, speed)) for angle, speed in pairs]


@pytest.mark.parametrize('bad', [nan, inf])
def test_no_number_that_is_none_comes_out(bad):
    with pytest.raises(SignalError, match='held_angles must be finite'):
        TREE.command(REST, [0.0, bad, 0.0])
    with pytest.raises(SignalError, match='held_angles must be finite'):
        TREE.command(REST, [bad] * 3)
    with pytest.raises(SignalError, match='turret angles must be finite'):
        TREE.twist([0.0, bad, 0.0], [0.0] * 3)
    with pytest.raises(SignalError, match='wheel speeds must be finite'):
        TREE.twist([0.0] * 3, [0.0, 0.0, bad])
    for twist in (Twist(bad, 0.0, 1.0), Twist(0.0, bad, 0.0), Twist(1.0, 0.0, bad)):
        with pytest.raises(SignalError, match='twist must be finite'):
            centre_of_rotation(twist)


def test_speeds_whose_twist_no_number_can_hold_are_refused():
    with pytest.raises(SignalError, match=r'the twist of wheel speeds .* must be finite'):
        TREE.twist([0.0, 1.0, 0.0], [1e200] * 3)
