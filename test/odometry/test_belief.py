"""The belief is the left-invariant Kalman filter: the numbers of one that steps in matrices."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.odometry.belief import Drift, believe, covariance_at, take
from agv_motion.odometry.covariance import Covariance, rotate
from agv_motion.odometry.dead_reckoning import DeadReckoning
from agv_motion.odometry.fix import Fix
from agv_motion.odometry.history import Waypoint
from agv_motion.planar import Pose, Twist, compose, exponential, inverse, wrap

STILL = Drift(0.0, 0.0)
NOISE = Covariance(1e-4, 2e-5, 1e-5, 3e-4, -2e-5, 2e-4)
PRIOR = Covariance(0.3, 0.05, 0.02, 0.2, -0.03, 0.1)
SPEED = st.floats(-1.0, 1.0)


def matrix(covariance):
    xx, xy, xt, yy, yt, tt = covariance
    return np.array([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])


def adjoint(pose):
    c, s = cos(pose.theta), sin(pose.theta)
    return np.array([[c, -s, pose.y], [s, c, -pose.x], [0.0, 0.0, 1.0]])


class MatrixFilter:
    """The filter as the paper has it: pose, and covariance in the frame of the body."""

    def __init__(self, pose, covariance):
        turn = adjoint(Pose(0.0, 0.0, -pose.theta))
        self.pose, self.p = pose, turn @ matrix(covariance) @ turn.T

    def carry(self, before, after, noise):
        step = compose(inverse(before), after)
        back = adjoint(inverse(step))
        self.p = back @ self.p @ back.T + noise
        self.pose = compose(self.pose, step)

    def take(self, fix):
        c, s = cos(self.pose.theta), sin(self.pose.theta)
        back = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
        rows = 2 if fix.heading is None else 3
        away = 0.0 if fix.heading is None else wrap(fix.heading - self.pose.theta)
        missed = back @ [fix.x - self.pose.x, fix.y - self.pose.y, away]
        noise, h = back @ matrix(fix.covariance) @ back.T, np.eye(3)[:rows]
        total = h @ self.p @ h.T + noise[:rows, :rows]
        gain = self.p @ h.T @ np.linalg.inv(total)
        distance = missed[:rows] @ np.linalg.inv(total) @ missed[:rows]
        self.pose = compose(self.pose, exponential(Twist(*gain @ missed[:rows])))
        self.p = (np.eye(3) - gain @ h) @ self.p
        return distance


@given(
    st.lists(st.tuples(SPEED, SPEED, SPEED, st.booleans()), min_size=1, max_size=20),
    st.tuples(SPEED, SPEED, st.floats(-pi, 3.1)),
    st.booleans(),
)
def test_it_is_the_left_invariant_filter(way, start, with_heading):
    reckoning = DeadReckoning()
    reckoning.set(Pose(3.0, -2.0, 1.0))
    now = Waypoint(0.0, reckoning.pose, reckoning.origin_covariance)
    belief, reference = believe(Pose(*start), PRIOR, now), MatrixFilter(Pose(*start), PRIOR)
    for i, (vx, vy, wz, fixed) in enumerate(way):
        before, noise_before = reckoning.pose, np.array(reckoning.origin_covariance)
        reckoning.carry((vx, vy, wz), NOISE)
        now = Waypoint(i + 1.0, reckoning.pose, reckoning.origin_covariance)
        added = matrix(np.array(now.noise) - noise_before)
        into_body = adjoint(inverse(now.pose))
        reference.carry(before, now.pose, into_body @ added @ into_body.T)
        if fixed:
            pose = reference.pose
            heading = wrap(pose.theta + 0.1) if with_heading else None
            fix = Fix(i + 1.0, pose.x + 0.2, pose.y - 0.1, PRIOR, heading)
            distance = reference.take(fix)
            belief, found = take(belief, now, fix, STILL)
            assert found == pytest.approx(distance, rel=1e-6)
        pose = compose(belief.map_to_odom, now.pose)
        assert pose[:2] == pytest.approx(reference.pose[:2], abs=1e-9)
        assert wrap(pose.theta - reference.pose.theta) == pytest.approx(0.0, abs=1e-9)
        body = rotate(covariance_at(belief, now, STILL), -now.pose.theta)
        np.testing.assert_allclose(matrix(body), reference.p, atol=1e-9)


def test_what_is_believed_is_told():
    pose, waypoint = Pose(4.0, 5.0, 2.0), Waypoint(1.0, Pose(-3.0, 7.0, -1.0), NOISE)
    belief = believe(pose, PRIOR, waypoint)
    assert compose(belief.map_to_odom, waypoint.pose) == pytest.approx(pose, abs=1e-12)
    told = rotate(covariance_at(belief, waypoint, STILL), belief.map_to_odom.theta)
    assert told == pytest.approx(PRIOR, abs=1e-12)


def test_even_at_rest_the_drift_goes_on():
    """Hand calculation: 100 s of 0.01 m2/s and 0.001 rad2/s."""
    waypoint = Waypoint(0.0, Pose(1.0, 2.0, 0.5), NOISE)
    belief = believe(Pose(0.0, 0.0, 0.0), PRIOR, waypoint)
    later = covariance_at(belief, waypoint._replace(stamp=100.0), Drift(0.01, 0.001))
    before = covariance_at(belief, waypoint, STILL)
    assert later.xx - before.xx == pytest.approx(1.0, abs=1e-12)
    assert later.yy - before.yy == pytest.approx(1.0, abs=1e-12)
    assert later.tt - before.tt == pytest.approx(0.1, abs=1e-12)
