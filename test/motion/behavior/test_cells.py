"""The grid over a zone: where its cells lie, and which of them the trunk can be in."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import GeometryError
from agv_motion.motion.behavior.cells import ZoneCells
from agv_motion.motion.navigation.zone import Zone

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
COLUMN = [[4, 4], [6, 4], [6, 6], [4, 6]]
ZONE = Zone(SQUARE, [COLUMN])
CELLS = ZoneCells(ZONE, 0.25)


def test_the_grid_lies_over_the_zone_and_knows_where_the_trunk_can_stand():
    assert CELLS.part.shape == (40, 40)
    assert (CELLS.x[0], CELLS.y[-1]) == (0.125, 9.875)
    expected = [[ZONE.walkable(x, y) for x in CELLS.x] for y in CELLS.y]
    assert (CELLS.walkable == expected).all()
    assert set(CELLS.part[~CELLS.walkable]) == {-1}
    assert CELLS.cell_of(5.0, 5.0) is None  # in the column
    assert CELLS.cell_of(-1.0, 5.0) is None
    assert CELLS.cell_of(1.0, 2.1) == (8, 4)


@pytest.mark.parametrize(('east', 'columns'), [(3.0, 10), (3.1, 11)])
def test_cells_that_just_fit_are_not_one_more(east, columns):
    """3 / 0.3 is above 10 by rounding where the zone lies off the origin."""
    zone = Zone([[0.1, 0.1], [0.1 + east, 0.1], [0.1 + east, 3.1], [0.1, 3.1]])
    assert len(ZoneCells(zone, 0.3).x) == columns


@given(st.floats(-2, 12), st.floats(-2, 12), st.floats(0.1, 4.0))
def test_the_window_about_a_point_holds_all_cells_within_reach(x, y, reach):
    window, within = CELLS.within(x, y, reach)
    found = np.zeros_like(CELLS.walkable)
    found[window] = within
    away = np.hypot(CELLS.x[None, :] - x, CELLS.y[:, None] - y)
    clear = abs(away - reach) > 1e-9
    assert (found == (CELLS.walkable & (away < reach)))[clear].all()


def test_a_place_off_the_floor_counts_to_the_part_that_is_nearest():
    """Two halves, parted by a wall of half a metre at x = 5."""
    cells = ZoneCells(Zone(SQUARE, [[[4.75, 0], [5.25, 0], [5.25, 10], [4.75, 10]]]), 0.25)
    left, right = cells.part_at(1.0, 5.0), cells.part_at(9.0, 5.0)
    assert {left, right} == {0, 1}
    assert (cells.part_at(4.9, 5.0), cells.part_at(5.1, 5.0)) == (left, right)
    assert (cells.part_at(-3.0, 5.0), cells.part_at(13.0, 5.0)) == (left, right)


@pytest.mark.parametrize(
    ('corners', 'size', 'word'),
    [
        ([[0, 0], [2000, 0], [2000, 2000]], 0.1, 'take larger'),
        ([[0, 0], [1.2, 0], [1.2, 1.2], [0, 1.2]], 0.9, 'take smaller'),
    ],
)
def test_cells_that_do_not_fit_are_told(corners, size, word):
    with pytest.raises(GeometryError, match=f'memory.cell = {size} m.*{word}'):
        ZoneCells(Zone(corners), size)
