"""Tables of the route follower: values by hand, and every way to give a wrong one."""

from __future__ import annotations

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError
from agv_motion.route.parameters import FollowParameters
from agv_motion.route.table import ProfileTable


@pytest.mark.parametrize(
    ('x', 'y'), [(0.0, 1.0), (1.0, 1.0), (1.5, 2.0), (2.0, 3.0), (3.0, 2.5), (9.0, 2.0), (inf, 2.0)]
)
def test_straight_between_the_rows_and_constant_outside(x, y):
    assert ProfileTable('t', (1.0, 1.0, 2.0, 3.0, 4.0, 2.0))(x) == y


@given(
    st.lists(st.floats(0.0, 100.0), min_size=1, max_size=8, unique=True),
    st.lists(st.floats(-5.0, 5.0), min_size=8, max_size=8),
    st.floats(0.0, 200.0),
)
def test_never_outside_of_its_rows(xs, ys, x):
    rows = [number for row in zip(sorted(xs), ys, strict=False) for number in row]
    assert min(rows[1::2]) - 1e-12 <= ProfileTable('t', rows)(x) <= max(rows[1::2]) + 1e-12


@pytest.mark.parametrize(
    ('rows', 'reason'),
    [
        ((), '0 numbers'),
        ((1.0, 2.0, 3.0), '3 numbers: give pairs'),
        ((0.0, 1.0, 2.0, 1.0, 1.0, 1.0), 'x = 1 comes after x = 2: sort'),
        ((0.0, 1.0, 1.0, 1.0, 1.0, 2.0), 'overlap at x = 1'),
        ((0.0, nan), 'not finite'),
        ((inf, 1.0), 'not finite'),
        ((-1.0, 1.0), r'must lie in \[0, 3\]'),
        ((0.0, 1.0, 4.0, 1.0), r'must lie in \[0, 3\]'),
    ],
)
def test_a_malformed_table_is_refused_by_name(rows, reason):
    with pytest.raises(ConfigurationError, match=f'v_dn: .*{reason}'):
        ProfileTable('v_dn', rows, highest=3.0)


@pytest.mark.parametrize('name', ['v_dphi', 'v_dn', 'v_alpha'])
@pytest.mark.parametrize('lowest', [0.0, -0.1])
def test_only_v_d_may_reach_zero(name, lowest):
    with pytest.raises(ConfigurationError, match=f'{name}: .* stalls short of the goal'):
        FollowParameters(**{name: (0.0, 0.5, 1.0, lowest)})


@pytest.mark.parametrize(
    ('rows', 'reason'),
    [
        ((0.0, 0.1, 1.0, 0.5), 'would never arrive'),
        ((0.2, 0.1, 1.0, 0.5), 'would never arrive'),
        ((0.0, 0.0, 1.0, 0.5, 2.0, 0.0), '0 m/s again at x = 2'),
        ((0.0, 0.0, 1.0, -0.5), 'must not be negative'),
        ((0.0, 0.0, 1.0, 0.0), 'nowhere above 0.01 m/s'),
    ],
)
def test_v_d_is_zero_at_the_goal_and_only_there(rows, reason):
    with pytest.raises(ConfigurationError, match=f'v_d: .*{reason}'):
        FollowParameters(v_d=rows)


def test_a_turn_rate_at_no_error_is_refused():
    with pytest.raises(ConfigurationError, match='the robot would swing to and fro'):
        FollowParameters(omega_dphi=(0.0, 0.3, 1.0, 1.0))


@pytest.mark.parametrize(
    ('name', 'value'),
    [
        ('virtual_point_distance', 0.0),
        ('virtual_point_distance', nan),
        ('speed_coupling_ms', -1.0),
        ('coupling_form', 'tight'),
        ('arrival_speed', nan),
    ],
)
def test_a_number_out_of_its_range_is_refused_by_name(name, value):
    with pytest.raises(ConfigurationError, match=name):
        FollowParameters(**{name: value})


def test_tables_that_could_circle_for_ever_are_told():
    """At a right angle 0.3 m/s and 0.5 rad/s make a circle of 0.6 m round a point 0.4 m away."""
    slow_turns = FollowParameters(omega_dphi=(0.0, 0.0, 1.0, 0.5), v_dphi=(0.0, 0.3))
    assert 'at dphi = 90 deg' in slow_turns.orbit()
    assert FollowParameters().orbit() == ''
