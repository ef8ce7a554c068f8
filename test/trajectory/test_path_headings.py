"""Paths of places alone, as planners on grids send them: the robot looks along them."""

from __future__ import annotations

from itertools import pairwise
from math import cos, hypot, isfinite, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.planar import Pose, wrap
from agv_motion.trajectory.ghost import Ghost
from agv_motion.trajectory.path_headings import are_places, stood_on, with_headings

CORNER = [Pose(0.05 * k, 0.0, 0.0) for k in range(41)] + [
    Pose(2.0, 0.05 * k, 0.0) for k in range(1, 41)
]


def distance(pose):
    """Return how far ``pose`` is from the corner that `CORNER` makes [m]."""
    return min(
        hypot(pose.x - min(max(pose.x, 0.0), 2.0), pose.y),
        hypot(pose.x - 2.0, pose.y - min(max(pose.y, 0.0), 2.0)),
    )


@pytest.mark.parametrize(
    ('headings', 'places'),
    [
        ([0.0, 0.0], True), ([0.0, 0.0, 1.0], True), ([0.0, 1.0], False), ([0.0], False),
        ([0.0, 1.0, 0.0], False), ([0.5, 0.0], False), ([], False),
    ],
)  # fmt: skip
def test_identities_up_to_the_goal_are_no_headings(headings, places):
    assert are_places([Pose(float(k), 0.0, h) for k, h in enumerate(headings)]) is places


@pytest.mark.parametrize('backward', [False, True])
@pytest.mark.parametrize('turned', [0.0, pi / 2, -2.0])
def test_a_path_round_a_corner_is_kept_to_a_centimetre(backward, turned):
    c, s = cos(turned), sin(turned)
    path = [Pose(c * p.x - s * p.y, s * p.x + c * p.y, 0.0) for p in CORNER]
    start = Pose(0.0, 0.0, wrap(turned + pi * backward))
    poses = with_headings(start, path, backward=backward)
    trajectory = Ghost(start).compute_path(poses, 0.4, 0.4, 0.4, backward=backward)
    for pose in trajectory.polyline(0.1):
        assert distance(Pose(c * pose.x + s * pose.y, c * pose.y - s * pose.x, 0.0)) < 0.01
    assert abs(wrap(trajectory.end.theta - turned - pi / 2 - pi * backward)) < 1e-9
    assert trajectory.duration < 20.0


def test_a_goal_keeps_the_heading_it_has():
    path = [*CORNER[:-1], CORNER[-1]._replace(theta=-2.0)]
    assert with_headings(Pose(0.0, 0.0, 0.0), path, backward=False)[-1] == path[-1]


@pytest.mark.parametrize(('within', 'heading'), [(0.03, 1.0), (0.01, -pi / 2)])
def test_the_direction_to_where_it_stands_is_its_own(within, heading):
    here, place = Pose(2.0, 1.0, 1.0), Pose(2.0, 0.98, 0.0)
    (pose,) = with_headings(here, [place, place], within, backward=False)
    assert pose == pytest.approx((2.0, 0.98, heading))
    (asked,) = with_headings(here, [place, place._replace(theta=0.5)], within, backward=False)
    assert asked == (2.0, 0.98, 0.5)
    found = stood_on(here, pose, within)
    assert found == (here if within > 0.02 else pose)


@pytest.mark.parametrize(('x', 'left'), [(0.49, 1), (-0.49, 1), (0.51, 2), (-0.51, 2)])
def test_the_first_of_two_places_is_left_out_where_the_robot_stands_on_it(x, left):
    """Hand calculation: they lie 1 m apart, and half of that is on the first."""
    path = [Pose(3.0, 4.0, 0.0), Pose(4.0, 4.0, 0.0)]
    assert len(with_headings(Pose(3.0 + x, 4.0, 0.0), path, backward=False)) == left


PLACES = st.lists(st.tuples(st.integers(-3, 3), st.integers(-3, 3)), min_size=1, max_size=8)


@given(PLACES)
def test_each_place_is_kept_once_with_a_heading_along(places):
    path = [Pose(float(x), float(y), 0.0) for x, y in places]
    start = Pose(-9.0, 0.0, 0.0)
    points = [p[:2] for k, p in enumerate(path) if k == 0 or p[:2] != path[k - 1][:2]]
    poses = with_headings(start, path, backward=False)
    assert [pose[:2] for pose in poses] == points
    before = (start.x, start.y)
    for pose, after in zip(poses, [*points[1:], points[-1]], strict=True):
        dx, dy = after[0] - before[0], after[1] - before[1]
        if (dx, dy) != (0.0, 0.0):
            length = hypot(dx, dy)
            assert cos(pose.theta) == pytest.approx(dx / length, abs=1e-9)
            assert sin(pose.theta) == pytest.approx(dy / length, abs=1e-9)
        before = pose[:2]


@given(
    st.lists(st.sampled_from([0.0, 5e-324, 1.0, 1e17, 1.7e308, -1.7e308]), min_size=4, max_size=8)
)
def test_places_at_the_edge_of_all_numbers_have_headings_too(numbers):
    path = [Pose(x, y, 0.0) for x, y in pairwise(numbers)]
    for pose in with_headings(Pose(0.0, 0.0, 0.0), path, backward=True):
        assert all(map(isfinite, pose))
