"""Three kinds of base behind one interface: the same motion gives the same displacement."""

from __future__ import annotations

from math import cos, nan, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import GeometryError, SignalError
from agv_motion.kinematics.omniwheel_placement import OmniWheel, mecanum_wheels, wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.base import DifferentialBase, OmniBase, TurretBase
from agv_motion.planar import STANDSTILL, Twist

MECANUM = OmniWheels(mecanum_wheels(0.3, 0.2))
UNEVEN = OmniWheels(
    [OmniWheel(0.5, 0.1, 1.0), OmniWheel(-0.2, 0.3, 2.5), OmniWheel(0.0, -0.4, 0.2)]
)
TURRETS = Turrets([(1.9, 0.6), (0.7, 1.2), (0.6, -0.1)])
LENGTH = st.floats(-1.0, 1.0)


def turret_travels(displacement):
    command = TURRETS.command(displacement, [0.0] * 3)
    return command.speed, command.angle


@given(LENGTH, LENGTH, LENGTH)
def test_every_base_finds_the_displacement_of_its_wheels(x, y, turn):
    displacement = Twist(x, y, turn)
    travel, steering = turret_travels(displacement)
    cases = [
        (OmniBase(MECANUM), MECANUM.command(displacement).speed, ()),
        (OmniBase(MECANUM, missing=[2]), MECANUM.command(displacement).speed, ()),
        (OmniBase(UNEVEN), UNEVEN.command(displacement).speed, ()),
        (TurretBase(TURRETS), travel, steering),
    ]
    for base, travels, angles in cases:
        *found, residual = base.displacement(travels, angles)
        # a turret that stands keeps its angle, whatever little it travels
        slow = any(0.0 < abs(travel) <= STANDSTILL for travel in travels)
        assert found == pytest.approx(displacement, abs=5.0 * STANDSTILL if slow else 1e-12)
        assert residual < 1e-8


def test_a_differential_base_by_hand():
    """Hand calculation: 0.3 m left and 0.5 m right of a track of 0.4 m turn by 0.5 rad."""
    found = DifferentialBase(0.4).displacement([0.3, 0.5], ())
    assert found == pytest.approx((0.4, 0.0, 0.5, 0.0), abs=1e-15)


@pytest.mark.parametrize(
    'base', [OmniBase(MECANUM), OmniBase(MECANUM, [1]), OmniBase(UNEVEN), DifferentialBase(0.4)]
)
def test_the_covariance_is_that_of_independent_travels(base):
    n = len(base)
    columns = [base.displacement(list(unit), ())[:3] for unit in np.eye(n)]
    expected = np.array(columns).T @ np.array(columns)
    found = np.array(base.unit_covariance)
    if isinstance(base, DifferentialBase):
        expected[1, 1] = 0.5  # not measured: as uncertain as forward
    np.testing.assert_allclose(found, expected[np.triu_indices(3)], atol=1e-12)


def test_the_covariance_of_turrets_is_that_of_their_velocities():
    """Each turret measures two components: independent noise on both, through the real fit."""
    rng = np.random.default_rng(3)
    base, step = TurretBase(TURRETS), 1e-5
    travel, steering = turret_travels(Twist(0.8, 0.1, 0.2))
    ends = []
    for _ in range(4000):
        velocities = [
            (v * cos(a) + step * rng.standard_normal(), v * sin(a) + step * rng.standard_normal())
            for v, a in zip(travel, steering, strict=True)
        ]
        angles = [float(np.arctan2(y, x)) for x, y in velocities]
        ends.append(base.displacement([float(np.hypot(x, y)) for x, y in velocities], angles)[:3])
    found = np.cov(np.array(ends).T)[np.triu_indices(3)] / step**2
    np.testing.assert_allclose(found, base.unit_covariance, atol=0.05)


def test_the_redundancy_counts_what_the_residual_can_tell():
    assert OmniBase(MECANUM).redundancy == 1
    assert OmniBase(MECANUM, [0]).redundancy == 0
    assert TurretBase(TURRETS).redundancy == 3
    assert DifferentialBase(0.4).redundancy == 0


@pytest.mark.parametrize('track', [0.0, -0.4, nan])
def test_an_impossible_track_is_refused(track):
    with pytest.raises(GeometryError, match='track = '):
        DifferentialBase(track)


def test_malformed_travels_are_refused():
    with pytest.raises(SignalError, match='3 travels for 2 wheels'):
        DifferentialBase(0.4).displacement([0.0] * 3, ())
    with pytest.raises(SignalError, match='must be finite'):
        DifferentialBase(0.4).displacement([0.0, nan], ())
    three = OmniWheels(wheels_on_circle([0.0, 2 * pi / 3, 4 * pi / 3], [0.2] * 3))
    with pytest.raises(SignalError, match=r'only wheels \(0, 1\) of 3'):
        OmniBase(three, missing=[2])
