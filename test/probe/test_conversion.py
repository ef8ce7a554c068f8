"""From dT and dT_max to K with heartwood and damping, by hand and as the probe uses them."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.probe import Probe, ProbeParameters, flow_index
from agv_motion.probe.calibration import CALIBRATIONS, CalibrationParameters
from agv_motion.probe.conversion import Conversion, sapwood_difference
from agv_motion.probe.damping import DampingParameters
from agv_motion.probe.quality import Quality

DAY = 86400.0
NONE = DampingParameters()


def test_heartwood_by_hand():
    """18 mm of 20 in sapwood, dT 18, dT_max 20: dT_sw = (18 - 2) / 0.9 = 17.7778, K = 0.125."""
    assert sapwood_difference(18.0, 20.0, 0.9) == pytest.approx(160.0 / 9.0, rel=1e-15)
    conversion = Conversion(CALIBRATIONS['granier'], 0.9, NONE)
    assert conversion.index(0.0, 18.0, 20.0) == pytest.approx(0.125, rel=1e-14)


@given(st.floats(5.0, 60.0), st.floats(5.0, 60.0))
def test_a_needle_in_sapwood_alone_is_not_corrected(difference, zero_flow):
    conversion = Conversion(CALIBRATIONS['granier'], 1.0, NONE)
    assert conversion.index(0.0, difference, zero_flow) == flow_index(difference, zero_flow)


def test_heartwood_alone_is_no_reading():
    """Half in heartwood, dT 10 of 20: the sapwood would have none left; of 10.25 it has 0.5 K."""
    half = Conversion(CALIBRATIONS['granier'], 0.5, NONE)
    assert half.index(0.0, 10.0, 20.0) == half.index(0.0, 9.0, 20.0) == inf
    assert half.index(0.0, 10.25, 20.0) == pytest.approx(19.5 / 0.5, rel=1e-14)


def test_an_old_probe_is_scaled():
    old = DampingParameters(installed='2013-01-01', c=0.01)
    conversion = Conversion(CALIBRATIONS['granier'], 1.0, old)
    time = 1_356_998_400.0 + 100.0 * DAY
    assert conversion.index(time, 18.0, 20.0) == pytest.approx(2.0 * 2.0 / 18.0, rel=1e-14)


def readings(**parameters):
    """Return what a probe says at 14:00 of the third day, and then of a dT that is far lower."""
    probe = Probe(ProbeParameters(**parameters))
    for quarter in range(2 * 96 + 57):
        hour = quarter % 96 / 4.0
        value = 20.0 - 1.5 * max(np.sin(np.pi * (hour - 8.0) / 12.0), 0.0) + 0.001 * (quarter % 4)
        reading = probe.update(quarter * 900.0, float(value))
    low = [probe.update((2 * 96 + 57 + k) * 900.0, 9.0) for k in range(3)][-1]
    return reading, low


def test_the_probe_reads_by_all_of_them():
    plain, _ = readings()
    k = (plain.zero_flow - plain.temperature_difference) / plain.temperature_difference
    assert plain.flow_index == pytest.approx(k, rel=1e-14)
    spruce, _ = readings(calibration=CalibrationParameters(of='picea_abies'))
    assert spruce.flux_density == pytest.approx(215.0e-6 * k**1.456, rel=1e-12)
    deep, low = readings(needle_in_sapwood=0.5)
    difference = 2.0 * plain.temperature_difference - plain.zero_flow
    assert deep.flow_index == pytest.approx((plain.zero_flow - difference) / difference, rel=1e-12)
    assert low.quality is Quality.OUT_OF_RANGE
    assert low.flux_density is None
