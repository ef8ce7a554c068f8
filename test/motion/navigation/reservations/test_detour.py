"""The floor that others need, as an area that can be joined and cut."""

from __future__ import annotations

import pytest
import shapely

from agv_motion.motion.navigation.reservations.detour import detour, free_floor, refuge, taken
from agv_motion.motion.navigation.reservations.separation import Floor
from agv_motion.motion.navigation.zone import Zone

BEND = shapely.LineString([
    (7.510008192617384, 5.975102921197097), (8.047236125797108, 5.888543025071769),
    (9.034503167120803, 5.729471377327886), (9.132321720756751, 5.713710536688527),
    (10.71505108559521, 6.316418661235371), (11.784380860587502, 7.629743890579442),
    (12.053784996081891, 9.301781790118579), (11.451076871535047, 10.884511154957037),
    (10.137751642190974, 11.95384092994933), (6.487927799444584, 13.590540632680389),
    (3.125, 14.375),
])  # fmt: skip
"""A path met in a season of five trees: the area round it touches itself, which is invalid."""


ACROSS = shapely.LineString([(6.375, 12.125), (15.718, 10.035)])
CLEARANCE = 3.16


def test_what_others_need_is_joined_even_where_the_area_round_a_way_touches_itself():
    area = taken([(ACROSS, CLEARANCE), (BEND, CLEARANCE)])
    assert area.is_valid
    for path in (ACROSS, BEND):
        assert area.covers(path.buffer(0.999 * CLEARANCE))
    zone = Zone([[0, 0], [20, 0], [20, 15], [0, 15]], margin=0.5)
    floor = free_floor(zone, (1.0, 1.0), area)
    assert floor is not None
    assert min(floor.distance(ACROSS), floor.distance(BEND)) >= CLEARANCE


def test_no_step_to_free_floor_leads_through_floor_that_another_holds():
    """In a corridor the nearer free floor lies beyond the other, which stands 1.5 m away."""
    corridor = Zone([[0, 0], [30, 0], [30, 2.5], [0, 2.5]], margin=1.0)
    ash, wished = shapely.Point(11.5, 1.25), shapely.LineString([(0, 1.25), (11.5, 1.25)])
    blocked = taken([(wished, 2.0)])
    held = [(Floor(ash, ash), 2.0)]
    assert free_floor(corridor, (10.0, 1.25), blocked) is not None
    assert free_floor(corridor, (10.0, 1.25), blocked, held) is None


def test_a_goal_that_is_not_free_is_neared_as_far_as_is_good_enough():
    """Hand calculation: floor ends at x = 4 m, the goal lies at 6 m."""
    zone = Zone([[0, 0], [10, 0], [10, 10], [0, 10]])
    floor = shapely.box(0.0, 0.0, 4.0, 10.0)
    path = detour(zone, (1.0, 5.0), (6.0, 5.0), floor, 2.001)
    assert path is not None
    assert path[-1] == pytest.approx((4.0, 5.0))
    assert detour(zone, (1.0, 5.0), (6.0, 5.0), floor, 1.999) is None


def test_a_refuge_is_the_nearest_floor_that_nobody_wishes_and_can_be_reached():
    zone = Zone([[0, 0], [10, 0], [10, 10], [0, 10]])
    wished = shapely.box(0.0, 3.0, 10.0, 7.0)
    path = refuge(zone, (5.0, 6.0), shapely.box(0.0, 0.0, 10.0, 10.0), wished)
    assert path is not None
    assert path[-1] == pytest.approx((5.0, 7.0))
    assert refuge(zone, (5.0, 5.0), shapely.box(0.0, 3.0, 10.0, 7.0), wished) is None
