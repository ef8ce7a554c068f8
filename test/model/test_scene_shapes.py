"""What is drawn stands where it should, and never where nothing is."""

from __future__ import annotations

from math import atan, cos, hypot, inf, nan, pi, sin, tan

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.kinematics.platform import PlatformParameters
from agv_motion.model.footprint import corners_above
from agv_motion.model.robots import tree_model
from agv_motion.model.scene_shapes import (
    FAR,
    SceneShape,
    ShapeKind,
    on_floor,
    outline,
    rotation_centre,
    shadow,
    sun_arrow,
    uncertainty,
    way,
    wheels,
)
from agv_motion.planar import Pose, Twist

BLACK = (0.0, 0.0, 0.0, 1.0)
HERE = Pose(10.0, 5.0, pi / 2)
speeds = st.floats(-2.0, 2.0)


def test_the_outline_lies_about_the_robot_and_tells_where_it_looks():
    rim, front = outline(HERE, 2.0, BLACK)
    assert all(hypot(x - 10.0, y - 5.0) == pytest.approx(2.0) for x, y, _ in rim.points)
    assert rim.points[0] == rim.points[-1]
    assert front.points[-1][:2] == pytest.approx((10.0, 7.0))


def test_the_centre_of_rotation_is_where_all_axes_meet():
    (found,) = rotation_centre(HERE, Twist(0.0, 1.0, 0.5), [(1.0, 0.0, 0.0)], BLACK)
    assert found.kind is ShapeKind.PAIRS
    assert found.points[-1][:2] == pytest.approx((10.0, 3.0))  # 2 m behind: y is forward here
    assert found.points[-2][:2] == pytest.approx((10.0, 6.0))


@pytest.mark.parametrize(
    ('twist', 'end'),
    [
        (Twist(1.0, 0.0, 0.0), (10.0 - FAR, 5.0)),  # to its left, which is west
        (Twist(1.0, 0.0, 1e-9), (10.0 - FAR, 5.0)),
        (Twist(1.0, 0.0, -1e-9), (10.0 + FAR, 5.0)),
        (Twist(0.0, 1.0, 0.0), (10.0, 5.0 - FAR)),
    ],
)
def test_a_centre_that_is_far_is_a_line_towards_it(twist, end):
    (found,) = rotation_centre(HERE, twist, [(1.0, 0.0, 0.0)], BLACK)
    assert found.kind is ShapeKind.LINE
    assert found.points[-1][:2] == pytest.approx(end)


@given(speeds, speeds, st.floats(-1e-3, 1e-3))
def test_no_twist_is_drawn_as_nonsense(vx, vy, wz):
    assert all(s.is_drawable for s in rotation_centre(HERE, Twist(vx, vy, wz), [], BLACK))


def test_at_rest_there_is_no_centre():
    assert rotation_centre(HERE, Twist(0.0, 0.0, 0.0), [], BLACK) == []


def test_arrows_are_as_long_as_wheels_are_fast_and_a_wheel_that_stands_has_none():
    found = wheels(HERE, [(1.0, 0.0, 0.0), (0.0, 1.0, pi / 2)], [0.1, 0.0], 0.2, BLACK)
    (arrow,) = [shape for shape in found if shape.kind is ShapeKind.ARROW]
    assert arrow.points[0][:2] == pytest.approx(on_floor(HERE, 1.0, 0.0))
    assert arrow.points[1][:2] == pytest.approx(on_floor(HERE, 3.0, 0.0))
    assert len(found) == 3


def test_the_ellipse_is_as_long_as_two_deviations_and_lies_along_the_doubt():
    (found,) = uncertainty(HERE, 0.04, 0.0, 0.01, BLACK)
    xs, ys, _ = zip(*found.points, strict=True)
    assert (max(xs) - 10.0, max(ys) - 5.0) == pytest.approx((0.4, 0.2))
    (tilted,) = uncertainty(HERE, 0.02, 0.02, 0.02, BLACK)
    x, y, _ = max(tilted.points)
    assert (x - 10.0, y - 5.0) == pytest.approx((0.4 / 2**0.5, 0.4 / 2**0.5))


@pytest.mark.parametrize('numbers', [(nan, 0, 1), (0, 0, 0), (-1, 0, -1), (inf, 0, 1)])
def test_no_doubt_that_is_none_is_drawn(numbers):
    assert uncertainty(HERE, *numbers, BLACK) == []


def test_the_sun_shines_from_where_it_stands_and_not_at_night():
    arrow, words = sun_arrow(HERE, pi / 4, 0.0, 'in the sun', BLACK)
    assert arrow.points[0] == pytest.approx((10.0 + 3 / 2**0.5, 5.0, 3.0 + 3 / 2**0.5))
    assert words.text == 'in the sun'
    assert [s.kind for s in sun_arrow(HERE, -0.1, 0.0, 'dark', BLACK)] == [ShapeKind.TEXT]


POLE = [(0.1, 0.0, 0.0), (-0.1, 0.0, 0.0), (0.0, 0.2, 0.0), (0.0, 0.0, 4.0)]


def filled(shapes):
    """Return the triangles of a shape."""
    (shape,) = shapes
    assert shape.kind is ShapeKind.TRIANGLES
    assert shape.is_drawable
    corners = [point[:2] for point in shape.points]
    return [shapely.Polygon(corners[i : i + 3]) for i in range(0, len(corners), 3)]


def test_a_shadow_lies_away_from_the_sun_by_hand():
    """A pole of 4 m and a sun in the east, 45 degrees high: the shadow ends 4 m west of it."""
    found = shapely.union_all(filled(shadow(HERE, POLE, pi / 4, 0.0, BLACK)))
    assert found.bounds == pytest.approx((6.0, 4.9, 10.0, 5.1))  # it looks north
    low = shapely.union_all(filled(shadow(HERE, POLE, atan(0.5), pi / 2, BLACK)))
    assert low.bounds[1] == pytest.approx(5.0 - 8.0)


@settings(max_examples=30)
@given(st.floats(0.06, 1.5), st.floats(-pi, pi))
def test_the_shadow_of_a_tree_reaches_to_that_of_its_top_and_is_filled_once(height, azimuth):
    corners = corners_above(tree_model(PlatformParameters(), 'base_link'))[::7]
    parts = filled(shadow(HERE, corners, height, azimuth, BLACK))
    whole = shapely.union_all(parts)
    assert all(part.exterior.is_ccw for part in parts)
    assert whole.area == pytest.approx(sum(part.area for part in parts))
    top = max(z for _, _, z in corners)
    tip = HERE.x - top / tan(height) * cos(azimuth), HERE.y - top / tan(height) * sin(azimuth)
    assert whole.distance(shapely.Point(tip)) <= 0.12  # the trunk is 0.12 m thick


@pytest.mark.parametrize('elevation', [-0.5, 0.0, 0.05])
def test_a_low_sun_and_nothing_cast_no_shadow(elevation):
    assert shadow(HERE, POLE, elevation, 0.0, BLACK) == []
    assert shadow(HERE, [], 1.0, 0.0, BLACK) == []
    assert shadow(HERE, [(0.0, 0.0, 1.0)], 1.0, 0.0, BLACK) == []


@pytest.mark.parametrize('bad', [nan, inf, -inf])
def test_what_is_not_finite_is_not_drawable(bad):
    assert not way('path', [(0.0, 0.0), (bad, 1.0)], BLACK).is_drawable
    assert not way('path', [(0.0, 0.0)], BLACK).is_drawable
    assert SceneShape('goal', ShapeKind.TEXT, ((0.0, 0.0, 0.0),), BLACK, text='a').is_drawable
