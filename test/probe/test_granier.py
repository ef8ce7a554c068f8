"""Granier's equations against hand calculations."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.probe.granier import flow_index, flux_density, flux_density_columns


def test_the_worked_example():
    """dT_max = 10 K, dT = 8 K: K = 0.25, F = 118.99e-6 * 0.25**1.231 = 2.1596e-5 m/s."""
    index = flow_index(8.0, 10.0)
    assert index == 0.25
    assert flux_density(index) == pytest.approx(118.99e-6 * np.exp(1.231 * np.log(0.25)), rel=1e-14)
    assert flux_density(index) == pytest.approx(2.1596e-5, rel=1e-4)


def test_the_equivalent_in_centimetres_an_hour():
    """42.84 K^1.231 cm3 cm-2 h-1 is the same calibration."""
    assert flux_density(1.0) * 3600.0 * 100.0 == pytest.approx(42.84, rel=1e-3)


def test_no_flow_above_the_zero_flow_value():
    assert flow_index(11.0, 10.0) < 0.0
    assert flux_density(flow_index(11.0, 10.0)) == 0.0


@given(st.floats(0.5, 60.0), st.floats(0.5, 60.0), st.floats(0.01, 100.0))
def test_the_unit_of_the_temperature_does_not_matter(difference, zero_flow, factor):
    scaled = flow_index(factor * difference, factor * zero_flow)
    assert scaled == pytest.approx(flow_index(difference, zero_flow), rel=1e-9, abs=1e-12)


@given(
    st.lists(
        st.tuples(st.sampled_from([-1.0, 0.0, 0.1, 5.0, 20.0]), st.floats(0.5, 60.0)), min_size=1
    )
)
def test_columns_equal_rows(rows):
    difference, zero_flow = np.array(rows).T
    expected = [
        flux_density(flow_index(d, z)) if d > 0.0 else np.nan
        for d, z in zip(difference, zero_flow, strict=True)
    ]
    np.testing.assert_allclose(flux_density_columns(difference, zero_flow), expected, rtol=1e-12)
