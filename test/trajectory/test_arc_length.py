"""Arc length against mpmath, and its inverse against itself."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import GeometryError
from agv_motion.planar import Pose
from agv_motion.trajectory.arc_length import GAUSS_NODES, GAUSS_WEIGHTS, ArcLength
from agv_motion.trajectory.bezier import CubicBezier, connect

ANGLES = st.floats(-pi, pi, exclude_max=True)
CURVES = st.builds(
    lambda distance, bearing, first, last, delta: connect(
        Pose(0.0, 0.0, first),
        Pose(distance * np.cos(bearing), distance * np.sin(bearing), last),
        delta,
    ),
    st.floats(0.01, 100.0), ANGLES, ANGLES, ANGLES, st.floats(0.05, 2.0),
)  # fmt: skip


def measured(curve):
    """Return the length by mpmath, cut where the curve is nearest to a cusp."""
    import mpmath  # it takes long where tests are only listed

    u = np.linspace(0.0, 1.0, 4001)
    speed = np.abs(curve.velocity(u))
    slowest = u[1:-1][(speed[1:-1] <= speed[:-2]) & (speed[1:-1] <= speed[2:])]
    cuts = {float(s + d) for s in slowest for d in (-0.05, -5e-3, -5e-4, 0, 5e-4, 5e-3, 0.05)}
    points = sorted({0.0, *(cut for cut in cuts if 0.0 < cut < 1.0), 1.0})
    return float(mpmath.quad(lambda x: abs(curve.velocity(float(x))), points, maxdegree=5))


@settings(max_examples=12)
@given(CURVES)
def test_the_length_is_that_of_mpmath(curve):
    try:
        length = ArcLength([curve]).length
    except GeometryError:
        return  # a cusp, told as one
    assert length == pytest.approx(measured(curve), rel=1e-9)


@given(CURVES)
def test_the_hodograph_hardly_changes_in_a_cell(curve):
    """By equation (1), with q = 5 %."""
    try:
        course = ArcLength([curve])
    except GeometryError:
        return
    _, u, width = course._inverse._cells[:, :3].T  # noqa: SLF001 - the table itself
    assert np.abs(curve.velocity(u + width) / curve.velocity(u) - 1.0).max() <= 0.05


@given(CURVES, st.floats(0.0, 1.0))
def test_the_inverse_gives_back_the_way(curve, share):
    try:
        course = ArcLength([curve])
    except GeometryError:
        return
    way = share * course.length
    _, u = course.locate(way)
    nodes = course._inverse._cells[:, 1]  # noqa: SLF001 - where |P'| is tame
    ends = np.append(nodes[nodes < u], u)
    inside = ends[:-1, None] + np.diff(ends)[:, None] * GAUSS_NODES
    back = float((np.diff(ends)[:, None] * np.abs(curve.velocity(inside)) @ GAUSS_WEIGHTS).sum())
    assert back == pytest.approx(way, abs=1e-11 * course.length)


def test_a_straight_line_with_handles_of_a_third_is_gone_evenly():
    course = ArcLength([connect(Pose(0, 0, 0), Pose(3, 0, 0), 1 / 3)])
    assert course.length == pytest.approx(3.0, abs=1e-15)
    curve, u = course.locate(1.2)
    assert curve.point(u) == pytest.approx(1.2, abs=1e-12)


def test_nearly_no_handles_do_not_freeze_the_way():
    """At the ends P' is a millionth of what it is between; the way must be resolved there too."""
    course = ArcLength([connect(Pose(0, 0, 0), Pose(2, 0, 0), 1e-6)])
    for way in (0.0, 1e-9, 1e-6, 1e-3, 1.0, 1.999999, 2.0):
        curve, u = course.locate(way)
        assert curve.point(u).real == pytest.approx(way, abs=1e-12)


def test_a_chain_goes_over_from_curve_to_curve():
    first = connect(Pose(0, 0, 0), Pose(2, 1, 0.5), 0.4)
    second = connect(Pose(2, 1, 0.5), Pose(4, 0, 0), 0.4)
    chain = ArcLength([first, second])
    joint = ArcLength([first]).length
    assert chain.length == pytest.approx(joint + ArcLength([second]).length, rel=1e-14)
    assert chain.locate(joint - 1e-6)[0] is first
    assert chain.locate(joint + 1e-6)[0] is second
    assert np.all(np.diff(chain.way) >= 0.0)
    assert len(chain.middle_curvature) == len(chain.way) - 1


