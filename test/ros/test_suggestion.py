"""A name that is not there is answered with the nearest one that is."""

from __future__ import annotations

from agv_motion.ros.suggestion import meant


def test_the_nearest_name_is_suggested_and_none_where_none_is_near():
    assert meant('wheel_radus', ['wheel_radius', 'track']) == "; did you mean 'wheel_radius'?"
    assert meant('zone', ['wheel_radius', 'track']) == ''
    assert meant('zone', []) == ''
