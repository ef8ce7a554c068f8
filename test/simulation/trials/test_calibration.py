"""What a trial of calibration drives, and how its robots are drawn, by hand."""

from __future__ import annotations

from math import atan2, cos, hypot, sin

import numpy as np
import pytest

from agv_motion.odometry.columns import pose_columns
from agv_motion.planar import Pose
from agv_motion.simulation.trials import calibration
from agv_motion.simulation.trials.calibration import (
    ANGLES,
    BASES,
    DIFFERENTIAL,
    OMNI,
    PERIOD,
    STEPS,
    TREE,
    Conditions,
    _as_drawn,
    _carried,
    _wandering,
    simulate,
)

WAY = np.array([[0.1], [0.05], [0.2]])
"""One step: 10 cm ahead, 5 cm to the left, a turn of 0.2 rad"""


@pytest.mark.parametrize('forward_only', [True, False])
def test_a_drive_changes_its_mind_every_two_seconds(forward_only):
    way = _wandering(np.random.default_rng(1), forward_only=forward_only)
    assert way.shape == (3, STEPS)
    blocks = way.reshape(3, STEPS // 20, 20)
    assert (blocks == blocks[:, :, :1]).all()
    assert len(np.unique(way[0])) == STEPS // 20
    fastest = np.array([0.5, 0.0 if forward_only else 0.5, 0.8]) * PERIOD
    assert np.abs(way).max(axis=1) == pytest.approx(fastest, rel=0.1)
    assert (np.abs(way).max(axis=1) <= fastest).all()
    assert (way.min(axis=1) <= -0.9 * fastest).all()


def test_wheels_turn_as_the_base_is_drawn():
    """Differential: 0.2 m from the middle, on wheels of 0.1 m."""
    _, turned, steering = _as_drawn(DIFFERENTIAL, WAY)
    assert turned.ravel() == pytest.approx([(0.1 - 0.04) / 0.1, (0.1 + 0.04) / 0.1])
    assert steering is None
    _, turned, steering = _as_drawn(OMNI, WAY)  # each rolls clockwise round the middle
    rims = [sin(a) * 0.1 - cos(a) * 0.05 - 0.2 * 0.2 for a in ANGLES]
    assert turned.ravel() == pytest.approx([rim / 0.05 for rim in rims])
    assert steering is None
    _, turned, steering = _as_drawn('turrets', WAY)
    for i, (x, y) in enumerate(TREE):
        vx, vy = 0.1 - y * 0.2, 0.05 + x * 0.2
        assert turned[i, 0] == pytest.approx(hypot(vx, vy) / 0.1)
        assert steering[i, 0] == pytest.approx(atan2(vy, vx))


def test_who_is_carried_away_keeps_the_way_from_there():
    reference = np.array([[1.0, 2.0, 2.0], [0.0, 0.0, 3.0], [0.0, 0.5, 1.0]])
    for seed in range(20):
        moved = _carried(np.random.default_rng(seed), reference)
        dx, dy = moved[:2, 0] - reference[:2, 0]
        assert 2.0 <= hypot(dx, dy) <= 5.0
        turn = moved[2, 0] - reference[2, 0]
        assert moved[2] - reference[2] == pytest.approx([turn] * 3)
        c, s = np.cos(turn), np.sin(turn)
        steps = np.array([[c, -s], [s, c]]) @ np.diff(reference[:2], axis=1)
        assert np.diff(moved[:2], axis=1) == pytest.approx(steps)


@pytest.mark.parametrize('base', BASES)
def test_without_noise_the_references_are_where_the_true_robot_came(base, monkeypatch):
    """Every ten steps from the start on; carried away before the sixth, it goes on from there."""
    monkeypatch.setattr(calibration, 'POSITION_NOISE', 1e-12)
    monkeypatch.setattr(calibration, 'HEADING_NOISE', 1e-12)
    way = 0.1 * np.random.default_rng(3).uniform(-1.0, 1.0, (3, 100)) * [[1.0], [0.0], [1.0]]
    given = Conditions(way=way, slip=0.0)
    model, truth, told = simulate(base, 7, given)
    assert told.reference_step.tolist() == list(range(0, 101, 10))
    steering = np.zeros_like(told.turned) if told.steering is None else told.steering
    moved = model.displacement(truth, told.turned, steering)
    start = Pose(*told.reference[:, 0])
    assert np.abs(start).max() <= 5.0
    assert told.reference == pytest.approx(pose_columns(moved, start)[:, ::10])
    nominal, doubt = np.array([unknown[2:] for unknown in model.unknowns]).T
    drawn = np.random.default_rng(7).standard_normal(len(nominal))
    assert truth == pytest.approx(nominal + 0.2 * doubt * drawn)
    away = simulate(base, 7, given._replace(carried=(5,))).recording.reference
    assert away[:, :5] == pytest.approx(told.reference[:, :5])
    assert 2.0 <= hypot(*(away[:2, 5] - told.reference[:2, 5])) <= 5.0
    blind = simulate(base, 7, given._replace(heading=False)).recording.reference
    assert np.isnan(blind[2]).all()
    assert blind[:2] == pytest.approx(told.reference[:2])


def test_the_noise_of_a_heading_has_the_size_that_is_told():
    """10 mrad, and so half as much again, nearly, between two."""
    quiet = simulate(DIFFERENTIAL, 1, Conditions(slip=0.0)).recording
    assert quiet.turned.shape == (2, STEPS)
    assert (quiet.position_noise, quiet.heading_noise) == (0.02, 0.01)
    model, truth, _ = simulate(DIFFERENTIAL, 1)
    moved = model.displacement(truth, quiet.turned, np.zeros_like(quiet.turned))
    true = pose_columns(moved, Pose(0.0, 0.0, 0.0))[2, ::10]
    errors = np.diff(quiet.reference[2] - true)
    assert errors.std() == pytest.approx(0.01 * 2**0.5, rel=0.2)
