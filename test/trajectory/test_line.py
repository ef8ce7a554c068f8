"""A straight way by its length."""

from __future__ import annotations

import pytest

from agv_motion.trajectory.line import Line


def test_by_hand():
    """Three to the right and four up are five."""
    line = Line(1 + 1j, 4 + 5j)
    assert line.length == pytest.approx(5.0)
    assert line.point(0.0) == 1 + 1j
    assert line.point(2.5) == pytest.approx(2.5 + 3j)
    assert line.point(5.0) == pytest.approx(4 + 5j)
    assert line.velocity(1.0) == pytest.approx(0.6 + 0.8j)
    assert line.acceleration(1.0) == 0
    assert list(line.way) == pytest.approx([0.0, 5.0])
    assert list(line.middle_way) == pytest.approx([2.5])
    assert line.locate(1.5) == (line, 1.5)


def test_it_bends_nowhere_and_nobody_can_bend_it():
    line = Line(0j, 1j)
    assert list(line.curvature) == [0.0, 0.0]
    assert list(line.middle_curvature) == [0.0]
    with pytest.raises(ValueError, match='read-only'):
        line.curvature[0] = 1.0
