"""Parameters of a drive along a route: tables that would stall or swing are refused."""

from __future__ import annotations

from math import pi, radians

import pytest

from agv_motion.errors import ConfigurationError
from agv_motion.route.parameters import FollowParameters


def test_the_tables_by_name():
    tables = FollowParameters(v_d=(0.0, 0.0, 1.0, 0.7), v_alpha=(1.5, 0.2, 3.0, 0.6)).profiles()
    assert tables.v_d(0.5) == pytest.approx(0.35)
    assert tables.v_alpha(2.25) == pytest.approx(0.4)
    assert tables.omega_dphi(0.25) == pytest.approx(0.4)
    assert tables.v_dphi(0.0) == 0.5


def test_by_default_it_slows_down_within_half_a_metre_of_the_end():
    tables = FollowParameters().profiles()
    assert [tables.v_d(d) for d in (0.0, 0.05, 0.15, 0.5, 9.0)] == [0.0, 0.06, 0.2, 0.5, 0.5]
    assert [tables.v_dn(d) for d in (0.0, 0.1, 0.4)] == [0.12, 0.25, 0.5]
    assert [tables.v_dphi(a) for a in (0.1, 0.6, 1.6)] == [0.5, 0.2, 0.02]
    assert [tables.omega_dphi(a) for a in (0.0, 0.5, 1.6)] == [0.0, 0.8, 1.2]
    assert [tables.v_alpha(a) for a in (1.5, 3.0)] == [0.12, 0.5]


def test_the_top_speed_is_what_all_tables_together_allow():
    """At a corner the higher of two counts: far from it, or straight on."""
    given = {'v_dphi': (0.1, 0.9, 1.6, 0.1), 'v_d': (0.0, 0.0, 1.0, 0.8)}
    low = FollowParameters(v_dn=(0.0, 0.1, 1.0, 0.3), v_alpha=(1.5, 0.1, 3.0, 0.4), **given)
    assert low.profiles().top_speed() == pytest.approx(0.4)
    high = FollowParameters(v_dn=(0.0, 0.1, 1.0, 2.0), v_alpha=(1.5, 0.1, 3.0, 0.4), **given)
    assert high.profiles().top_speed() == pytest.approx(0.8)
    narrow = FollowParameters(v_dphi=(0.1, 0.2, 1.6, 0.1))
    assert narrow.profiles().top_speed() == pytest.approx(0.2)


@pytest.mark.parametrize(
    ('given', 'words'),
    [
        ({'omega_dphi': (0.0, 0.1, 1.0, 0.5)}, 'swing to and fro'),
        ({'v_dphi': (0.0, 0.5, 1.0, 0.0)}, 'v_dphi'),
        ({'v_dn': (0.0, 0.0, 1.0, 0.5)}, 'v_dn'),
        ({'v_alpha': (0.0, -0.1, 3.0, 0.5)}, 'v_alpha'),
        ({'v_d': (0.0, 0.1, 1.0, 0.5)}, 'never arrive'),
        ({'v_d': (0.0, 0.0, 1.0, 0.5, 2.0, 0.0)}, 'v_d: 0 m/s again at x = 2: there it would'),
        ({'v_d': (0.0, 0.0, 1.0, 0.5, 2.0, 0.05), 'arrival_speed': 0.05}, 'v_d: 0.05 m/s again'),
        ({'arrival_speed': 0.5}, 'v_d: nowhere above 0.5 m/s'),
        ({'v_d': (0.0, 0.0, 1.0, 0.0), 'arrival_speed': 0.0}, 'v_d: nowhere above 0 m/s'),
        ({'omega_dphi': (0.0, 0.0, 4.0, 0.5)}, 'omega_dphi'),
        ({'coupling_form': 'other'}, 'coupling_form'),
        ({'virtual_point_distance': 0.0}, 'virtual_point_distance'),
    ],
)
def test_what_would_stall_or_swing_is_refused_by_name(given, words):
    with pytest.raises(ConfigurationError, match=words):
        FollowParameters(**given)


def test_slow_enough_to_have_arrived_it_is_at_the_end_alone():
    """A row may lie below that speed as long as none above comes before it."""
    given = FollowParameters(v_d=(0.0, 0.0, 0.1, 0.02, 0.2, 0.3), arrival_speed=0.05)
    assert given.profiles().v_d(0.1) < given.arrival_speed < given.profiles().v_d(0.2)


def test_a_robot_that_could_circle_for_ever_is_warned_of():
    """At a quarter turn 0.5 m/s on a radius of 0.4 m need 1.25 rad/s; the tables give 1.2."""
    fast = (0.1, 0.5, pi, 0.5)
    warning = FollowParameters(v_dphi=fast).orbit()
    assert warning.startswith('at dphi = 90 deg the tables give 0.5 m/s and ')
    assert 'waits 0.4 m away' in warning
    assert FollowParameters(v_dphi=fast, virtual_point_distance=0.43).orbit() == ''
    assert FollowParameters(v_dphi=fast, holonomic=True).orbit() == ''
    assert FollowParameters().orbit() == ''


def test_each_degree_is_looked_at_from_a_quarter_turn_on():
    """0.2 m/s and 1 rad/s, but 0.6 m/s within a third of a degree about 150: 0.3 > 0.25."""
    at = radians(150.0)
    narrow = (0.0, 0.2, at - 0.006, 0.2, at, 0.6, at + 0.006, 0.2)
    turning = (0.0, 0.0, 1.0, 1.0)
    given = FollowParameters(v_dphi=narrow, omega_dphi=turning, virtual_point_distance=0.25)
    assert given.orbit().startswith('at dphi = 150 deg the tables give 0.6 m/s and 1 rad/s')
    behind = FollowParameters(omega_dphi=(*turning, 3.0, 1.0, pi, 0.0))
    assert behind.orbit().startswith('at dphi = 180 deg the tables give 0.02 m/s and 0 rad/s')
    ahead = FollowParameters(v_dphi=(0.0, 9.0, 1.55, 9.0, 1.57, 0.02), omega_dphi=turning)
    assert ahead.orbit() == ''
