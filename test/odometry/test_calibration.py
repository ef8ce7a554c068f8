"""Calibration: the true measures within their stated intervals, and honesty about the rest."""

from __future__ import annotations

from math import cos, nan, pi, sin

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError, GeometryError, SignalError
from agv_motion.kinematics.omniwheel_placement import OmniWheel, wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.calibration import calibrate
from agv_motion.odometry.calibration_models import DifferentialModel, OmniModel, TurretModel
from agv_motion.odometry.calibration_recording import Recording
from agv_motion.odometry.columns import pose_columns
from agv_motion.planar import Pose

ANGLES = (pi / 6, 5 * pi / 6, 3 * pi / 2)
TREE = [(1.18 * cos(a), 1.18 * sin(a)) for a in (-pi / 4, pi / 4, pi)]
PERIOD, REFERENCE_EVERY, SLIP = 0.1, 10, 0.005


def wandering(rng, steps, *, forward_only=False):
    """Return (3, steps) displacements of a drive that changes its mind every two seconds."""
    changes = steps // 20 + 1
    speeds = rng.uniform(-1.0, 1.0, (3, changes)) * [[0.5], [0.5], [0.8]]
    if forward_only:
        speeds[1] = 0.0
    return PERIOD * np.repeat(speeds, 20, axis=1)[:, :steps]


def disturbed(rng, model):
    """Return true values of the unknowns, a little off the drawing."""
    nominal = np.array([unknown.nominal for unknown in model.unknowns])
    return nominal + 0.2 * np.array([unknown.doubt for unknown in model.unknowns]) * (
        rng.standard_normal(len(nominal))
    )


def omni_wheels(way):
    """Return the base as drawn, what its wheels do on a way as drawn, and its steering."""
    wheels = OmniWheels(wheels_on_circle(ANGLES, [0.2] * 3))
    return OmniModel(wheels, [0.05] * 3), wheels.matrix @ way / 0.05, None


def differential_wheels(way):
    turned = np.array([way[0] - way[2] * 0.2, way[0] + way[2] * 0.2]) / 0.1
    return DifferentialModel(0.4, [0.1, 0.1]), turned, None


def turret_wheels(way):
    positions = np.array(TREE)
    x = way[0] - np.outer(positions[:, 1], way[2])
    y = way[1] + np.outer(positions[:, 0], way[2])
    return TurretModel(Turrets(TREE), [0.1] * 3), np.hypot(x, y) / 0.1, np.arctan2(y, x)


def drive(kind, seed, *, heading=True, way=None, slip=SLIP):
    """Return model, truth and recording: the wheels turn as told, the base slips on the way."""
    rng = np.random.default_rng(seed)
    if way is None:
        way = wandering(rng, 1200, forward_only=kind is differential_wheels)
    model, turned, steering = kind(way)
    truth = disturbed(rng, model)
    moved = model.displacement(
        truth, turned, np.zeros_like(turned) if steering is None else steering
    )
    rolled = np.abs(model.radii[:, None] * turned).mean(axis=0)
    xx, xy, xt, yy, yt, tt = model.unit_covariance
    root = np.linalg.cholesky([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])
    moved += slip * np.sqrt(rolled) * (root @ rng.standard_normal(moved.shape))
    start = Pose(*rng.uniform(-5.0, 5.0, 2), float(rng.uniform(-pi, pi)))
    taken = np.arange(0, way.shape[1] + 1, REFERENCE_EVERY)
    reference = pose_columns(moved, start)[:, taken]
    reference[:2] += 0.02 * rng.standard_normal(reference[:2].shape)
    reference[2] += 0.01 * rng.standard_normal(reference[2].shape)
    if not heading:
        reference[2] = nan
    return model, truth, Recording(turned, taken, reference, 0.02, 0.01, steering)


