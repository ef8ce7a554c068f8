"""A faulty wheel is found, a sound base is left in peace, and what cannot be told is not."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.kinematics.omniwheel_columns import command_columns
from agv_motion.kinematics.omniwheel_placement import mecanum_wheels, wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.odometry.wheel_fault import diagnose_wheels

FOUR = OmniWheels(mecanum_wheels(0.3, 0.2))
FIVE = OmniWheels(wheels_on_circle([2 * pi * i / 5 for i in range(5)], [0.3] * 5))
NOISE = 0.01


def measured(base, seed, instants=50):
    """Return noisy rim speeds of a varied motion."""
    rng = np.random.default_rng(seed)
    twist = rng.uniform(-1.0, 1.0, (3, instants)) * np.array([[1.0], [1.0], [3.0]])
    return command_columns(base, twist) + NOISE * rng.standard_normal((len(base), instants))


@pytest.mark.parametrize('base', [FOUR, FIVE])
def test_sound_wheels_agree(base):
    verdicts = [diagnose_wheels(base, measured(base, seed), NOISE) for seed in range(300)]
    assert sum(not verdict.consistent for verdict in verdicts) <= 2


@pytest.mark.parametrize('share', [0.0, 0.7, 1.3, -1.0])
@pytest.mark.parametrize('base', [FOUR, FIVE])
@pytest.mark.parametrize('wheel', [0, 3])
def test_a_wheel_that_measures_a_share_is_found(base, wheel, share):
    for seed in range(20):
        speeds = measured(base, seed)
        speeds[wheel] *= share
        assert diagnose_wheels(base, speeds, NOISE).faulty == wheel


def test_of_five_a_wheel_is_found_whatever_it_measures():
    for seed in range(50):
        speeds = measured(FIVE, seed)
        speeds[seed % 5] = np.random.default_rng(seed).uniform(-1, 1, speeds.shape[1])
        assert diagnose_wheels(FIVE, speeds, NOISE).faulty == seed % 5


def test_of_four_one_instant_blames_nobody():
    speeds = measured(FOUR, 1, instants=1)
    speeds[2] = 0.5
    verdict = diagnose_wheels(FOUR, speeds, NOISE)
    assert (verdict.consistent, verdict.suspects, verdict.faulty) == (False, (), None)


def test_of_four_in_steady_motion_nobody_is_singled_out():
    """Straight ahead all wheels turn alike: any one may be the one that measures too little."""
    speeds = np.full((4, 30), 0.5) + NOISE * np.random.default_rng(1).standard_normal((4, 30))
    speeds[1] *= 0.5
    verdict = diagnose_wheels(FOUR, speeds, NOISE)
    assert not verdict.consistent
    assert len(verdict.suspects) > 1
    assert verdict.faulty is None


def test_two_faulty_wheels_are_not_blamed_on_one():
    for seed in range(20):
        speeds = measured(FIVE, seed)
        speeds[0], speeds[2] = 0.0, 0.5 * speeds[2]
        verdict = diagnose_wheels(FIVE, speeds, NOISE)
        assert (verdict.consistent, verdict.suspects) == (False, ())


def test_what_cannot_be_diagnosed_is_refused():
    three = OmniWheels(wheels_on_circle([0.0, 2.0, 4.0], [0.2] * 3))
    with pytest.raises(ConfigurationError, match='3 wheels with noise'):
        diagnose_wheels(three, np.zeros((3, 5)), NOISE)
    with pytest.raises(ConfigurationError, match=r'noise = 0\.0'):
        diagnose_wheels(FOUR, np.zeros((4, 5)), 0.0)
    with pytest.raises(SignalError, match=r'got shape \(3, 5\)'):
        diagnose_wheels(FOUR, np.zeros((3, 5)), NOISE)
