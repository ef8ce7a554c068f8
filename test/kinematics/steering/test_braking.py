"""Rates that fall in time."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from agv_motion.kinematics.steering.braking import braking_rate


@given(st.floats(0.0, 10.0), st.floats(0.01, 100.0), st.floats(0.001, 1.0))
def test_a_braking_rate_stops_in_time(distance, acceleration, period):
    """Step by step, each rate lower by what the acceleration allows: never past the mark."""
    rate, way = braking_rate(distance, acceleration, period), 0.0
    for _ in range(10000):
        way += rate * period
        rate = max(rate - acceleration * period, 0.0)
        if not rate:
            break
    assert way <= distance * (1.0 + 1e-9) + acceleration * period**2 / 8.0
