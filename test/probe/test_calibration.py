"""Calibrations: Granier's own, rows of the table, and one's own constants."""

from __future__ import annotations

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.probe import flux_density
from agv_motion.probe.calibration import CALIBRATIONS, CalibrationParameters, FluxCalibration


@pytest.mark.parametrize('index', [0.0, -0.1, 0.05, 0.2, 1.7])
def test_without_a_word_it_is_graniers_to_the_last_bit(index):
    assert CalibrationParameters().chosen().flux_density(index) == flux_density(index)


def test_three_rows_by_hand():
    """At K = 0.25: a spruce 215e-6 * 0.25**1.456, a beech 162.2e-6 * 0.25**1.118, a larch."""
    for name, flux in (('picea_abies', 28.566e-6), ('fagus_sylvatica', 34.431e-6),
                       ('larix_decidua', 31.107e-6)):  # fmt: skip
        assert CALIBRATIONS[name].flux_density(0.25) == pytest.approx(flux, rel=1e-4)


def test_ones_own_pair():
    own = CalibrationParameters(of='custom', coefficient=2e-4, exponent=1.5, spread=0.2).chosen()
    assert own == FluxCalibration(2e-4, 1.5, 0.2)
    assert own.flux_density(0.25) == pytest.approx(2.5e-5, rel=1e-15)
    assert CalibrationParameters(coefficient=2e-4).chosen() == CALIBRATIONS['granier']


@pytest.mark.parametrize('name', CALIBRATIONS)
def test_every_row_is_of_the_size_of_graniers(name):
    """Within a factor of four where trees usually are, and rising."""
    row = CALIBRATIONS[name]
    for index in (0.1, 0.2, 0.4):
        assert 0.25 < row.flux_density(index) / flux_density(index) < 4.0
    assert row.flux_density(0.2) < row.flux_density(0.21)
    assert 0.05 < row.spread < 1.0


@pytest.mark.parametrize('change', [{'of': 'oak'}, {'exponent': 0.0}, {'spread': -1.0}])
def test_what_is_no_calibration_is_refused(change):
    with pytest.raises(ConfigurationError, match=next(iter(change))):
        CalibrationParameters(**change)
