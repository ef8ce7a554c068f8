"""The memory of places: what is felt where, what is visited, and how it fades."""

from __future__ import annotations

from math import floor, nan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.motion.behavior.memory import NEVER, Memory, MemoryParameters
from agv_motion.motion.navigation.zone import Zone

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
COLUMN = [[4, 4], [6, 4], [6, 6], [4, 6]]
ZONE = Zone(SQUARE, [COLUMN])
NOON = 1434364200.0


def memory(**parameters):
    return Memory(ZONE, MemoryParameters(**parameters))


@given(st.floats(-1, 11), st.floats(-1, 11), st.floats(0, 1), st.floats(0.3, 3.0))
def test_one_cell_is_felt_and_those_under_the_platform_are_visited(x, y, flow, reach):
    grid = memory(reach=reach)
    grid.update(NOON, x, y, flow)
    row, column = floor(y / 0.25), floor(x / 0.25)
    felt = [tuple(cell) for cell in np.argwhere(grid.felt)]
    inside = 0 <= row < 40 and 0 <= column < 40 and grid.cells.walkable[row, column]
    assert felt == ([(row, column)] if inside else [])
    assert not inside or (grid.flow[row, column], grid.felt_at[row, column]) == (flow, NOON)
    away = np.hypot(grid.cells.x[None, :] - x, grid.cells.y[:, None] - y)
    clear = abs(away - reach) > 1e-9
    assert (grid.visited == (grid.cells.walkable & (away < reach)))[clear].all()


def test_the_last_feeling_counts():
    grid = memory()
    grid.update(NOON, 1.0, 1.0, 0.2)
    grid.update(NOON + 60.0, 1.1, 1.1, 0.7)
    assert grid.remembered(NOON + 120.0)[4, 4] == 0.7
    assert grid.felt_at[4, 4] == NOON + 60.0


def test_what_was_felt_fades_to_the_mean_by_half_in_a_half_life():
    """0.9 and 0.3 have the mean 0.6; six hours and three half-lives later 0.6 +- 0.3 / 8."""
    grid = memory(half_life=2.0)
    grid.update(NOON, 1.0, 1.0, 0.9)
    grid.update(NOON, 8.0, 8.0, 0.3)
    later = grid.remembered(NOON + 6 * 3600.0)
    assert later[4, 4] == pytest.approx(0.6 + 0.3 / 8.0)
    assert later[32, 32] == pytest.approx(0.6 - 0.3 / 8.0)
    assert np.isnan(later[20, 5])


def test_without_a_half_life_it_never_fades():
    grid = memory()
    grid.update(NOON, 1.0, 1.0, 0.9)
    grid.update(NOON, 8.0, 8.0, 0.3)
    assert grid.remembered(NOON + 1e9)[4, 4] == 0.9


def test_a_clock_set_back_changes_neither_order_nor_age():
    """Restored from 2026 into a simulation of 2015: what comes now is the latest all the same."""
    grid = memory()
    grid.update(NOON + 1e8, 1.0, 1.0, 0.9)
    grid.update(NOON + 1e8 + 60.0, 8.0, 8.0, 0.3)
    grid.update(NOON, 1.0, 8.0, 0.5)
    times = grid.felt_at[4, 4], grid.felt_at[32, 32], grid.felt_at[32, 4]
    assert times == pytest.approx((NOON - 60.0, NOON, NOON))
    grid.update(NOON + 1.0, 1.0, 1.0, 0.5)
    assert grid.felt_at[32, 32] == pytest.approx(NOON)


def test_coverage_counts_the_cells_of_one_part():
    grid = memory(reach=0.3)
    assert grid.coverage() == (0.0, 0.0)
    for x in grid.cells.x:
        for y in grid.cells.y:
            grid.update(NOON, x, y, 0.5)
    assert grid.coverage() == (1.0, 1.0)


def test_recall_gives_everything_back():
    grid, again = memory(), memory()
    grid.update(NOON, 1.0, 1.0, 0.9)
    assert again.recall(grid.grid())
    for one, other in zip(grid.grid(), again.grid(), strict=True):
        assert np.array_equal(one, other, equal_nan=True) if np.ndim(one) else one == other
    assert again.newest == NOON


def test_a_changed_zone_keeps_what_it_shares():
    grid = memory()
    for x, y in ((1.0, 1.0), (8.1, 8.1), (5.1, 2.1)):
        grid.update(NOON, x, y, 0.9)
    # moved by two metres, half of it gone, and a bench where (5, 2) was; cells of another size
    other = Memory(Zone([[-2, -2], [7, -2], [7, 7], [-2, 7]], [[[4, 1], [6, 1], [6, 3], [4, 3]]]),
                   MemoryParameters(cell=0.2))  # fmt: skip
    assert not other.recall(grid.grid())
    assert other.flow[other.cells.cell_of(1.1, 1.1)] == 0.9
    assert not other.felt[:, other.cells.x > 6.5].any()
    assert not other.felt[~other.cells.walkable].any()
    assert not other.visited[~other.cells.walkable].any()
    assert other.visited_at.max() == NOON
    assert other.visited_at.min() == NEVER


@pytest.mark.parametrize(
    ('parameters', 'word'),
    [
        ({'cell': 0.5, 'reach': 0.4}, 'take smaller cells'),
        ({'cell': nan}, 'finite'),
        ({'half_life': -1.0}, 'half_life = -1.0'),
    ],
)
def test_what_cannot_be_remembered_by_is_refused(parameters, word):
    with pytest.raises(ConfigurationError, match=word):
        MemoryParameters(**parameters)
