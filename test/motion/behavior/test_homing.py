"""When the tree sets out for home, and that it needs one."""

from __future__ import annotations

from math import inf

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.motion.behavior.homing import HomeParameters, Homing
from agv_motion.motion.navigation.path_planner import PathPlanner
from agv_motion.motion.navigation.zone import Zone

SQUARE = [[0, 0], [12, 0], [12, 12], [0, 12]]
TOP = 1.0 / 60.0
"""[m/s]"""


def homing(home=(2.0, 2.0), **given):
    return Homing(PathPlanner(Zone(SQUARE, home=home)), HomeParameters(**given), TOP)


def test_it_sets_out_as_early_as_the_way_takes_and_something_to_spare():
    """8 m at half of a metre a minute take 16 min, a quarter longer 20, and 10 to spare."""
    closing = 1e9
    for minutes, due in ((30.1, False), (29.9, True)):
        assert homing(spare=10.0).is_due(closing - 60.0 * minutes, (10.0, 2.0), closing) is due


def test_it_looks_at_the_length_of_the_way_once_a_minute():
    home = homing(spare=0.0)
    assert not home.is_due(0.0, (10.0, 2.0), 1300.0)
    assert not home.is_due(59.0, (2.1, 2.0), 1300.0)
    assert home.is_due(110.0, (10.0, 2.0), 1300.0)


def test_without_a_home_or_without_closing_it_is_never_due():
    assert not homing(home=None).is_due(0.0, (10.0, 2.0), 1.0)
    assert not homing().is_due(0.0, (10.0, 2.0), inf)
    with pytest.raises(ConfigurationError, match='there is no home'):
        homing(home=None).send('asked to')
    assert Homing(None, HomeParameters(), TOP).home is None