@pytest.mark.parametrize('heading', [True, False], ids=['poses', 'positions'])
@pytest.mark.parametrize('kind', [omni_wheels, differential_wheels, turret_wheels])
def test_the_truth_lies_within_the_stated_interval_in_95_of_100_drives(kind, heading):
    errors, misfits = [], []
    for seed in range(30):
        model, truth, recording = drive(kind, seed, heading=heading)
        found = calibrate(model, recording, SLIP)
        misfits.append(found.misfit)
        errors += [
            (unknown.value - true) / unknown.deviation
            for unknown, true in zip(found.unknowns, truth, strict=True)
            if unknown.determined
        ]
    assert len(errors) >= 30 * 3
    assert np.mean(np.abs(errors) < 1.96) > 0.88
    assert np.std(errors) == pytest.approx(1.0, abs=0.25)
    assert np.mean(misfits) == pytest.approx(1.0, abs=0.1)


def test_a_path_that_winds_makes_no_wheel_too_small():
    """Slip bends the path, and so shortens it: 2.5 deviations of bias, were it not followed."""
    errors = []
    for seed in range(20):
        model, truth, recording = drive(omni_wheels, seed, slip=0.02)
        found = calibrate(model, recording, 0.02)
        radii = zip(found.unknowns[:3], truth[:3], strict=True)
        errors += [(unknown.value - true) / unknown.deviation for unknown, true in radii]
    assert abs(np.mean(errors)) < 0.4


def test_without_noise_the_truth_is_found():
    rng = np.random.default_rng(1)
    way = wandering(rng, 1000)
    wheels = OmniWheels(wheels_on_circle(ANGLES, [0.2] * 3))
    truth = np.array([0.051, 0.049, 0.0505, 0.205, 0.199, 0.197])
    matrix = OmniWheels(wheels_on_circle(ANGLES, truth[3:])).matrix
    taken = np.arange(0, 1001, 10)
    turned, reference = (matrix @ way) / truth[:3, None], pose_columns(way)[:, taken]
    found = calibrate(
        OmniModel(wheels, [0.05] * 3), Recording(turned, taken, reference, 1e-4, 1e-4)
    )
    values = [unknown.value for unknown in found.unknowns]
    assert values == pytest.approx(truth, rel=1e-3)
    assert found.misfit < 1e-3


def test_driving_straight_does_not_determine_distances():
    way = np.zeros((3, 600))
    way[:2] = 0.05 * np.repeat(np.random.default_rng(1).uniform(-1, 1, (2, 30)), 20, axis=1)
    model, _, recording = drive(omni_wheels, 1, way=way)
    found = calibrate(model, recording, SLIP)
    determined = {unknown.name: unknown.determined for unknown in found.unknowns}
    assert all(determined[f'radius_{i}'] for i in range(3))
    assert not any(determined[f'distance_{i}'] for i in range(3))
    assert {name for names in found.undetermined for name in names} == {
        'distance_0', 'distance_1', 'distance_2',
    }  # fmt: skip


def test_turning_on_the_spot_determines_only_a_ratio():
    way = np.zeros((3, 600))
    way[2] = 0.05
    model, truth, recording = drive(differential_wheels, 1, way=way)
    found = calibrate(model, recording, SLIP)
    assert 'track' not in {unknown.name for unknown in found.unknowns if unknown.determined}
    assert any(
        {'radius_left', 'radius_right', 'track'} <= set(names) for names in found.undetermined
    )
    left, right, track = (unknown.value for unknown in found.unknowns)
    assert (left + right) / track == pytest.approx((truth[0] + truth[1]) / truth[2], rel=0.005)


def test_without_headings_the_common_zero_of_all_turrets_stays_open():
    """In this drive the estimate alone would claim to know it, 3 deviations beside the truth."""
    model, _, recording = drive(turret_wheels, 5, heading=False)
    found = calibrate(model, recording, SLIP)
    assert found.undetermined == (('zero_0', 'zero_1', 'zero_2'),)
    assert [unknown.determined for unknown in found.unknowns] == [True] * 3 + [False] * 3


