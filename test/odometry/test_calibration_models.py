"""What the wheels of each kind of base say, calculated by hand; what may be changed of them."""

from __future__ import annotations

from math import inf, nan, pi

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.kinematics.omniwheel_placement import OmniWheel, wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.base import DifferentialBase, OmniBase, TurretBase
from agv_motion.odometry.calibration_models import DifferentialModel, OmniModel, TurretModel

THREE = OmniWheels(wheels_on_circle((0.0, 2.0 * pi / 3.0, -2.0 * pi / 3.0), [0.2] * 3))
FOUR = OmniWheels(wheels_on_circle((0.0, pi / 2.0, pi, -pi / 2.0), [0.25] * 4))
ASIDE = Turrets([(1.0, 0.5), (-0.2, 0.5)])


def moved(model, values, turned, steering=None):
    """Return the displacement in one step."""
    turned = np.array(turned, dtype=float)[:, None]
    angles = np.zeros_like(turned) if steering is None else np.array(steering)[:, None]
    return model.displacement(np.array(values, dtype=float), turned, angles)[:, 0]


@pytest.mark.parametrize(
    ('radii', 'distances', 'expected'),
    [
        ([0.05] * 3, [0.2] * 3, (0.0, 0.0, -0.25)),  # all clockwise: 0.05 m over 0.2 m
        ([0.05] * 3, [0.25] * 3, (0.0, 0.0, -0.2)),
        ([0.1, 0.05, 0.05], [0.2] * 3, (0.0, -0.1 / 3.0, -1.0 / 3.0)),
    ],
)
def test_omni_wheels_turn_the_base_by_their_way_over_their_distance(radii, distances, expected):
    model = OmniModel(THREE, [0.05] * 3)
    assert moved(model, radii + distances, [1.0] * 3) == pytest.approx(expected, abs=1e-12)


def test_four_omni_wheels_that_contradict_each_other_are_averaged():
    """One rolls 0.1 m to the right at 0.25 m ahead: half of it aside, a quarter of it round."""
    model = OmniModel(FOUR, [0.05] * 4)
    found = moved(model, [0.05] * 4 + [0.25] * 4, [2.0, 0.0, 0.0, 0.0])
    assert found == pytest.approx((0.0, -0.05, -0.1), abs=1e-12)


@pytest.mark.parametrize(
    ('values', 'steering', 'expected'),
    [
        ([0.1, 0.2, 0.0, 0.0], (0.0, 0.0), (0.15, 0.0, 0.0)),
        # against each other 0.6 m from the middle between them, which is at (0.4, 0.5)
        ([0.1, 0.1, 0.0, 0.0], (pi / 2, -pi / 2), (1 / 12, -1 / 15, 1 / 6)),
        ([0.1, 0.1, pi / 2, -pi / 2], (0.0, 0.0), (1 / 12, -1 / 15, 1 / 6)),
        ([0.1, 0.1, pi / 2, pi / 2], (0.0, 0.0), (0.0, 0.1, 0.0)),
    ],
)
def test_turrets_move_the_base_about_the_middle_between_them(values, steering, expected):
    """What an angle reads too little is added to it."""
    model = TurretModel(ASIDE, [0.1, 0.2])
    assert moved(model, values, [1.0, 1.0], steering) == pytest.approx(expected, abs=1e-12)
    angles = np.add(steering, values[2:]).tolist()
    twist = ASIDE.twist(angles, values[:2]).twist
    assert tuple(twist) == pytest.approx(expected, abs=1e-12)


def test_arms_of_any_direction_turn_the_base():
    """Three turrets that all roll across their arms, 0.1 m at 1, 2 and 2 m: 0.5 over 9."""
    turrets = Turrets([(1.0, 0.0), (-2.0, 2.0), (1.0, -2.0)])
    arms = np.array([(1.0, 0.0), (-2.0, 2.0), (1.0, -2.0)])
    across = np.arctan2(arms[:, 0], -arms[:, 1])
    found = moved(TurretModel(turrets, [0.1] * 3), [0.1] * 3 + [0.0] * 3, [1.0] * 3, across)
    lengths = np.hypot(*arms.T)
    assert found[2] == pytest.approx(0.1 * lengths.sum() / (lengths**2).sum())


def test_two_wheels_move_the_base_by_half_their_sum_and_turn_it_by_their_difference():
    """0.1 m on the left and 0.4 m on the right, 0.5 m apart."""
    found = moved(DifferentialModel(0.4, [0.1, 0.2]), [0.1, 0.2, 0.5], [1.0, 2.0])
    assert found == pytest.approx((0.25, 0.0, 0.6))


def test_each_length_is_known_to_a_tenth_and_each_zero_to_a_fifth_of_a_radian():
    placed = [OmniWheel(0.3, 0.4, 1.0), *THREE.wheels[1:]]
    rows = {
        OmniModel(OmniWheels(placed), [0.05, 0.06, 0.05]): [
            ('radius_0', 'm', 0.05, 0.005), ('radius_1', 'm', 0.06, 0.006),
            ('radius_2', 'm', 0.05, 0.005), ('distance_0', 'm', 0.5, 0.05),
            ('distance_1', 'm', 0.2, 0.02), ('distance_2', 'm', 0.2, 0.02),
        ],
        TurretModel(ASIDE, [0.1, 0.2]): [
            ('radius_0', 'm', 0.1, 0.01), ('radius_1', 'm', 0.2, 0.02),
            ('zero_0', 'rad', 0.0, 0.2), ('zero_1', 'rad', 0.0, 0.2),
        ],
        DifferentialModel(0.4, [0.1, 0.2]): [
            ('radius_left', 'm', 0.1, 0.01), ('radius_right', 'm', 0.2, 0.02),
            ('track', 'm', 0.4, 0.04),
        ],
    }  # fmt: skip
    for model, unknowns in rows.items():
        assert [one[:2] for one in model.unknowns] == [one[:2] for one in unknowns]
        numbers = [pytest.approx(one[2:]) for one in unknowns]
        assert [one[2:] for one in model.unknowns] == numbers


def test_the_noise_of_a_base_is_that_of_its_odometry():
    assert OmniModel(THREE, [0.1] * 3).unit_covariance == OmniBase(THREE).unit_covariance
    assert TurretModel(ASIDE, [0.1] * 2).unit_covariance == TurretBase(ASIDE).unit_covariance
    two = DifferentialModel(0.4, [0.1] * 2).unit_covariance
    assert two == DifferentialBase(0.4).unit_covariance


@pytest.mark.parametrize('radius', [0.0, -0.1, nan, inf])
def test_a_radius_is_a_number_above_0(radius):
    with pytest.raises(ConfigurationError, match=r'give 2 finite numbers above 0 \[m\]'):
        DifferentialModel(0.4, [0.1, radius])


def test_a_wheel_in_the_centre_has_no_distance_to_calibrate():
    centred = OmniWheels([OmniWheel(0.0, 0.0, 0.0), *wheels_on_circle((1.0, 3.0), [0.2, 0.3])])
    with pytest.raises(
        ConfigurationError,
        match=r'^wheels at distances \[0\.0, .*\] m: a wheel in the centre has none',
    ):
        OmniModel(centred, [0.05] * 3)
