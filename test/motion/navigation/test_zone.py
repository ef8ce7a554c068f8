"""Zones: what lies where, margins, and drawings that are no zone."""

from __future__ import annotations

from math import inf, nan

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import GeometryError
from agv_motion.motion.navigation.zone import Zone

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
COLUMN = [[4, 4], [6, 4], [6, 6], [4, 6]]
MOSAIC = [[0, 0], [2, 0], [2, 2], [0, 2]]


@pytest.mark.parametrize(
    ('point', 'floor', 'walkable'),
    [
        ((1.0, 1.0), True, True), ((0.4, 5.0), True, False), ((5.0, 5.0), False, False),
        ((3.6, 5.0), True, False), ((3.4, 5.0), True, True), ((11.0, 5.0), False, False),
        ((0.0, 0.0), True, False),
    ],
)  # fmt: skip
def test_floor_and_margin(point, floor, walkable):
    zone = Zone(SQUARE, [COLUMN])
    assert zone.contains(*point) is floor
    assert zone.walkable(*point) is walkable
    assert zone.area == 96.0


def test_turning_is_not_allowed_on_delicate_floor():
    zone = Zone(SQUARE, translation_only=[MOSAIC])
    assert not zone.may_turn(1.0, 1.0)
    assert zone.may_turn(3.0, 3.0)


def test_a_margin_may_part_the_zone():
    hourglass = [[0, 0], [4, 0], [4, 1.6], [6, 1.6], [6, 0], [10, 0], [10, 4], [6, 4], [6, 2.4],
                 [4, 2.4], [4, 4], [0, 4]]  # fmt: skip
    zone = Zone(hourglass)
    assert len(zone.parts) == 2
    assert zone.part_of(2.0, 2.0) is not zone.part_of(8.0, 2.0)
    assert len(Zone(hourglass, margin=0.3).parts) == 1


@pytest.mark.parametrize(
    ('arguments', 'word'),
    [
        ({'boundary': [[0, 0], [1, 1]]}, '2 different corners'),
        ({'boundary': [[0, 0], [4, 4], [4, 0], [0, 4]]}, 'boundary is no polygon'),
        ({'boundary': [[0, 0], [4, nan], [4, 0]]}, 'not finite'),
        ({'boundary': 'everywhere'}, r'list of \[x, y\]'),
        ({'boundary': [[0, 0, 1], [4, 4], [4, 0]]}, r'list of \[x, y\]'),
        ({'boundary': SQUARE, 'holes': [COLUMN, COLUMN]}, 'holes 1 and 2 overlap'),
        ({'boundary': SQUARE, 'holes': [[[20, 20], [21, 20], [21, 21]]]}, 'hole 1 lies outside'),
        ({'boundary': SQUARE, 'holes': [SQUARE]}, 'cover the whole zone'),
        (
            {'boundary': SQUARE, 'translation_only': [[[20, 20], [21, 20], [21, 21]]]},
            'area 1 touches no floor',
        ),
        ({'boundary': SQUARE, 'margin': 6.0}, 'leaves nothing'),
        ({'boundary': SQUARE, 'margin': -1.0}, 'margin = -1.0'),
        ({'boundary': SQUARE, 'holes': [COLUMN], 'home': (5, 5)}, 'home .* lies in hole 1'),
        ({'boundary': SQUARE, 'home': (50, 5)}, 'x from 0 to 10 m'),
        ({'boundary': SQUARE, 'home': (0.1, 5)}, 'nearer than the margin'),
        ({'boundary': SQUARE, 'home': [1]}, r'home must be \[x, y\]'),
        ({'boundary': SQUARE, 'home': [1, nan]}, r'home must be \[x, y\]'),
        ({'boundary': SQUARE, 'margin': inf}, 'margin = inf'),
        (
            {
                'boundary': SQUARE,
                'holes': [[[3, 0], [3.1, 0], [3.1, 9.5], [3, 9.5]]],
                'home': (1, 5),
            },
            'cannot be reached from the largest part',
        ),
    ],
)
def test_what_is_no_zone_is_told(arguments, word):
    with pytest.raises(GeometryError, match=word):
        Zone(**arguments)


@pytest.mark.parametrize(
    ('point', 'holds', 'walkable'),
    [
        ((1.69, 5.0), True, True), ((1.67, 5.0), True, False), ((1.19, 5.0), True, False),
        ((1.17, 5.0), False, False), ((0.01, 5.0), False, False), ((-1.0, 5.0), False, False),
        ((2.81, 5.0), True, False), ((2.83, 5.0), False, False),
    ],
)  # fmt: skip
def test_the_margin_counts_from_the_rim(point, holds, walkable):
    """A disc of 1.18 m, half a metre from the wall at 0 and from the column at 4: 1.68 m to it."""
    zone = Zone(SQUARE, [COLUMN], margin=0.5, rim=1.18)
    assert zone.holds(*point) is holds
    assert zone.walkable(*point) is walkable
    assert zone.clearance == pytest.approx(1.68)


@given(st.floats(-1, 11), st.floats(-1, 11), st.floats(0.0, 0.5), st.floats(0.01, 1.5))
def test_where_the_platform_may_be_all_of_it_keeps_the_margin(x, y, margin, rim):
    """Round the corners of the column too, where an arc inside the circle would be too near."""
    zone = Zone(SQUARE, [COLUMN], margin=margin, rim=rim)
    (part,) = zone.parts
    near = shapely.shortest_line(part, shapely.Point(x, y)).coords[0]
    assert zone.edge_distance(*near) >= rim + margin - 1e-9
    body = shapely.Point(near).buffer(rim - 1e-6, quad_segs=64)
    assert shapely.covers(zone.floor, body)
    if zone.walkable(x, y):
        assert zone.holds(x, y)


@pytest.mark.parametrize(('width', 'parts'), [(2.37, 2), (2.53, 2), (2.56, 1), (2.8, 1)])
def test_a_door_is_as_wide_as_the_platform_and_both_margins(width, parts):
    wall = [
        [[4.9, 0], [5.1, 0], [5.1, 3], [4.9, 3]],
        [[4.9, 3 + width], [5.1, 3 + width], [5.1, 10], [4.9, 10]],
    ]
    assert len(Zone(SQUARE, wall, margin=0.09, rim=1.18).parts) == parts


def test_what_hangs_over_an_edge_is_told_in_metres():
    zone = Zone(SQUARE, margin=0.5, rim=1.18)
    assert zone.why_not(1.0, 5.0) == 'has the rim 0.18 m over an edge'
    assert 'margin of 0.5 m beside the rim of 1.18 m' in zone.why_not(1.5, 5.0)


@pytest.mark.parametrize('rim', [-1.0, nan, inf])
def test_a_rim_that_is_none_is_refused(rim):
    with pytest.raises(GeometryError, match='rim = '):
        Zone(SQUARE, rim=rim)
