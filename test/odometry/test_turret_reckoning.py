"""States of turrets, one by one and many together: the same motion, pose and covariance."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.turret_reckoning import TurretReckoning
from agv_motion.planar import Twist

TURRETS = Turrets([(0.8, -0.8), (0.8, 0.8), (-1.2, 0.0)])
COUNT = len(TURRETS)
ANGLE, SPEED = st.floats(-20.0, 20.0), st.floats(-3.0, 3.0)
STATE = st.tuples(
    st.sampled_from([0.1, 0.05, 0.0, -0.2]),
    st.tuples(*[ANGLE] * COUNT),
    st.tuples(*[SPEED] * COUNT) | st.just((0.0, -0.0, 0.0)),
)


def numbers(reckoned):
    return np.array([*reckoned.twist, reckoned.residual, *reckoned.pose, *reckoned.covariance])


@given(st.lists(STATE, min_size=1, max_size=40), st.integers(0, 40))
def test_by_columns_it_is_the_same_to_the_bit(states, cut):
    steps, angles, speeds = (np.array(column) for column in zip(*states, strict=True))
    times = 1.4e9 + np.cumsum(steps)
    one, many = TurretReckoning(TURRETS, 0.02), TurretReckoning(TURRETS, 0.02)
    expected = [
        numbers(one.take(time, list(angle), list(speed)))
        for time, angle, speed in zip(times.tolist(), angles.tolist(), speeds.tolist(), strict=True)
    ]
    parts = [part for part in (slice(0, cut), slice(cut, None)) if len(times[part])]
    found = [
        numbers(many.take_columns(times[part], angles[part].T, speeds[part].T)) for part in parts
    ]
    assert np.array(expected).T.tobytes() == np.concatenate(found, axis=1).tobytes()


def test_a_quarter_turn_on_the_spot_by_hand():
    """Hand calculation: 1 rad/s for pi/2 s; the turret at (-1.2, 0) rolls 1.2 pi/2 = 1.88 m."""
    command = TURRETS.command(Twist(0.0, 0.0, 1.0), [0.0] * COUNT)
    reckoning = TurretReckoning(TURRETS, 0.1)
    start = reckoning.take(10.0, command.angle, command.speed)
    assert start.pose == (0.0, 0.0, 0.0)
    assert start.covariance.tt == 0.0
    end = reckoning.take(10.0 + pi / 2, command.angle, command.speed)
    assert end.twist == pytest.approx((0.0, 0.0, 1.0))
    assert end.residual == pytest.approx(0.0, abs=1e-15)
    assert end.pose == pytest.approx((0.0, 0.0, pi / 2), abs=1e-12)
    # heading: mean travel (2 sqrt(1.28) + 1.2) / 3 * pi/2 m at 0.01 m2/m, over sum of arms squared
    spread = 2 * (0.8**2 + (0.8 - 0.4 / 3) ** 2) + (1.2 + 0.4 / 3) ** 2
    travel = (2 * 1.28**0.5 + 1.2) / 3 * pi / 2
    assert end.covariance.tt == pytest.approx(0.01 * travel / spread)


def test_a_state_that_is_not_newer_does_not_move_the_pose():
    reckoning = TurretReckoning(TURRETS, 0.02)
    for time in (1.0, 1.0, 0.5):
        assert reckoning.take(time, [0.0] * COUNT, [1.0] * COUNT).pose == (0.0, 0.0, 0.0)
    assert reckoning.take(0.75, [0.0] * COUNT, [1.0] * COUNT).pose == pytest.approx((0.25, 0, 0))
