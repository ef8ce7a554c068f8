"""A tree without a zone goes straight, and nobody stands in its way."""

from __future__ import annotations

from math import inf

from agv_motion.motion.navigation.navigator import Guidance, StraightNavigator


def test_without_a_zone_the_path_is_the_straight_line():
    guidance = StraightNavigator().navigate((3.0, 4.0), (1.0, 2.0), 0.0)
    assert guidance == Guidance((3.0, 4.0), ((1.0, 2.0), (3.0, 4.0)))


def test_without_a_goal_it_goes_nowhere():
    navigator = StraightNavigator()
    assert navigator.navigate(None, (1.0, 2.0), 0.0) == Guidance(None, ())
    navigator.rest((1.0, 2.0), 0.0)
    assert (navigator.closed(), navigator.patience) == (None, inf)
