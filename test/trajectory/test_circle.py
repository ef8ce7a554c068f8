"""The circle of an arc: on it, at constant curvature, with its tangent."""

from __future__ import annotations

from cmath import phase
from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.planar import Pose, wrap
from agv_motion.trajectory.arc import Arc
from agv_motion.trajectory.circle import Circle

TRACK = 0.4
angles = st.floats(0.1, 12.0) | st.floats(-12.0, -0.1)
speeds = st.sampled_from([0.5, -0.5])
shares = st.floats(0.0, 1.0)


def test_a_quarter_to_the_left_by_hand():
    """From (1, 2) northwards about (0, 2), radius 0.8 + 0.2 m: it ends at (0, 3), westwards."""
    circle = Circle(Arc(pi / 2, 1.6, TRACK, 0.5, 0.3), Pose(1.0, 2.0, pi / 2))
    assert circle.length == pytest.approx(pi / 2)
    assert circle.point(circle.length) == pytest.approx(3j)
    assert circle.velocity(circle.length) == pytest.approx(-1.0)
    assert circle.acceleration(0.0) == pytest.approx(-1.0)  # towards the centre
    assert list(circle.curvature) == pytest.approx([1.0, 1.0])
    assert list(circle.middle_curvature) == pytest.approx([1.0])
    assert list(circle.way) == pytest.approx([0.0, pi / 2])
    assert list(circle.middle_way) == pytest.approx([pi / 4])
    assert circle.locate(0.3) == (circle, 0.3)


@given(angles, speeds, shares)
def test_it_stays_at_one_distance_and_its_tangent_is_its_derivative(angle, speed, share):
    arc = Arc(angle, 1.1, TRACK, speed, 0.3)
    circle = Circle(arc, Pose(0.3, -0.2, 0.7))
    way, h = share * circle.length, 1e-5
    centre = circle.point(0.0) + circle.acceleration(0.0) * arc.radius**2
    assert abs(circle.point(way) - centre) == pytest.approx(arc.radius)
    slope = (circle.point(way + h) - circle.point(way - h)) / (2 * h)
    assert circle.velocity(way) == pytest.approx(slope, abs=1e-8)
    bend = (circle.velocity(way + h) - circle.velocity(way - h)) / (2 * h)
    assert circle.acceleration(way) == pytest.approx(bend, abs=1e-8)


@given(angles, speeds)
def test_the_robot_has_turned_by_the_angle_at_its_end(angle, speed):
    circle = Circle(Arc(angle, 1.1, TRACK, speed, 0.3), Pose(0.0, 0.0, 0.0))
    turned = phase(circle.velocity(circle.length) / circle.velocity(0.0))
    sense = 1.0 if speed > 0 else -1.0
    assert abs(wrap(turned - sense * angle)) < 1e-9
    assert circle.velocity(0.0) == pytest.approx(sense)
