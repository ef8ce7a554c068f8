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


FITTED = """
coniferous 116.6 1.079 0.40
diffuse_porous 153.4 1.095 0.53
ring_porous 120.8 1.124 0.39
abies_concolor 138.9 0.915 0.22
acer_campestre 128.4 1.151 0.62
acer_pseudoplatanus 66.5 0.769 0.17
fagus_grandifolia 203.7 0.899 0.30
fagus_sylvatica 162.2 1.118 0.18
larix_decidua 169.5 1.223 0.10
liquidambar_styraciflua 116.0 1.147 0.26
malus_domestica 134.4 1.201 0.40
picea_abies 215.0 1.456 0.13
pinus_echinata 63.5 0.610 0.18
pinus_taeda 69.4 1.090 0.32
populus_deltoides 151.0 1.019 0.20
populus_nigra 174.5 1.144 0.14
prunus_persica 133.4 1.063 0.18
pseudotsuga_menziesii 112.5 1.181 0.23
quercus_alba 273.1 1.597 0.37
tilia_cordata 115.1 0.947 0.20
ulmus_americana 101.6 0.977 0.28
"""
"""a [g/m2/s], b and the standard deviation of ln F, as fitted to what was published"""


def test_every_row_is_as_it_was_fitted():
    rows = [line.split() for line in FITTED.split('\n')[1:-1]]
    assert len(rows) == 21
    assert list(CALIBRATIONS) == ['granier', *(name for name, *_ in rows)]
    for name, *numbers in rows:
        coefficient, exponent, spread = map(float, numbers)
        expected = pytest.approx((1e-6 * coefficient, exponent, spread), rel=1e-12)
        assert tuple(CALIBRATIONS[name]) == expected, name
    granier = CALIBRATIONS['granier']
    assert granier == FluxCalibration(118.99e-6, 1.231, 0.58)


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
