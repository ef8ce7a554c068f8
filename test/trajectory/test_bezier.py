"""Cubic Bezier curves: ends, tangents, derivatives, curvature."""

from __future__ import annotations

import cmath
from math import pi

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from agv_motion.planar import Pose, wrap
from agv_motion.trajectory.bezier import CubicBezier, connect

NUMBER = st.floats(-10.0, 10.0)
POSES = st.builds(Pose, NUMBER, NUMBER, st.floats(-pi, pi, exclude_max=True))
DELTAS = st.floats(0.05, 2.0)
PARAMETER = st.floats(0.0, 1.0)


def test_the_middle_of_a_curve_by_hand():
    """Control points 0, 1j, 3 + 1j, 3: B(1/2) = (P0 + 3 P1 + 3 P2 + P3) / 8 = 1.5 + 0.75j."""
    curve = CubicBezier(0j, 3 + 0j, 1j, -1j)
    assert curve.point(0.5) == pytest.approx(1.5 + 0.75j, abs=1e-15)
    assert curve.velocity(0.5) == pytest.approx(0.75 * (3 + 3), abs=1e-15)


@given(POSES, POSES, DELTAS)
def test_it_leaves_and_arrives_on_the_poses(start, end, delta):
    assume(abs(complex(end.x - start.x, end.y - start.y)) > 1e-3)
    curve = connect(start, end, delta)
    assert curve.point(0.0) == complex(start.x, start.y)
    assert curve.point(1.0) == pytest.approx(complex(end.x, end.y), abs=1e-13)
    assert wrap(cmath.phase(curve.velocity(0.0)) - start.theta) == pytest.approx(0, abs=1e-12)
    assert wrap(cmath.phase(curve.velocity(1.0)) - end.theta) == pytest.approx(0, abs=1e-10)


@given(POSES, POSES, DELTAS)
def test_backwards_both_tangents_flip(start, end, delta):
    assume(abs(complex(end.x - start.x, end.y - start.y)) > 1e-3)
    forward = connect(start, end, delta)
    backward = connect(start, end, delta, backward=True)
    assert backward.velocity(0.0) == pytest.approx(-forward.velocity(0.0), abs=1e-13)
    assert backward.velocity(1.0) == pytest.approx(-forward.velocity(1.0), abs=1e-12)


@given(POSES, POSES, DELTAS, PARAMETER)
def test_the_derivatives_are_those_of_the_point(start, end, delta, u):
    curve, h = connect(start, end, delta), 1e-5
    slope = (curve.point(u + h) - curve.point(u - h)) / (2 * h)
    bend = (curve.velocity(u + h) - curve.velocity(u - h)) / (2 * h)
    assert curve.velocity(u) == pytest.approx(slope, abs=1e-6)
    assert curve.acceleration(u) == pytest.approx(bend, abs=1e-6)


def test_the_curvature_of_a_nearly_round_quarter():
    """The handles 4/3 (sqrt(2) - 1) r give a circle of radius r = 2 within 0.03 %."""
    handle = 2.0 * 4.0 / 3.0 * (2.0**0.5 - 1.0)
    quarter = CubicBezier(2 + 0j, 2j, handle * 1j, complex(-handle))
    assert quarter.curvature(np.linspace(0, 1, 9)) == pytest.approx(np.full(9, 0.5), rel=0.03)


def test_a_map_far_from_its_origin_costs_no_digits():
    near = connect(Pose(0.0, 0.0, 0.1), Pose(3.0, 1.0, 0.5), 0.4)
    far = connect(Pose(5e6, 4e5, 0.1), Pose(5e6 + 3.0, 4e5 + 1.0, 0.5), 0.4)
    assert far.velocity(0.3) == near.velocity(0.3)