def test_at_rest_nothing_is_determined_and_the_drawing_stays():
    model, _, recording = drive(omni_wheels, 1, way=np.zeros((3, 300)))
    found = calibrate(model, recording, SLIP)
    assert not any(unknown.determined for unknown in found.unknowns)
    for unknown in found.unknowns:
        assert unknown.value == pytest.approx(unknown.nominal, rel=1e-9)
        assert unknown.deviation == pytest.approx(0.1 * unknown.nominal, rel=1e-9)


def test_outliers_among_the_references_are_left_out():
    model, truth, recording = drive(omni_wheels, 3)
    reference = recording.reference.copy()
    reference[:2, 7::15] += 3.0
    spoilt = Recording(recording.turned, recording.reference_step, reference, 0.02, 0.01)
    found = calibrate(model, spoilt, SLIP)
    assert found.outliers == len(reference[0, 7::15])
    errors = [
        (unknown.value - true) / unknown.deviation
        for unknown, true in zip(found.unknowns, truth, strict=True)
    ]
    assert np.abs(errors).max() < 4.0


def test_noise_that_is_worse_than_told_widens_the_intervals():
    model, _, recording = drive(omni_wheels, 3)
    told = Recording(recording.turned, recording.reference_step, recording.reference, 0.005, 0.01)
    honest, boasting = calibrate(model, recording, SLIP), calibrate(model, told, SLIP)
    assert boasting.misfit > 3.0
    assert boasting.unknowns[0].deviation > 0.6 * honest.unknowns[0].deviation


def test_malformed_recordings_are_refused():
    turned, steps, reference = np.zeros((3, 100)), np.arange(0, 101, 10), np.zeros((3, 11))
    bad = reference.copy()
    bad[0, 3] = nan
    for given, error, message in [
        ((turned[0], steps, reference, 0.1), SignalError, r'give \(n, m\), \(k,\) and \(3, k\)'),
        ((turned, steps + 5, reference, 0.1), SignalError, 'rise within 0 to 100'),
        ((turned, steps[::-1], reference, 0.1), SignalError, 'rise within 0 to 100'),
        ((turned, steps, bad, 0.1), SignalError, 'must be finite'),
        ((turned, steps, reference, 0.0), ConfigurationError, r'position_noise = 0\.0'),
        ((turned, steps, reference, 0.1, 0.1, turned[:2]), SignalError, 'steering has shape'),
    ]:
        with pytest.raises(error, match=message):
            Recording(*given)


def test_what_cannot_be_calibrated_is_refused():
    wheels = OmniWheels(wheels_on_circle(ANGLES, [0.2] * 3))
    model = OmniModel(wheels, [0.05] * 3)
    short = Recording(np.zeros((3, 10)), np.array([0, 5]), np.zeros((3, 2)), 0.1)
    with pytest.raises(ConfigurationError, match='2 references are too few for 6 unknowns'):
        calibrate(model, short)
    with pytest.raises(ConfigurationError, match=r'wheel_noise = 0\.0'):
        calibrate(model, short, 0.0)
    with pytest.raises(ConfigurationError, match='3 wheels recorded, 2 in the model'):
        calibrate(DifferentialModel(0.4, [0.1, 0.1]), short)
    with pytest.raises(ConfigurationError, match='give 3 finite numbers above 0'):
        OmniModel(wheels, [0.05, 0.05])
    with pytest.raises(ConfigurationError, match='give 3 finite numbers above 0'):
        TurretModel(Turrets(TREE), [0.1, nan, 0.1])
    with pytest.raises(GeometryError, match=r'track = 0\.0'):
        DifferentialModel(0.0, [0.1, 0.1])
    centred = [OmniWheel(0.0, 0.0, 0.0), *wheels_on_circle((1.0, 3.0), [0.2, 0.2])]
    with pytest.raises(ConfigurationError, match='a wheel in the centre'):
        OmniModel(OmniWheels(centred), [0.05] * 3)
