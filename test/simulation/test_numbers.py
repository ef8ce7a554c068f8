"""Numbers of the trials: a trial is known by its figures, which change with them."""

from __future__ import annotations

from dataclasses import asdict
from math import pi
from pkgutil import resolve_name

import pytest

from agv_motion.simulation.trials.calibration import Conditions
from agv_motion.simulation.trials.crowd import CrowdParameters
from agv_motion.simulation.trials.probe_losses import LossTrialParameters

TUNED = {
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
    'trials.season_zones.NARROW': 0.2,
    'trials.season_zones.TIGHT': 0.09,
    'trials.season_zones.WALL': 0.2,
    'trials.tracking.LONGEST': 300.0,
    'trials.tracking.WHEEL_RADIUS': 0.05,
    'trials.traffic_episode.STEP': 5.0,
    'trials.traffic_search.LONG': 1e9,
}


def test_tuned_numbers_change_on_purpose_only():
    for name, value in TUNED.items():
        module, _, number = name.rpartition('.')
        assert resolve_name(f'agv_motion.simulation.{module}:{number}') == value, name
    ladder = resolve_name('agv_motion.simulation.trials.probe_losses:LADDER')
    assert (ladder.hold, ladder.trend, ladder.climatology) == (900.0, 3600.0, 10_800.0)
    tree = resolve_name('agv_motion.simulation.trials.calibration:TREE')
    x, y = 1.18 * 0.5**0.5, 1.18 * 0.5**0.5
    assert tree == [pytest.approx(place, abs=1e-12) for place in ((x, -y), (x, y), (-1.18, 0.0))]


def test_what_a_trial_takes_where_nobody_tells():
    losses = asdict(LossTrialParameters())
    assert {key: losses[key] for key in ('days', 'failures', 'step', 'seed')} == {
        'days': 120.0, 'failures': 100, 'step': 300.0, 'seed': 1,
    }  # fmt: skip
    assert (Conditions().heading, Conditions().slip) == (True, 0.005)
    crowd = asdict(CrowdParameters())
    assert {key: crowd[key] for key in ('trees', 'seed', 'step', 'slowest', 'error', 'skew')} == {
        'trees': 2, 'seed': 1, 'step': 5.0, 'slowest': 0.3, 'error': 0.05, 'skew': 3.0,
    }  # fmt: skip
