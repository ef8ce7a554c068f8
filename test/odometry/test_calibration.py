"""Calibration: the true measures within their stated intervals, and honesty about the rest."""

from __future__ import annotations

from math import nan

import numpy as np
import pytest

from agv_motion.errors import ConfigurationError, GeometryError, SignalError
from agv_motion.kinematics.omniwheel_placement import OmniWheel, wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.calibration import calibrate
from agv_motion.odometry.calibration_models import DifferentialModel, OmniModel, TurretModel
from agv_motion.odometry.calibration_recording import CalibrationDrive
from agv_motion.odometry.calibration_stretch import Stretch
from agv_motion.odometry.columns import pose_columns
from agv_motion.simulation.trials.calibration import (
    ANGLES,
    BASES,
    DIFFERENTIAL,
    OMNI,
    SLIP,
    TREE,
    TURRETS,
    Conditions,
    coverage,
    simulate,
)


def wandering(rng, steps):
    """Return (3, steps) displacements of a drive that changes its mind every two seconds."""
    speeds = rng.uniform(-1.0, 1.0, (3, steps // 20 + 1)) * [[0.5], [0.5], [0.8]]
    return 0.1 * np.repeat(speeds, 20, axis=1)[:, :steps]


@pytest.mark.parametrize('carried', [False, True], ids=['left alone', 'carried'])
@pytest.mark.parametrize('heading', [True, False], ids=['poses', 'positions'])
@pytest.mark.parametrize('base', BASES)
def test_the_truth_lies_within_the_stated_interval_in_95_of_100_drives(base, heading, carried):
    """The long form is launch_scripts/trials/trial_calibration.py."""
    found = coverage(base, range(4), heading=heading, carried=carried)
    assert found.told >= 4 * 3
    assert found.held / found.told > 0.8
    assert found.deviation == pytest.approx(1.0, abs=0.35)
    assert found.misfit == pytest.approx(1.0, abs=0.1)
    assert (found.cuts >= 4) == carried
    assert carried or not found.cuts


def test_a_robot_that_was_carried_slowly_loses_the_places_on_the_way():
    """Places taken while it was carried are of no use to its wheels, which stood."""
    way = wandering(np.random.default_rng(4), 1200)
    way[:, 600:650] = 0.0
    model, _, recording = simulate(OMNI, 4, Conditions(way=way))
    reference = recording.reference.copy()
    reference[0, 60:66] += np.linspace(0.0, 4.0, 6)
    reference[0, 66:] += 4.0
    spoilt = CalibrationDrive(recording.turned, recording.reference_step, reference, 0.02, 0.01)
    found = calibrate(model, spoilt, SLIP)
    assert found.carried == 1
    assert 3 <= found.outliers <= 8
    assert found.misfit < 1.5


def test_a_combination_that_is_known_is_kept_though_none_of_its_parts_is():
    """Turning on the spot tells the mean distance, over the radii, of an omni robot alone."""
    way = np.zeros((3, 1200))
    way[2] = 0.05 * np.repeat(np.random.default_rng(1).choice([-1.0, 1.0], 60), 20)
    model, truth, recording = simulate(OMNI, 5, Conditions(way=way))
    found = calibrate(model, recording, SLIP)
    assert not any(one.determined for one in found.unknowns)

    def turn(values):
        return model.displacement(np.array(values), np.ones((3, 1)), np.zeros((3, 1)))[2, 0]

    assert turn([one.value for one in found.unknowns]) == pytest.approx(turn(truth), rel=5e-3)
    nominal = turn([one.nominal for one in found.unknowns])
    assert abs(nominal / turn(truth) - 1.0) > 0.01


def test_a_path_that_winds_makes_no_wheel_too_small():
    """Slip bends the path, and so shortens it: 2.5 deviations of bias, were it not followed."""
    errors = []
    for seed in range(10):
        model, truth, recording = simulate(OMNI, seed, Conditions(slip=0.02))
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
        OmniModel(wheels, [0.05] * 3), CalibrationDrive(turned, taken, reference, 1e-4, 1e-4)
    )
    values = [unknown.value for unknown in found.unknowns]
    assert values == pytest.approx(truth, rel=1e-3)
    assert found.misfit < 1e-3


def test_driving_straight_does_not_determine_distances():
    way = np.zeros((3, 600))
    way[:2] = 0.05 * np.repeat(np.random.default_rng(1).uniform(-1, 1, (2, 30)), 20, axis=1)
    model, _, recording = simulate(OMNI, 1, Conditions(way=way))
    found = calibrate(model, recording, SLIP)
    determined = {unknown.name: unknown.determined for unknown in found.unknowns}
    assert all(determined[f'radius_{i}'] for i in range(3))
    assert not any(determined[f'distance_{i}'] for i in range(3))
    for one in found.unknowns[3:]:
        assert one.value == pytest.approx(one.nominal, rel=2e-3)
    assert {name for names in found.undetermined for name in names} == {
        'distance_0', 'distance_1', 'distance_2',
    }  # fmt: skip


def test_turning_on_the_spot_determines_only_a_ratio():
    way = np.zeros((3, 600))
    way[2] = 0.05
    model, truth, recording = simulate(DIFFERENTIAL, 1, Conditions(way=way))
    found = calibrate(model, recording, SLIP)
    assert 'track' not in {unknown.name for unknown in found.unknowns if unknown.determined}
    assert any(
        {'radius_left', 'radius_right', 'track'} <= set(names) for names in found.undetermined
    )
    left, right, track = (unknown.value for unknown in found.unknowns)
    assert (left + right) / track == pytest.approx((truth[0] + truth[1]) / truth[2], rel=0.005)


def test_without_headings_the_common_zero_of_all_turrets_stays_open():
    """In this drive the estimate alone would claim to know it, 3 deviations beside the truth."""
    model, _, recording = simulate(TURRETS, 5, Conditions(heading=False))
    found = calibrate(model, recording, SLIP)
    assert found.undetermined == (('zero_0', 'zero_1', 'zero_2'),)
    assert [unknown.determined for unknown in found.unknowns] == [True] * 3 + [False] * 3


def test_at_rest_nothing_is_determined_and_the_drawing_stays():
    model, _, recording = simulate(OMNI, 1, Conditions(way=np.zeros((3, 300))))
    found = calibrate(model, recording, SLIP)
    assert not any(unknown.determined for unknown in found.unknowns)
    for unknown in found.unknowns:
        assert unknown.value == pytest.approx(unknown.nominal, rel=1e-9)
        assert unknown.deviation == pytest.approx(0.1 * unknown.nominal, rel=1e-9)


def test_outliers_among_the_references_are_left_out():
    model, truth, recording = simulate(OMNI, 3)
    reference = recording.reference.copy()
    reference[:2, 7::15] += 3.0
    spoilt = CalibrationDrive(recording.turned, recording.reference_step, reference, 0.02, 0.01)
    found = calibrate(model, spoilt, SLIP)
    assert found.outliers == len(reference[0, 7::15])
    errors = [
        (unknown.value - true) / unknown.deviation
        for unknown, true in zip(found.unknowns, truth, strict=True)
    ]
    assert np.abs(errors).max() < 4.0


def test_how_far_off_an_outlier_was_leaves_no_trace():
    """Too near for a robot that was carried, too far for noise."""
    found = []
    for off in (0.15, 0.3):
        model, _, recording = simulate(OMNI, 3)
        recording.reference[0, 25] += off
        found.append(calibrate(model, recording, SLIP))
        assert found[-1].outliers == 1
    first, second = ([one.value for one in each.unknowns] for each in found)
    assert first == pytest.approx(second, rel=1e-5)


def test_slip_that_adds_up_hides_no_outlier():
    """20 deviations off, but less than wheels that slip so might be after a minute alone."""
    model, truth, recording = simulate(OMNI, 3, Conditions(heading=False))
    recording.reference[0, 25] += 0.4
    stretch = Stretch(model, recording.stretches()[0], 0.05)
    assert stretch.references == 60
    assert stretch.drop_outliers(truth) == 1
    assert stretch.references == 59
    assert not stretch.drop_outliers(truth)


@pytest.mark.parametrize(('slip', 'assumed'), [(0.005, 0.015), (0.015, 0.005)])
def test_the_slip_is_found_from_the_drive(slip, assumed):
    model, _, recording = simulate(OMNI, 1, Conditions(slip=slip))
    found = calibrate(model, recording, assumed)
    assert 0.6 * slip < found.slip < 1.5 * slip
    assert not found.slip_is_open


def test_slip_that_is_beyond_all_that_is_looked_at_is_told():
    model, _, recording = simulate(OMNI, 1, Conditions(slip=0.05))
    assert calibrate(model, recording, 1e-4).slip_is_open


def test_at_rest_the_slip_is_as_assumed():
    model, _, recording = simulate(OMNI, 1, Conditions(way=np.zeros((3, 300))))
    assert calibrate(model, recording, SLIP).slip == pytest.approx(SLIP)


def test_noise_that_is_worse_than_told_widens_the_intervals():
    model, _, recording = simulate(OMNI, 3)
    told = CalibrationDrive(
        recording.turned, recording.reference_step, recording.reference, 0.005, 0.01
    )
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
            CalibrationDrive(*given)


def test_what_cannot_be_calibrated_is_refused():
    wheels = OmniWheels(wheels_on_circle(ANGLES, [0.2] * 3))
    model = OmniModel(wheels, [0.05] * 3)
    short = CalibrationDrive(np.zeros((3, 10)), np.array([0, 5]), np.zeros((3, 2)), 0.1)
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
