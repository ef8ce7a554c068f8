"""Numbers of this room: what nobody told is nothing, a number changes on purpose only."""

from __future__ import annotations

from math import pi

import pytest
from room_numbers import constants, defaults

from agv_motion.odometry.calibration import SLIP_SHARES
from agv_motion.odometry.fix_buffer import VOTERS

CONSTANTS = {
    'alignment.GATE': 13.815510557964272,
    'alignment.ROUNDS': 3,
    'alignment.UNKNOWN': pi**2 / 3.0,
    'calibration.CONVERGED': 0.0001,
    'calibration.CUTTINGS': 3,
    'calibration.DETERMINED': 0.3,
    'calibration.ITERATIONS': 10,
    'calibration.ROUNDS': 4,
    'calibration.SLIP_DOUBT': 3.0,
    'calibration.UNTOLD': 0.5,
    'calibration_cuts.AGREEING': 6,
    'calibration_cuts.EXPLAINED': 0.8,
    'calibration_cuts.GATE': 5.0,
    'calibration_cuts.LEAST': 3,
    'calibration_cuts.SHARES': (0.01, 0.02, 0.05, 0.1),
    'calibration_cuts.WINDOW': 9,
    'calibration_models.ANGLE_DOUBT': 0.2,
    'calibration_models.LENGTH_DOUBT': 0.1,
    'calibration_recording.LONGEST': 60,
    'calibration_stretch.FEWEST': 9,
    'calibration_stretch.MEDIAN': 0.6745,
    'calibration_stretch.OUTLIER': 5.0,
    'calibration_stretch.STEP': 0.001,
    'columns.ORIGIN': (0.0, 0.0, 0.0),
    'continuity.LEAP': 10.0,
    'continuity.LONGEST_LOSS': 3600.0,
    'covariance.CERTAIN': (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    'fix_buffer.LONGEST_STREAK': 24,
    'fusion.AGREEING': 0.6,
    'fusion.DOUBT': 3,
    'fusion.MOST_SIGHTINGS': 24,
    'fusion.MOST_WAITING': 50,
    'gates.CONDITION': 1e-10,
    'gates.MAX_ANGLE': 1_000_000_000.0,
    'gates.MAX_COORDINATE': 10_000_000.0,
    'gates.MAX_DEVIATION': 10_000.0,
    'gates.MAX_HEADING': 1_000_000.0,
    'gates.MAX_STAMP': 100_000_000_000.0,
    'gates.MAX_TURN_DEVIATION': 1000.0,
    'gates.MAX_WAY': 100_000.0,
    'gates.MIN_DEVIATION': 1e-06,
    'gates.ROUNDING': 1e-09,
    'kalman.STEEP': 1_000_000.0,
    'odometry_intake.EXACT': 1e-13,
    'odometry_intake.MOST': 100_000_000.0,
    'odometry_intake.SLACK': (0.01, 0.05),
    'odometry_intake.SURE': 1.000000001,
    'turret_odometry.EVEN': 0.25,
    'turret_odometry.MAX_GAP': 0.5,
    'turret_odometry.MAX_WHEEL_SPEED': 10.0,
    'wheel_fault.IRREPLACEABLE': 1e-09,
    'wheel_monitor.ENOUGH': 8,
    'wheel_monitor.INSTANTS': 40,
    'wheel_monitor.SOUND': (True, ()),
    'wheel_monitor.SPAN': 0.5,
    'wheel_monitor.TOLERANCE': 0.05,
    'wheel_odometry.SLIP': 9.0,
    'yaw_rate.PERSISTENCE': 30.0,
    'yaw_rate.STRETCH': 2.0,
}

DEFAULTS = {
    'assumed_noise.AssumedNoiseParameters': {'position': 0.02, 'heading': 0.02, 'turning': 0.02},
    'calibration.calibrate': {'wheel_noise': 0.005},
    'calibration_recording.CalibrationDrive': {'heading_noise': 0.02},
    'columns.pose_columns': {'start': (0.0, 0.0, 0.0)},
    'dead_reckoning.DeadReckoning.set': {
        'covariance': (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    },
    'dead_reckoning.DeadReckoning.carry': {'variance': 1.0},
    'fix_buffer.FixBuffer': {'fewest': 5, 'span': 10.0},
    'fusion_parameters.FusionParameters': {
        'horizon': 1.5, 'gate': 0.999, 'position_drift': 0.001, 'heading_drift': 0.0002,
        'heading_known': 0.2, 'alignment_fixes': 5, 'search_time': 300.0, 'kidnap_fixes': 5,
        'kidnap_time': 10.0, 'fix_timeout': 5.0, 'max_speed': 10.0, 'max_turn_rate': 10.0,
    },
    'parameters.OdometryParameters': {
        'wheel_noise': 0.005, 'max_wheel_speed': 5.0, 'max_gap': 0.5, 'gap_noise': 0.3,
    },
    'turret_odometry.TurretOdometry': {'max_wheel_speed': 10.0, 'max_gap': 0.5},
    'wheel_fault.diagnose_wheels': {'false_alarm': 0.001},
    'wheel_odometry.WheelOdometry.set_odometry': {
        'covariance': (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    },
    'yaw_rate.YawRateParameters': {
        'noise': 0.002, 'bias': 0.01, 'bias_walk': 2e-05, 'max_gap': 0.2, 'max_rate': 35.0,
    },
}  # fmt: skip


def test_numbers_change_on_purpose_only():
    assert constants('odometry') == CONSTANTS
    assert list(VOTERS) == [3, 4, 5, 6, 7]
    assert len(SLIP_SHARES) == 49
    assert SLIP_SHARES[[0, 12, 36, 48]] == pytest.approx([1 / 81, 1 / 9, 9.0, 81.0])


def test_what_nobody_told_is_nothing_or_in_a_table():
    assert defaults('odometry') == DEFAULTS
