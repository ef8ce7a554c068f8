"""States of turrets, one by one and many together: the same motion, pose and covariance."""

from __future__ import annotations

from math import inf, nan, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.continuity import Succession
from agv_motion.odometry.turret_odometry import TurretOdometry
from agv_motion.planar import Twist

TURRETS = Turrets([(0.8, -0.8), (0.8, 0.8), (-1.2, 0.0)])
COUNT = len(TURRETS)
ANGLE, SPEED = st.floats(-20.0, 20.0), st.floats(-3.0, 3.0)
STATE = st.tuples(
    st.sampled_from([0.1, 0.05, 0.2]),
    st.tuples(*[ANGLE] * COUNT),
    st.tuples(*[SPEED] * COUNT) | st.just((0.0, -0.0, 0.0)),
)


def numbers(reckoned):
    return np.array([*reckoned.twist, reckoned.residual, *reckoned.pose, *reckoned.covariance])


@given(st.lists(STATE, min_size=1, max_size=40), st.integers(0, 40))
def test_by_columns_it_is_the_same_to_the_bit(states, cut):
    steps, angles, speeds = (np.array(column) for column in zip(*states, strict=True))
    times = 1.4e9 + np.cumsum(steps)
    one, many = TurretOdometry(TURRETS, 0.02), TurretOdometry(TURRETS, 0.02)
    expected = [
        numbers(one.update(time, list(angle), list(speed)))
        for time, angle, speed in zip(times.tolist(), angles.tolist(), speeds.tolist(), strict=True)
    ]
    parts = [part for part in (slice(0, cut), slice(cut, None)) if len(times[part])]
    found = [
        numbers(many.update_columns(times[part], angles[part].T, speeds[part].T)) for part in parts
    ]
    assert np.array(expected).T.tobytes() == np.concatenate(found, axis=1).tobytes()


def test_a_quarter_turn_on_the_spot_by_hand():
    """Hand calculation: 1 rad/s for pi/2 s; the turret at (-1.2, 0) rolls 1.2 pi/2 = 1.88 m."""
    command = TURRETS.command(Twist(0.0, 0.0, 1.0), [0.0] * COUNT)
    reckoning = TurretOdometry(TURRETS, 0.1)
    start = reckoning.update(10.0, command.angle, command.speed)
    assert start.pose == (0.0, 0.0, 0.0)
    assert start.covariance.tt == 0.0
    for i in range(1, 5):
        end = reckoning.update(10.0 + i * pi / 8, command.angle, command.speed)
    assert end.twist == pytest.approx((0.0, 0.0, 1.0))
    assert end.residual == pytest.approx(0.0, abs=1e-15)
    assert end.pose == pytest.approx((0.0, 0.0, pi / 2), abs=1e-12)
    # heading: mean travel (2 sqrt(1.28) + 1.2) / 3 * pi/2 m at 0.01 m2/m, over sum of arms squared
    spread = 2 * (0.8**2 + (0.8 - 0.4 / 3) ** 2) + (1.2 + 0.4 / 3) ** 2
    travel = (2 * 1.28**0.5 + 1.2) / 3 * pi / 2
    assert end.covariance.tt == pytest.approx(0.01 * travel / spread)


def rolling(stamps, speed=1.0, reckoning=None):
    """Take states of a platform that goes straight on at these stamps; return the last."""
    reckoning = reckoning or TurretOdometry(TURRETS, 0.02)
    for stamp in stamps:
        told = reckoning.update(stamp, [0.0] * COUNT, [speed] * COUNT)
    return told


def test_a_state_that_is_not_newer_does_not_move_the_pose():
    reckoning = TurretOdometry(TURRETS, 0.02)
    steps = [rolling([time], reckoning=reckoning).step for time in (1.0, 1.0, 0.9, 1.25)]
    assert steps == [Succession.FIRST, Succession.DUPLICATE, Succession.LATE, Succession.MOVED]
    assert rolling([1.25], reckoning=reckoning).pose == pytest.approx((0.25, 0, 0))


