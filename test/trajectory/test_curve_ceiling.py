"""The speed allowed at the nodes of a curve: the limits hold between the nodes too."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.trajectory.curve_ceiling import curve_ceiling
from agv_motion.trajectory.limits import LateralAcceleration, TurnRate, TurnStep

LIMITS = [LateralAcceleration(0.5), TurnRate(1.0)]


def course(way, curvature, middle_way, middle_curvature):
    return SimpleNamespace(
        length=float(way[-1]), way=np.array(way, float), curvature=np.array(curvature, float),
        middle_way=np.array(middle_way, float),
        middle_curvature=np.array(middle_curvature, float),
    )  # fmt: skip


def test_an_even_bend_has_the_limit_everywhere():
    """1/2 per metre: sqrt(0.5 / 0.5) by the acceleration, 2 m/s by the turn rate."""
    even = course([0, 1, 2], [0.5, 0.5, 0.5], [0.5, 1.5], [0.5, 0.5])
    assert curve_ceiling(even, LIMITS, 3.0) == pytest.approx([1.0, 1.0, 1.0])
    assert curve_ceiling(even, LIMITS, 0.8) == pytest.approx([0.8, 0.8, 0.8])
    assert curve_ceiling(even, [], 3.0) == pytest.approx([3.0, 3.0, 3.0])


def test_a_bend_between_two_nodes_is_not_passed_over():
    """In the middle 1 m/s at most (square 1), at the ends 3 (square 9): the line comes down."""
    hidden = course([0, 1], [0.0, 0.0], [0.5], [0.5])
    first, last = curve_ceiling(hidden, LIMITS, 3.0) ** 2
    assert 0.5 * (first + last) == pytest.approx(1.0)


def test_where_it_is_by_little_both_ends_give_as_much():
    """A ceiling of 1 at the ends and of 0.98 between, in squares: both come down by 0.02."""
    shallow = course([0, 1], [0.5, 0.5], [0.5], [0.5 / 0.98])
    assert curve_ceiling(shallow, LIMITS, 3.0) ** 2 == pytest.approx([0.98, 0.98])


def test_at_a_joint_both_ends_obey_the_lowest():
    """The curvature jumps by 1 per metre: 0.3 m/s for a step of 0.3 rad/s."""
    joint = course([0, 1, 1, 2], [0.0, 0.0, 1.0, 1.0], [0.5, 1.0, 1.5], [0.0, 0.5, 1.0])
    ceiling = curve_ceiling(joint, [*LIMITS, TurnStep(0.3)], 3.0)
    assert ceiling[1:3] == pytest.approx([0.3, 0.3])
    assert ceiling[0] > 2.0
    assert np.isfinite(ceiling).all()


@settings(max_examples=50)
@given(
    st.lists(st.floats(-3.0, 3.0), min_size=2, max_size=8),
    st.lists(st.tuples(st.floats(0.3, 0.7), st.floats(-3.0, 3.0)), min_size=7, max_size=7),
)
def test_the_line_between_two_nodes_never_goes_over_the_middle(curvature, middles):
    cells = len(curvature) - 1
    shares, bends = zip(*middles[:cells], strict=True)
    way = np.arange(cells + 1.0)
    middle = [k + share for k, share in enumerate(shares)]
    given_course = course(way, curvature, middle, bends)
    square = curve_ceiling(given_course, LIMITS, 2.0) ** 2
    for k, (share, bend) in enumerate(zip(shares, bends, strict=True)):
        most = min(limit.ceiling(np.array([bend]))[0] for limit in LIMITS)
        line = square[k] + share * (square[k + 1] - square[k])
        assert line <= min(most, 2.0) ** 2 * (1 + 1e-9)
    for node, bend in zip(square, curvature, strict=True):
        most = min(limit.ceiling(np.array([bend]))[0] for limit in LIMITS)
        assert 0.0 < node <= min(most, 2.0) ** 2 * (1 + 1e-9)


@pytest.mark.parametrize(('squares', 'share', 'between', 'lowered'), [
    ((4.0, 2.0), 0.5, 2.7, (3.6, 1.8)), ((2.0, 4.0), 0.5, 2.7, (1.8, 3.6)),
    ((4.0, 2.0), 0.25, 3.2, (11 / 3, 1.8)), ((2.0, 4.0), 0.75, 3.2, (1.8, 11 / 3)),
    ((4.0, 2.0), 0.25, 3.5, (4.0, 2.0)), ((4.0, 2.0), 0.25, 3.4, (3.9, 1.9)),
])  # fmt: skip
def test_ends_give_a_tenth_at_most_and_then_the_higher_one_more(squares, share, between, lowered):
    """Squares by 1 m/s2 of lateral acceleration; the line meets what is allowed between them."""
    bend = course([0, 1], [1.0 / square for square in squares], [share], [1.0 / between])
    found = curve_ceiling(bend, [LateralAcceleration(1.0)], 9.0) ** 2
    assert found == pytest.approx(lowered)


@pytest.mark.parametrize(('short', 'joint'), [(5e-10, True), (5e-9, False)])
def test_a_joint_is_where_there_is_no_way_in_comparison_with_the_whole(short, joint):
    """A kilometre, by a million millionth."""
    way, curvature = [0, 500, 500 + short, 1000], [0.0, 0.0, 1.0, 1.0]
    steps = course(way, curvature, [250, 500 + short / 2, 750], [0.0, 0.5, 1.0])
    ceiling = curve_ceiling(steps, [TurnStep(0.3)], 3.0)
    assert ceiling[1:3] == pytest.approx([0.3, 0.3] if joint else [3.0, 3.0])
