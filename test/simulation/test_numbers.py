"""Numbers of the trials: a trial is known by its figures, which change with them."""

from __future__ import annotations

from math import pi
from pkgutil import resolve_name

import pytest
from room_numbers import constants, defaults

CONSTANTS = {
    'sap.PERIOD': 60.0,
    'shade.CLEAR_SKY': 1000.0,
    'shade.DIFFUSE': 0.3,
    'shade.LUX_PER_WATT': 120.0,
    'shade.PENUMBRA': 0.5,
    'trials.calibration.ANGLES': (pi / 6, 5 * pi / 6, 3 * pi / 2),
    'trials.calibration.APART': 0.2,
    'trials.calibration.CARRIED': (2.0, 5.0),
    'trials.calibration.HEADING_NOISE': 0.01,
    'trials.calibration.NINETY_FIVE': 1.96,
    'trials.calibration.PERIOD': 0.1,
    'trials.calibration.POSITION_NOISE': 0.02,
    'trials.calibration.REFERENCE_EVERY': 10,
    'trials.calibration.SLIP': 0.005,
    'trials.calibration.STEPS': 1200,
    'trials.crowd.ARRIVAL': 1.0,
    'trials.crowd.MEMORY': 300.0,
    'trials.omni.DISTANCE': 0.2,
    'trials.omni.RADIUS': 0.05,
    'trials.probe_losses.BACK': 11,
    'trials.probe_losses.BEGIN': 1_430_438_400.0,
    'trials.probe_losses.DAY': 86400.0,
    'trials.probe_losses.FORGOTTEN': 15,
    'trials.probe_losses.HOUR': 3600.0,
    'trials.probe_losses.LEARNING': 345_600.0,
    'trials.probe_losses.NOTICED': 20,
    'trials.probe_losses.PROBES': (0, 1, 2),
    'trials.season.DAY': 86400.0,
    'trials.season.FIRST_OPENING': 1_430_474_400.0,
    'trials.season.LATITUDE': 48.86,
    'trials.season.LONGITUDE': 2.35,
    'trials.season_tree.ERROR_TIME': 300.0,
    'trials.season_tree.STEPPED': 0.1,
    'trials.season_zones.DOOR': 2.56,
    'trials.season_zones.NARROW': 0.2,
    'trials.season_zones.TIGHT': 0.09,
    'trials.season_zones.WALL': 0.2,
    'trials.tracking.LONGEST': 300.0,
    'trials.tracking.WHEEL_RADIUS': 0.05,
    'trials.traffic_episode.STEP': 5.0,
    'trials.traffic_search.LONG': 1e9,
}

DEFAULTS = {
    'differential.DifferentialRobotParameters': {
        'traction_lag': 0.02, 'slip_noise': 0.005, 'encoder_resolution': 0.003,
    },
    'fixes.FixParameters': {'rate': 1.0, 'position_noise': 0.15, 'heading_noise': 0.03},
    'gyro.GyroParameters': {'noise': 0.002, 'bias': 0.01},
    'omni.OmniRobotParameters': {'traction_lag': 0.1, 'wheel_noise': 0.005},
    'radio.RadioParameters': {'loss': 0.1, 'delay': 2.0},
    'trials.calibration.Conditions': {'heading': True, 'slip': 0.005},
    'trials.crowd.CrowdParameters': {
        'trees': 2, 'seed': 1, 'step': 5.0, 'slowest': 0.3, 'error': 0.05, 'skew': 3.0,
    },
    'trials.omni.TrialParameters': {
        'seed': 1, 'rate': 20.0, 'length': 20.0, 'width': 15.0, 'speed': 0.5, 'turning': 0.5,
    },
    'trials.probe_losses.LossTrialParameters': {
        'days': 120.0, 'failures': 100, 'step': 300.0, 'seed': 1,
    },
    'trials.season.SeasonParameters': {
        'trees': 2, 'days': 20, 'hours': 8.0, 'seed': 1, 'step': 15.0, 'error': 0.02,
        'outages': 0.1,
    },
    'trials.season_zones.ZonePlan': {'margin': 0.5},
    'trials.tracking.TrackingTrialParameters': {
        'seed': 1, 'rate': 50.0, 'steps': 4, 'position_noise': 0.01, 'heading_noise': 0.01,
        'slip': 0.05, 'cruising_speed': 0.5, 'speed_ramps': 0.5,
    },
    'trials.traffic_episode.EpisodeParameters': {'seed': 1, 'seconds': 1800.0},
    'trials.traffic_search.SearchParameters': {
        'cells': (0, 3), 'states': 20_000, 'messages': 5, 'late': 2, 'runs': 2, 'rounds': 1,
    },
    'turret_platform.MotorParameters': {
        'steering_rate': 0.4, 'steering_lag': 0.1, 'traction_lag': 0.2,
    },
    'uwb.UwbParameters': {
        'rate': 1.0, 'position_noise': 0.15, 'outlier_reach': 5.0, 'multipath_duration': 4.0,
        'multipath_reach': 2.0, 'dropout_duration': 300.0,
    },
}  # fmt: skip


def test_tuned_numbers_change_on_purpose_only():
    assert constants('simulation') == CONSTANTS
    ladder = resolve_name('agv_motion.simulation.trials.probe_losses:LADDER')
    assert (ladder.hold, ladder.trend, ladder.climatology) == (900.0, 3600.0, 10_800.0)
    tree = resolve_name('agv_motion.simulation.trials.calibration:TREE')
    x, y = 1.18 * 0.5**0.5, 1.18 * 0.5**0.5
    assert tree == [pytest.approx(place, abs=1e-12) for place in ((x, -y), (x, y), (-1.18, 0.0))]


def test_what_nobody_told_is_nothing_or_in_a_table():
    assert defaults('simulation') == DEFAULTS
