"""Vp and V as one pure function: the reference, by hand and over random measures."""

from __future__ import annotations

from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.route import FollowParameters, route_speeds
from agv_motion.route.speeds import RouteLimiter

PROFILES = FollowParameters(
    v_dphi=(0.0, 1.0, 1.0, 0.5), v_dn=(0.0, 0.2, 1.0, 0.8), v_alpha=(0.0, 0.1, pi, 0.7),
    v_d=(0.0, 0.0, 1.0, 0.9),
).profiles()  # fmt: skip


@pytest.mark.parametrize(
    ('measures', 'vp', 'speed', 'limiter'),
    [
        ((0.0, 1.0, 0.0, 9.0), 0.8, 0.8, RouteLimiter.WAYPOINT),
        ((0.0, 0.0, pi, 9.0), 0.7, 0.7, RouteLimiter.BEND),
        ((-1.0, 1.0, pi, 9.0), 0.5, 0.5, RouteLimiter.HEADING),
        ((1.0, 1.0, pi, 0.2), 0.5, 0.18, RouteLimiter.TO_GO),
        ((0.0, 0.0, 0.0, 9.0), 0.2, 0.2, RouteLimiter.WAYPOINT),
    ],
)
def test_by_hand(measures, vp, speed, limiter):
    found = route_speeds(PROFILES, *measures)
    assert (found.vp, found.speed) == pytest.approx((vp, speed))
    assert found.limiter is limiter


@given(st.floats(-3.0, 3.0), st.floats(0.0, 2.0), st.floats(0.0, pi), st.floats(0.0, 2.0))
def test_it_is_the_reference(dphi, dn, alpha, d):
    found = route_speeds(PROFILES, dphi, dn, alpha, d)
    vp = min(PROFILES.v_dphi(abs(dphi)), max(PROFILES.v_dn(dn), PROFILES.v_alpha(alpha)))
    assert (found.vp, found.speed) == (vp, min(PROFILES.v_d(d), vp))
