"""What a robot covers of the floor, by hand and by laws."""

from __future__ import annotations

from math import hypot, pi, sqrt

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.kinematics.differential_platform import DifferentialBaseParameters
from agv_motion.kinematics.platform import PlatformParameters
from agv_motion.model.footprint import disc, footprint, steering_joints
from agv_motion.model.robots import differential_model, tree_model
from agv_motion.model.urdf_reading import read_urdf
from agv_motion.planar import Pose

TREE = tree_model(PlatformParameters(), 'base_link')
ANGLES = {name: 0.3 for name in TREE.moving if name.endswith('_steering')}


def robot(body, more=''):
    joint = (
        '<joint name="j" type="continuous"><parent link="a"/><child link="b"/>'
        '<origin xyz="1 0 0"/><axis xyz="0 1 0"/></joint>'
    )
    return (
        f'<robot name="r"><link name="a">{body}</link><link name="b">{more}</link>{joint}</robot>'
    )


def seen(shape, origin='', tag='visual'):
    return f'<{tag}>{origin}<geometry>{shape}</geometry></{tag}>'


def bounds(outline):
    return shapely.Polygon(outline).bounds


def test_a_tree_is_its_disc_with_a_turret_and_a_wheel_at_each_corner():
    found = footprint(TREE, ANGLES)
    assert bounds(found.body) == pytest.approx((-1.18, -1.18, 1.18, 1.18))
    assert (len(found.turrets), len(found.wheels)) == (3, 3)
    assert max(hypot(x, y) for x, y in found.body) == pytest.approx(1.18)
    for wheel, x in zip(found.wheels, PlatformParameters().turret_x, strict=True):
        assert shapely.Polygon(wheel).centroid.x == pytest.approx(x)


@given(st.floats(-10.0, 10.0))
def test_a_wheel_lies_along_the_angle_of_its_turret(angle):
    """A wheel of 0.1 m radius: 0.2 m long, along its turret."""
    found = footprint(TREE, ANGLES | {'turret_2_steering': angle})
    wheel = shapely.Polygon(found.wheels[2])
    straight = shapely.affinity.rotate(wheel, -angle, use_radians=True)
    west, south, east, north = straight.bounds
    assert (east - west, north - south) == pytest.approx((0.2, 0.066), abs=1e-6)


def test_wheels_whose_turrets_nobody_tells_of_are_left_out():
    assert steering_joints(TREE) == [f'turret_{i}_steering' for i in range(3)]
    found = footprint(TREE, {})
    assert (len(found.turrets), found.wheels) == (3, ())
    assert len(footprint(TREE, {'turret_1_steering': 0.0}).wheels) == 1


def test_a_differential_drive_by_hand():
    """The body of a track of 0.3 m: 0.36 m by 0.255 m; wheels of 5 cm radius at +-0.15 m."""
    found = footprint(differential_model(DifferentialBaseParameters(), 'base_link'), {})
    assert bounds(found.body) == pytest.approx((-0.18, -0.1275, 0.18, 0.1275))
    left, right = found.wheels
    assert bounds(left) == pytest.approx((-0.05, 0.1335, 0.05, 0.1665))
    assert bounds(right) == pytest.approx((-0.05, -0.1665, 0.05, -0.1335))


def test_a_robot_in_the_map_is_turned_and_moved():
    found = footprint(TREE, ANGLES).at(Pose(5.0, 3.0, pi / 2.0))
    assert shapely.Polygon(found.body).centroid.coords[0] == pytest.approx((5.0, 3.0))
    front = shapely.Polygon(found.wheels[1]).centroid  # turret 1 stands front left
    assert (front.x, front.y) == pytest.approx((5.0 - 1.18 / sqrt(2.0), 3.0 + 1.18 / sqrt(2.0)))


@pytest.mark.parametrize(
    ('shape', 'origin', 'expected'),
    [
        ('<box size="2 1 0.5"/>', '', (-1.0, -0.5, 1.0, 0.5)),
        ('<box size="2 1 0.5"/>', '<origin xyz="1 2 9" rpy="0 0 1.570796326794896"/>',
         (0.5, 1.0, 1.5, 3.0)),
        ('<sphere radius="0.5"/>', '<origin xyz="1 0 0" rpy="1 1 1"/>', (0.5, -0.5, 1.5, 0.5)),
        ('<cylinder radius="0.5" length="3"/>', '<origin rpy="1.570796326794896 0 0"/>',
         (-0.5, -1.5, 0.5, 1.5)),
    ],
)  # fmt: skip
def test_shapes_of_anybody_at_their_places(shape, origin, expected):
    found = footprint(read_urdf(robot(seen(shape, origin))), {})
    assert bounds(found.body) == pytest.approx(expected)


def test_what_is_no_visual_is_taken_from_the_collision_shapes():
    urdf = robot(seen('<box size="1 1 1"/>', tag='collision'))
    assert bounds(footprint(read_urdf(urdf), {}).body) == pytest.approx((-0.5, -0.5, 0.5, 0.5))


@pytest.mark.parametrize(
    'body',
    [
        '', seen('<mesh filename="body.stl"/>'), seen('<box size="1 1"/>'),
        seen('<box size="1 1 nan"/>'), seen(''), '<visual/>', seen('<cylinder radius="1"/>'),
        seen('<box size="1 1 1"/>', '<origin xyz="a b c"/>'),
        seen('<box size="1 1 1"/>') + seen('<mesh filename="arm.stl"/>'),
    ],
)  # fmt: skip
def test_a_size_that_is_not_told_is_not_known(body):
    """And nothing is refused: its transforms hold."""
    model = read_urdf(robot(body, seen('<box size="1 1 1"/>')))
    assert footprint(model, {}) is None
    assert model.moving['j'].place == (1.0, 0.0, 0.0)


def test_a_wheel_of_unknown_shape_leaves_the_body_known():
    found = footprint(
        read_urdf(robot(seen('<box size="1 1 1"/>'), seen('<mesh filename="w.stl"/>'))), {}
    )
    assert (len(found.body), found.wheels) == (5, ())
    assert found.reach == pytest.approx(sqrt(0.5))


def test_a_disc_reaches_as_far_as_it_is_told():
    assert disc(0.7).reach == pytest.approx(0.7)
