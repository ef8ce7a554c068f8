"""Litres: an hour and a day by hand, what makes them uncertain, gaps, midnight."""

from __future__ import annotations

from math import exp, log, sqrt

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.probe.calibration import CALIBRATIONS, FluxCalibration
from agv_motion.probe.probe import ProbeReading
from agv_motion.probe.quality import Quality
from agv_motion.probe.water import NORMAL_95, WaterMeter, WaterParameters, days_of

GRANIER = CALIBRATIONS['granier']
EXACT = FluxCalibration(GRANIER.coefficient, GRANIER.exponent, 0.0)
AREA = WaterParameters(sapwood_area=0.02, area_spread=0.0, zero_flow_spread=0.0)
HOUR, DAY = 3600.0, 86400.0


def reading(index, difference=20.0):
    flux = GRANIER.flux_density(index)
    return ProbeReading(0.0, difference, Quality.GOOD, 22.0, index, flux, 0.5)


def test_nothing_is_told_where_no_area_is():
    assert WaterParameters().sapwood_area == 0.0


def test_an_hour_by_hand():
    """K 0.1: F = 118.99e-6 * 0.1**1.231 = 6.9905e-6 m/s; over 200 cm2 0.50332 litres an hour."""
    told = WaterMeter(AREA, EXACT, 0.0).update(0.0, [reading(0.1), None, reading(0.1)])
    assert told.rate == pytest.approx((0.503319, 0.503319, 0.503319), rel=1e-5)
    assert told.day == (0.0, 0.0, 0.0)


def test_a_day_adds_up_and_ends_at_midnight_of_the_place():
    """K 0.1 for 6 h, then to nothing in a straight line within 1 h: 6.5 h at 0.50332 l/h."""
    meter = WaterMeter(AREA, EXACT, 2.0)
    for quarter in range(25):
        told = meter.update(quarter * 900.0, [reading(0.1)])
    told = meter.update(7 * HOUR, [reading(-0.01)])
    assert told.rate.value == 0.0
    assert told.day.value == pytest.approx(6.5 * 0.503319, rel=1e-5)
    assert told.known == 7 * HOUR
    assert meter.update(22 * HOUR - 1.0, [reading(0.1)]).day.value == told.day.value
    assert meter.update(22 * HOUR, [reading(0.1)]).day.value < 1e-3


def test_what_lies_in_a_gap_is_unknown():
    meter = WaterMeter(AREA, EXACT, 0.0)
    meter.update(0.0, [reading(0.1)])
    assert meter.update(HOUR, [reading(0.1)]).known == HOUR
    assert meter.update(2 * HOUR + 1.0, [reading(0.1)]).known == HOUR
    assert meter.update(3 * HOUR, [None]) is None
    assert meter.update(1.5 * HOUR, [reading(0.1)]).known == HOUR  # a clock set back adds nothing


@pytest.mark.parametrize(
    ('given', 'calibration', 'sigma'),
    [
        ({}, FluxCalibration(GRANIER.coefficient, GRANIER.exponent, 0.3), 0.3),
        ({'area_spread': 0.1}, EXACT, sqrt(log(1.01))),
        # dK = 0.2 / 20 of K 0.1 is a tenth, of F 1.231 tenths
        ({'zero_flow_spread': 0.2}, EXACT, sqrt(log(1.0 + 0.1231**2))),
    ],
)
def test_each_uncertainty_by_hand(given, calibration, sigma):
    parameters = WaterParameters(**{'sapwood_area': 0.02, 'area_spread': 0.0,
                                    'zero_flow_spread': 0.0} | given)  # fmt: skip
    value, low, high = WaterMeter(parameters, calibration, 0.0).update(0.0, [reading(0.1)]).rate
    assert (low, high) == pytest.approx(
        (value * exp(-NORMAL_95 * sigma), value * exp(NORMAL_95 * sigma)), rel=1e-9
    )


def test_zero_flow_of_two_probes_is_less_uncertain_than_of_one():
    parameters = WaterParameters(sapwood_area=0.02, area_spread=0.0, zero_flow_spread=0.2)
    one, two = (
        WaterMeter(parameters, EXACT, 0.0).update(0.0, [reading(0.1)] * n).rate for n in (1, 2)
    )
    assert log(one.high / one.value) / log(two.high / two.value) == pytest.approx(2**0.5, rel=0.01)


def test_days():
    times = [k * 900.0 for k in range(2 * 96)]
    rows = [[reading(0.1 if time < DAY else 0.2)] for time in times]
    first, second = days_of(WaterMeter(AREA, EXACT, 0.0), times, rows, 0.0)
    assert (first.day, second.day) == (0, 1)
    assert first.drunk.value == pytest.approx(23.75 * 0.503319, rel=1e-5)
    assert second.highest.value / first.highest.value == pytest.approx(2**1.231)
    assert first.known == pytest.approx(23.75 / 24.0)


@pytest.mark.parametrize('change', [{'sapwood_area': -1.0}, {'area_spread': 2.0}])
def test_a_trunk_that_cannot_be_is_refused(change):
    with pytest.raises(ConfigurationError, match=next(iter(change))):
        WaterParameters(**change)
