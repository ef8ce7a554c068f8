"""The way that is left, and for how long a robot has stood."""

from __future__ import annotations

from math import hypot, isnan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.client.progress import AHEAD, MOVED, TURNED, RemainingPath, StandWatch
from agv_motion.planar import Pose

CORNER = [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)]


@pytest.mark.parametrize(
    ('place', 'left'),
    [((0, 0), 7.0), ((1, 0), 6.0), ((1, 0.5), 6.5), ((3, 1), 3.0), ((3, 4), 0.0), ((3, 5), 1.0)],
)
def test_the_way_left_is_to_the_path_and_on_to_its_end(place, left):
    """From (1, 0.5): half a metre to the path, two to the corner, four to the end."""
    assert RemainingPath(CORNER).left(place) == pytest.approx(left)


@given(st.lists(st.floats(0.0, 7.0), min_size=1, max_size=6))
def test_on_the_path_it_is_the_length_that_is_left(ways):
    path = RemainingPath(CORNER)
    for way in sorted(ways):
        place = (way, 0.0) if way <= 3.0 else (3.0, way - 3.0)
        assert path.left(place) == pytest.approx(7.0 - way, abs=1e-9)


def test_a_path_that_comes_back_to_its_start_is_not_cut_short():
    side = 2 * AHEAD
    loop = [(float(i), 0.0) for i in range(side)] + [(float(side - i), 1.0) for i in range(side)]
    assert RemainingPath([*loop, (0.0, 0.0)]).left((0.0, 0.0)) > 2.0 * (side - 1)


def test_it_never_goes_back():
    path = RemainingPath(CORNER)
    path.left((3.0, 2.0))
    assert path.left((1.0, 0.0)) == pytest.approx(hypot(2.0, 0.0) + 4.0)


def test_where_a_path_turns_on_the_spot_it_goes_on():
    turn = [(0.0, 0.0)] * (3 * AHEAD)
    path = RemainingPath([*turn, (1.0, 0.0), *[(1.0, 0.0)] * (3 * AHEAD), (1.0, 2.0)])
    assert path.left((0.5, 0.0)) == pytest.approx(2.5)
    assert path.left((1.0, 1.5)) == pytest.approx(0.5)


@pytest.mark.parametrize(('points', 'left'), [([(1.0, 1.0)], 1.0), ([(1.0, 1.0)] * 3, 1.0)])
def test_a_path_of_one_place_is_straight_there(points, left):
    assert RemainingPath(points).left((1.0, 0.0)) == left


def test_without_a_path_nobody_knows():
    assert isnan(RemainingPath([]).left((0.0, 0.0)))


@pytest.mark.parametrize(
    ('step', 'stands'),
    [
        (Pose(0.9 * MOVED, 0.0, 0.0), True),
        (Pose(1.1 * MOVED, 0.0, 0.0), False),
        (Pose(0.0, 0.0, 0.9 * TURNED), True),
        (Pose(0.0, 0.0, -1.1 * TURNED), False),
    ],
)
def test_it_stands_unless_it_moves_or_turns(step, stands):
    watch = StandWatch(0.0)
    watch.look(Pose(0.0, 0.0, 0.0), 1.0)
    watch.look(step, 5.0)
    assert watch.seconds(6.0) == (5.0 if stands else 1.0)


def test_one_that_creeps_does_not_stand():
    watch = StandWatch(0.0)
    for i in range(100):
        watch.look(Pose(0.3 * MOVED * i, 0.0, 0.0), float(i))
    assert watch.seconds(99.0) <= 4.0
    watch.begin(99.0)
    assert watch.seconds(100.0) == 1.0