@pytest.mark.parametrize(('curves', 'cells'), [(1, 64), (8, 64), (16, 32), (100, 8)])
def test_of_many_curves_each_is_cut_into_fewer_cells(curves, cells):
    """Straight ones, which need no more than they begin with; each has one node more."""
    line = [connect(Pose(k, 0, 0), Pose(k + 1, 0, 0), 1 / 3) for k in range(curves)]
    chain = ArcLength(line)
    assert len(chain.way) == len(chain.curvature) == curves * (cells + 1)
    assert chain.length == pytest.approx(curves)


def test_curvature_stands_over_the_way_at_each_node_and_in_the_middle_between():
    """By the length of the curve up to there, of each of two curves; at the joint they meet."""
    curves = [
        connect(Pose(0, 0, 0), Pose(2, 1, 1.5), 0.4),
        connect(Pose(2, 1, 1.5), Pose(4, 0, 0), 0.5),
    ]
    chain, begin, at = ArcLength(curves), 0.0, 0
    for number, curve in enumerate(curves):
        cells = chain._inverse._cells[chain._inverse._which == number]  # noqa: SLF001 - the table
        u = np.append(cells[:, 1], 1.0)
        middle = 0.5 * (u[:-1] + u[1:])

        def way(to, curve=curve):
            inside = np.asarray(to)[:, None, None] * (np.arange(40)[:, None] + GAUSS_NODES) / 40.0
            return np.asarray(to) / 40.0 * (np.abs(curve.velocity(inside)) @ GAUSS_WEIGHTS).sum(1)

        end = at + len(u)
        assert chain.way[at:end] == pytest.approx(begin + way(u), abs=1e-9)
        assert chain.curvature[at:end] == pytest.approx(curve.curvature(u), abs=1e-9)
        assert chain.middle_way[at : end - 1] == pytest.approx(begin + way(middle), abs=1e-9)
        assert chain.middle_curvature[at : end - 1] == pytest.approx(curve.curvature(middle))
        begin, at = begin + float(way([1.0])[0]), end
    joint = len(chain._inverse._which[chain._inverse._which == 0])  # noqa: SLF001 - the table
    assert chain.middle_way[joint] == chain.way[joint] == chain.way[joint + 1]
    assert chain.middle_curvature[joint] == chain.curvature[joint]


def test_what_winds_too_much_is_refused_as_a_whole():
    """Half a circle turns by 5 % some sixty times: 150 of them can be planned, 400 cannot."""
    half = [connect(Pose(2 * k, 0, pi / 2), Pose(2 * k + 2, 0, -pi / 2), 0.66) for k in range(400)]
    assert ArcLength(half[:150]).length > 150.0
    with pytest.raises(GeometryError, match=r'^the 400 curves wind too much to be planned at once'):
        ArcLength(half)


def test_a_cusp_is_refused_by_name():
    """P' = 3 (1 - 2u)^2 - 3j (1 - 2u) ... vanishes at u = 1/2."""
    with pytest.raises(GeometryError, match='curve 2 has a cusp near 50 %'):
        ArcLength([
            connect(Pose(-1, 0, 0), Pose(0, 0, 0), 0.4),
            CubicBezier(0j, 1 + 0j, 1 + 1j, 1 - 1j),
        ])  # fmt: skip


def test_a_line_of_ten_nanometres_is_none_the_worse():
    length = ArcLength([CubicBezier(0j, 1e-8 + 0j, 1e-8 / 3 + 0j, 1e-8 / 3 + 0j)]).length
    assert length == pytest.approx(1e-8)


@pytest.mark.parametrize(('handle', 'refused'), [(3.31e-16, True), (3.35e-16, False)])
def test_a_cusp_is_where_it_hardly_moves_in_comparison_with_the_whole(handle, refused):
    """P' at the start is three handles; of a way of 1 m, a billionth of a micrometre."""
    curve = CubicBezier(0j, 1 + 0j, handle + 0j, 0.34 + 0j)
    if refused:
        with pytest.raises(GeometryError, match='curve 1 has a cusp near 0 %'):
            ArcLength([curve])
    else:
        assert ArcLength([curve]).length == pytest.approx(1.0)
