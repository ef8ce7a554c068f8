"""What is asked of the planner: its limits come first, its cost is bounded, no number ends it."""

from __future__ import annotations

from math import inf, isfinite, nan, pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import AgvMotionError, ConfigurationError
from agv_motion.planar import Pose
from agv_motion.trajectory.arc_length import MOST_CELLS_IN_ALL
from agv_motion.trajectory.bounds import NO_RAMP
from agv_motion.trajectory.feasibility import MOST_LINES
from agv_motion.trajectory.ghost import Ghost
from agv_motion.trajectory.ghost_parameters import GhostParameters

ORIGIN = Pose(0.0, 0.0, 0.0)
PACE = 0.4, 0.4
EDGES = st.sampled_from([
    0.0, -0.0, 5e-324, 1e-310, 1e-160, 1e-12, 1e-9, 2e-9, 1e-3, 1.0, pi, 125.0, 1e4, 9e15, 1e100,
    1e154, 1e300, 1.7976931348623157e308, inf, nan,
])  # fmt: skip
NUMBERS = st.one_of(
    st.floats(-5.0, 5.0), st.tuples(EDGES, st.sampled_from([1.0, -1.0])).map(lambda p: p[0] * p[1])
)
PACES = st.one_of(st.floats(0.1, 2.0), st.floats(0.1, 2.0), NUMBERS)
POSES = st.builds(Pose, NUMBERS, NUMBERS, NUMBERS)
ORDERS = st.one_of(
    st.tuples(st.just('compute_trajectory'), st.tuples(POSES, PACES, PACES, PACES)),
    st.tuples(st.just('compute_path'), st.tuples(st.lists(POSES, max_size=4), PACES, PACES, PACES)),
    st.tuples(st.just('compute_arc'), st.tuples(NUMBERS, NUMBERS, PACES, PACES)),
    st.tuples(st.just('compute_turn'), st.tuples(NUMBERS, PACES, PACES)),
)


@settings(max_examples=150)
@given(ORDERS, st.sampled_from([0.0, 0.3]), st.booleans(), st.lists(st.floats(0.0, 0.4)))
def test_whatever_is_asked_it_is_planned_in_finite_numbers_or_refused(order, rounding, moving, dts):
    ghost = Ghost(ORIGIN, GhostParameters(s_curve=rounding))
    ghost.lock(state=False)
    if moving:
        ghost.compute_trajectory(Pose(3.0, 1.0, 0.5), 0.4, *PACE)
        ghost.advance(1.5)
    what, numbers = order
    try:
        trajectory = getattr(ghost, what)(*numbers)
    except AgvMotionError:
        return
    assert trajectory.duration <= GhostParameters().longest_time
    assert len(trajectory.polyline(0.05, 500)) <= 502
    assert len(ghost.report().lines()) <= MOST_LINES
    for share in dts:
        ghost.advance(share * trajectory.duration)
        pose, *speeds = ghost.controller_kinetics(0.02)
        assert all(map(isfinite, (*pose, *speeds)))


@pytest.mark.parametrize(
    ('order', 'numbers', 'words'),
    [
        ('compute_arc', (125.0, 10.0, 0.4, 0.02), r'of .* s or more: at most 7200 s .*faster'),
        ('compute_arc', (0.01, 9e15, 0.4, 0.4), r'diameter = 9.* m: must lie in \[0, 1e\+09\]'),
        ('compute_arc', (0.01, 10.0, 0.4, 5e-324), 'speed .* = 5e-324 m/s: must lie in'),
        ('compute_arc', (1e3, 10.0, 0.4, 0.4), r'a way of 5150 m: at most 1000 m \(longest_way\)'),
        ('compute_trajectory', (Pose(1e4, 0, 0), 0.4, *PACE), 'a way of 10000 m: at most 1000 m'),
        ('compute_trajectory', (Pose(1e308, -1e308, 0), 0.0, *PACE), r'a way of 1\.4142e\+308 m'),
        ('compute_trajectory', (Pose(9, 0, 0), 0.4, 0.4, 1e-3), '9000 s or more: at most 7200 s'),
        ('compute_turn', (1.0, 0.4, 0.0), r'rate of a turn = 0.0 rad/s: must lie .* rad/s$'),
        ('compute_turn', (1.0, -0.4, 0.4), r'ramps of a turn = -0.4 rad/s2: must lie .* rad/s2;'),
        ('compute_turn', (1e6, *PACE), '2.5e.06 s or more: at most 7200 s'),
        ('compute_path', ([Pose(0.1, 0, 0)] * 20000, 0.4, *PACE), '20000 poses.*every 20th pose'),
        ('compute_path', ([Pose(0.1, 0, 0), Pose(0.2, 0, 1)] * 200, 0.0, *PACE), 'in parts'),
    ],
)
def test_what_is_too_much_is_told_with_limit_and_remedy(order, numbers, words):
    ghost = Ghost(ORIGIN)
    before = ghost.trajectory
    with pytest.raises(ConfigurationError, match=words):
        getattr(ghost, order)(*numbers)
    assert ghost.trajectory is before