@pytest.mark.parametrize(
    'order', [[0, 2, 1, 3], [0, 3, 1, 2, 4], [0, 0, 1, 1, 2], [0, 4, 2, 3, 1, 5]]
)
def test_late_swapped_and_doubled_states_count_time_once(order):
    """One metre a second for 10 s, all stamps in a disorder that comes again and again."""
    n = max(order) + 1
    stamps = [0.05 * (n * block + place) for block in range(200 // n) for place in order]
    told = rolling([*stamps, 10.0])
    assert told.pose.x == pytest.approx(10.0, abs=1e-9)
    assert told.covariance.xx >= 0.02**2 * 10.0 / COUNT * 0.999


@pytest.mark.parametrize('leap', [60.0, -60.0, 3600.0, 2.1e9])
@pytest.mark.parametrize('back', [True, False])
def test_a_clock_that_leaps_counts_no_time_of_its_own(leap, back):
    """One state of another time is nothing; where the next ones go on from it a step is lost."""
    before, after = [0.05 * i for i in range(21)], [1.0 + 0.05 * i for i in range(1, 21)]
    if back:
        told = rolling([*before, 1.0 + leap, *after])
        assert told.pose.x == pytest.approx(2.0, abs=1e-9)
        assert told.covariance.xx < 0.03**2
    else:
        told = rolling([*before, *(leap + stamp for stamp in after)])
        assert told.pose.x == pytest.approx(1.95, abs=1e-6)
        assert told.covariance.xx**0.5 > 0.05


@pytest.mark.parametrize('leap', [-0.2, -0.6, -3.0, -9.0, 0.6, 3.0, 9.0])
def test_a_clock_that_is_put_right_by_seconds_costs_what_may_be_lost(leap):
    before, after = [0.05 * i for i in range(21)], [1.0 + 0.05 * i for i in range(1, 401)]
    told = rolling([*before, *(leap + stamp for stamp in after)])
    deviation = told.covariance.xx**0.5
    assert abs(told.pose.x - 21.0) < 3.0 * deviation
    assert deviation < 0.1 + 1.1 * abs(leap)


@pytest.mark.parametrize('speed', [1e100, -1e30, 11.0, nan, inf])
def test_an_impossible_speed_is_refused_and_nothing_has_changed(speed):
    reckoning = TurretOdometry(TURRETS, 0.02, max_wheel_speed=10.0)
    rolling([0.0, 0.1], reckoning=reckoning)
    with pytest.raises(SignalError, match='wheel speeds'):
        reckoning.update(0.2, [0.0] * COUNT, [1.0, speed, 1.0])
    assert rolling([0.2], reckoning=reckoning).pose.x == pytest.approx(0.2, abs=1e-12)


def test_where_speeds_are_unknown_what_wheels_rolled_tells_them():
    reckoning = TurretOdometry(TURRETS, 0.02)
    with pytest.raises(SignalError, match='no wheel speeds'):
        reckoning.update(0.0, [0.0] * COUNT, [], [5.0] * COUNT)
    reckoning.update(0.0, [0.0] * COUNT, [1.0] * COUNT, [5.0] * COUNT)
    told = reckoning.update(0.1, [0.0] * COUNT, [], [5.08] * COUNT)
    assert told.pose.x == pytest.approx(0.08)
    assert told.twist.vx == pytest.approx(0.8)


def test_states_that_are_late_or_beyond_limits_do_not_go_by_columns():
    reckoning = TurretOdometry(TURRETS, 0.02)
    rolling([1.0], reckoning=reckoning)
    still = np.zeros((COUNT, 2))
    assert reckoning.are_plain(np.array([1.1, 1.2]), still)
    for times, speeds in (([1.0, 1.1], still), ([1.2, 1.1], still), ([1.1, 9.9], still),
                          ([1.1, 1.2], still + 1e9)):  # fmt: skip
        assert not reckoning.are_plain(np.array(times), speeds)
        with pytest.raises(ConfigurationError, match='one by one'):
            reckoning.update_columns(np.array(times), still, speeds)
