"""What may go out to a browser: finite, short, and few."""

from __future__ import annotations

from itertools import pairwise
from math import cos, inf, nan, pi, sin
from types import SimpleNamespace

import pytest

from agv_motion.dashboard.core.numbers import (
    finite,
    heading_of,
    known,
    listed,
    point_of,
    text_of,
    thinned,
)


@pytest.mark.parametrize(
    ('value', 'shown'),
    [(1.23456, 1.2346), (2, 2.0), ('3.5', 3.5), (nan, None), (-inf, None), ('x', None),
     (None, None), (10**400, None)],
)  # fmt: skip
def test_a_number_is_rounded_and_what_is_none_is_not_shown(value, shown):
    assert finite(value) == shown


def test_lists_are_cut_and_keep_the_places_of_what_cannot_be_shown():
    assert listed([1.0, nan, 3.0, 4.0], 3) == [1.0, None, 3.0]
    assert known([1.0, 0.0])
    assert not known(point_of(SimpleNamespace(x=1.0, y=inf)))


@pytest.mark.parametrize(('count', 'most'), [(3, 5), (5, 5), (6, 5), (1000, 7)])
def test_of_many_items_some_are_left_evenly_with_both_ends(count, most):
    items = thinned(range(count), most)
    assert len(items) == min(count, most)
    assert (items[0], items[-1]) == (0, count - 1)
    steps = [b - a for a, b in pairwise(items)]
    assert max(steps) - min(steps) <= 1


def test_a_text_has_no_control_characters_and_an_end():
    assert text_of('a\x00b\nc') == 'a b c'
    assert text_of('abcdefgh', 8) == 'abcdefgh'
    assert text_of('abcdefghi', 8) == 'abcd ...'


def test_the_heading_of_a_quaternion_is_the_angle_about_z():
    half = 0.5 * pi / 3.0
    turned = SimpleNamespace(x=0.0, y=0.0, z=sin(half), w=cos(half))
    assert heading_of(turned) == pytest.approx(pi / 3.0, abs=1e-4)
    assert heading_of(SimpleNamespace(x=0.0, y=nan, z=0.0, w=1.0)) is None