def test_a_turn_to_a_heading_is_refused_in_the_units_of_a_turn():
    with pytest.raises(ConfigurationError, match=r'rate of a turn = 0.0 rad/s: must lie'):
        Ghost(ORIGIN).compute_trajectory(ORIGIN, 0.0, 0.4, 0.0, pure_rotation=True)


def test_a_long_curve_that_takes_its_time_is_refused_though_its_chord_is_short():
    """Handles of 5 times the distance lead 300 m about; the bends slow it down further."""
    ghost = Ghost(ORIGIN, GhostParameters(longest_way=200.0))
    with pytest.raises(ConfigurationError, match='at most 200 m'):
        ghost.compute_trajectory(Pose(50.0, 0.0, pi / 2), 5.0, *PACE)


def test_the_cost_of_a_path_is_bounded_by_its_cells():
    """A thousand curves of five centimetres: a table of so many cells, and a drawing of 500."""
    ghost = Ghost(ORIGIN)
    poses = [Pose(0.05 * k, 0.001 * (k % 2), 0.0) for k in range(1, 1001)]
    trajectory = ghost.compute_path(poses, 0.4, *PACE)
    (drive,) = trajectory.motions
    assert len(drive.course.way) <= MOST_CELLS_IN_ALL + 1000
    assert trajectory.pose(trajectory.duration) == poses[-1]
    assert len(trajectory.polyline(0.05, 500)) <= 502
    wild = [Pose(k % 7, k % 3, float(k)) for k in range(1000)]
    with pytest.raises(AgvMotionError, match='at most 1000 m'):
        ghost.compute_path(wild, 0.4, *PACE)


@pytest.mark.parametrize('order', ['trajectory', 'turn', 'arc'])
def test_no_ramp_by_name_is_at_full_speed_at_once(order):
    """2 m at 0.4 m/s, 2 rad at 0.4 rad/s, 2 m of the outer wheel: 5 s without a ramp."""
    limits = GhostParameters(lateral_acceleration=9.0)
    ghost = Ghost(ORIGIN, limits)
    ghost.lock(state=False)
    if order == 'trajectory':
        trajectory = ghost.compute_trajectory(Pose(2.0, 0.0, 0.0), 0.0, NO_RAMP, 0.4)
    elif order == 'turn':
        trajectory = ghost.compute_turn(2.0, NO_RAMP, 0.4)
    else:
        trajectory = ghost.compute_arc(2.0 / 0.8, 1.0, NO_RAMP, 0.4)
    assert trajectory.duration == pytest.approx(5.0, rel=1e-12)
    ghost.advance(2.5)
    linear, angular = ghost.speeds
    expected = {'trajectory': 0.4, 'turn': 0.4, 'arc': 0.4 * 0.65 / 0.8}[order]
    assert (angular if order == 'turn' else linear) == pytest.approx(expected)
    ghost.brake_and_end()
    assert ghost.finished
    assert ghost.speeds == (0.0, 0.0)


@pytest.mark.parametrize('delta', [0.0, 0.4])
@pytest.mark.parametrize('aside', [5e-324, -5e-324, 1e-310])
def test_a_goal_aside_by_less_than_any_angle_lies_straight_ahead(delta, aside):
    ghost = Ghost(ORIGIN)
    trajectory = ghost.compute_trajectory(Pose(900.0, aside, 0.0), delta, *PACE)
    assert trajectory.pose(100.0).theta == pytest.approx(0.0, abs=1e-12)
    assert trajectory.pose(100.0).y == pytest.approx(0.0, abs=1e-9)


def test_the_time_of_an_arc_is_its_length_by_its_speed():
    """1.45 m at 0.02 m/s are 72.5 s: refused before the ramps of 10 s are planned."""
    given = GhostParameters(longest_time=60.0)
    with pytest.raises(ConfigurationError, match=r'of 72\.5 s or more: at most 60 s'):
        Ghost(ORIGIN, given).compute_arc(2.0, 1.0 - given.track / 2.0, 0.002, 0.02)
