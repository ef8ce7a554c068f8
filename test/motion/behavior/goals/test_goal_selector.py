"""The cycle of objectives: highest, lowest, longest unvisited; ties, masks, reasons."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.motion.behavior.goals.goal import Objective
from agv_motion.motion.behavior.goals.goal_selector import GoalSelector, ago
from agv_motion.motion.behavior.goals.reachability import ShortestPath, StraightLine
from agv_motion.motion.behavior.goals.strategy import GoalSetting
from agv_motion.motion.behavior.memory import Memory
from agv_motion.motion.navigation.open_floor import OpenFloor
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.zone import Zone

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]
ZONE = Zone(SQUARE)
PATHS = PathPlanner(ZONE)
NOON = 1434364200.0
HERE = (5.0, 5.0)
WALL = [[4.9, 0], [5.1, 0], [5.1, 8], [4.9, 8]]


def selector(*, paths=PATHS, seed=1, attempts=9, reachability=None):
    """Return a selector for a tree that has arrived within 1 m."""
    setting = GoalSetting(None, seed, attempts, OpenFloor(paths), lambda _objective: 1.0)
    return GoalSelector(setting, reachability or ShortestPath())


def walked(zone=ZONE):
    """Return a memory of three places: bright, dark and fair, one hour after the other."""
    memory = Memory(zone)
    for hour, (x, y, flow) in enumerate([(1.1, 1.1, 0.83), (8.1, 1.1, 0.12), (8.1, 8.1, 0.5)]):
        memory.update(NOON + 3600.0 * hour, x, y, flow)
    return memory


def goals(memory, count, *, paths=PATHS, start=HERE, **parameters):
    cycle = selector(paths=paths, **parameters)
    now = NOON + 3 * 3600.0
    return [cycle.next_goal(memory, start, now) for _ in range(count)]


def test_sun_shade_and_the_unknown_in_turn_with_their_reasons():
    sun, shade, unknown, again = goals(walked(), 4)
    assert sun.reason == 'highest remembered sap flow 0.83 at (1.1, 1.1), felt 3 h ago'
    assert shade.reason == 'lowest remembered sap flow 0.12 at (8.1, 1.1), felt 2 h ago'
    assert unknown.reason.startswith('never visited: (')
    assert again == sun
    assert sun.place == (1.125, 1.125)


def test_where_all_is_visited_the_longest_ago_is_next():
    memory = Memory(ZONE)
    memory.visited_at[memory.cells.walkable] = NOON
    memory.visited_at[20, 30] = NOON - 86400.0
    (goal,) = goals(memory, 1)
    assert goal.objective is Objective.UNKNOWN
    assert goal.reason == 'longest unvisited: (7.6, 5.1), last visited 27 h ago'


def test_the_same_seed_breaks_ties_the_same_way_and_another_does_not():
    memory = Memory(ZONE)
    one, same, other = (goals(memory, 3, seed=seed) for seed in (1, 1, 2))
    assert one == same
    assert one != other


def test_ties_fall_on_every_equal():
    memory = Memory(ZONE)
    for x in (1.1, 3.1, 5.1, 7.1):
        memory.update(NOON, x, 1.1, 0.9)
    cycle = selector()
    chosen = {cycle.best(Objective.SUN, NOON, memory, memory.cells.walkable).x for _ in range(60)}
    assert len(chosen) == 4


FLOWS = st.lists(
    st.tuples(st.floats(0.6, 9.4), st.floats(0.6, 9.4), st.floats(0, 1)), min_size=1, max_size=20
)


@settings(max_examples=40)
@given(FLOWS, st.integers(0, 9))
def test_no_walkable_cell_is_higher_lower_or_longer_unvisited(places, seed):
    memory = Memory(ZONE)
    for i, place in enumerate(places):
        memory.update(NOON + 60.0 * i, *place)
    cycle = selector(seed=seed)
    sun, shade, unknown = (
        cycle.best(w, NOON + 1e4, memory, memory.cells.walkable) for w in Objective
    )
    felt = memory.flow[memory.felt]
    assert memory.flow[memory.cells.cell_of(*sun.place)] == felt.max()
    assert memory.flow[memory.cells.cell_of(*shade.place)] == felt.min()
    assert memory.visited_at[memory.cells.cell_of(*unknown.place)] == memory.visited_at.min()
    assert all(ZONE.walkable(*goal.place) for goal in (sun, shade, unknown))


def test_a_wish_fulfilled_here_passes_its_turn_on():
    (goal,) = goals(walked(), 1, start=(1.0, 1.5))
    assert goal.objective is Objective.SHADE


def test_nothing_remembered_means_the_unknown():
    (goal,) = goals(Memory(ZONE), 1)
    assert goal.objective is Objective.UNKNOWN


def test_goals_lie_in_the_part_where_the_tree_is():
    parted = Zone(SQUARE, [[[4.9, 0], [5.1, 0], [5.1, 9.5], [4.9, 9.5]]])
    memory = walked(parted)
    chosen = goals(memory, 12, paths=PathPlanner(parted), start=(8.0, 5.0))
    assert all(goal.x > 5.0 for goal in chosen)


def test_the_shortest_way_reaches_round_the_corner_and_the_straight_line_does_not():
    zone = Zone(SQUARE, [WALL])
    memory = Memory(zone)
    memory.update(NOON, 1.1, 1.1, 0.9)
    memory.update(NOON, 8.1, 1.1, 0.2)
    memory.visited_at[memory.cells.walkable] = NOON
    paths, start = PathPlanner(zone), (8.5, 3.0)
    (round_the_wall,) = goals(memory, 1, paths=paths, start=start)
    assert round_the_wall.objective is Objective.SUN
    straight = selector(paths=paths, seed=3, reachability=StraightLine())
    goal = straight.next_goal(memory, start, NOON)
    assert 'no straight line leads to' in straight.refusals[0]
    assert goal is None or goal.x > 4.0


def test_goals_that_others_take_are_left_and_told():
    cycle = selector(paths=PATHS.without(shapely.box(0.0, 0.0, 3.0, 3.0)))
    assert cycle.next_goal(walked(), HERE, NOON).objective is Objective.SHADE
    assert 'where another tree is' in cycle.refusals[0]


def test_after_so_many_failures_there_is_no_goal():
    everything = PATHS.without(shapely.box(0.0, 0.0, 4.0, 10.0).union(shapely.box(6, 0, 10, 10)))
    memory = Memory(ZONE)
    memory.visited_at[:, 16:24] = NOON
    cycle = selector(paths=everything, attempts=4)
    assert cycle.next_goal(memory, HERE, NOON) is None
    assert len(cycle.refusals) == 4


def test_a_tree_with_nowhere_to_go_does_not_search_for_ever():
    cell = Zone([[0, 0], [1.2, 0], [1.2, 1.2], [0, 1.2]])
    memory = Memory(cell)
    memory.update(NOON, 0.6, 0.6, 0.5)
    cycle = selector(paths=PathPlanner(cell))
    assert cycle.next_goal(memory, (0.6, 0.6), NOON) is None
    assert cycle.refusals == []


@pytest.mark.parametrize(
    ('seconds', 'words'),
    [
        (-5.0, 'just now'), (59.0, 'just now'), (60.0, '1 min ago'), (3600.0 * 3.9, '3 h ago'),
        (86400.0, '24 h ago'), (86400.0 * 2, '2 days ago'),
    ],
)  # fmt: skip
def test_times_in_words(seconds, words):
    assert ago(seconds) == words


def test_the_faded_flow_decides_where_memory_fades():
    """0.9 of three half-lives ago has faded below 0.7 of now."""
    from agv_motion.motion.behavior.memory import MemoryParameters

    memory = Memory(ZONE, MemoryParameters(half_life=1.0))
    memory.update(NOON - 3 * 3600.0, 1.1, 1.1, 0.9)
    memory.update(NOON, 8.1, 8.1, 0.7)
    memory.update(NOON, 8.1, 1.1, 0.2)
    best = selector().best(Objective.SUN, NOON, memory, np.copy(memory.cells.walkable))
    assert best.place == (8.125, 8.125)
