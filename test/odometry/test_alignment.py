"""The alignment finds position and heading from fixes and odometry, outliers or not."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from agv_motion.odometry.alignment import UNKNOWN, FixAtPose, align, thin
from agv_motion.odometry.belief import Drift, covariance_at
from agv_motion.odometry.covariance import CERTAIN, Covariance, rotate
from agv_motion.odometry.fix import Fix, position_fix
from agv_motion.odometry.history import Waypoint
from agv_motion.planar import Pose, compose, wrap

STILL = Drift(0.0, 0.0)


def sightings(rng, truth, places, outliers=(), heading_noise=None):
    """Return fixes of a robot that odometry sees at ``places``; ``truth`` is map to odom."""
    found = []
    for i, (x, y) in enumerate(places):
        waypoint = Waypoint(float(i), Pose(x, y, 0.3), CERTAIN)
        robot = compose(truth, waypoint.pose)
        dx, dy = 0.15 * rng.standard_normal(2)
        if i in outliers:
            dx, dy = rng.uniform(2.0, 5.0, 2)
        fix = position_fix(float(i), robot.x + dx, robot.y + dy, 0.15)
        if heading_noise:
            heading = wrap(robot.theta + heading_noise * float(rng.standard_normal()))
            covariance = fix.covariance._replace(tt=heading_noise**2)
            fix = Fix(fix.stamp, fix.x, fix.y, covariance, heading)
        found.append(FixAtPose(fix, waypoint))
    return found


def error(belief, truth, waypoint):
    """Return the error of the robot's pose, and its square in units of the covariance."""
    pose, true = compose(belief.map_to_odom, waypoint.pose), compose(truth, waypoint.pose)
    missed = np.array([pose.x - true.x, pose.y - true.y, wrap(pose.theta - true.theta)])
    xx, xy, xt, yy, yt, tt = rotate(
        covariance_at(belief, waypoint, STILL), belief.map_to_odom.theta
    )
    spread = np.array([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])
    return missed, float(missed @ np.linalg.inv(spread) @ missed)


def random_case(seed, **kwargs):
    rng = np.random.default_rng(seed)
    truth = Pose(*rng.uniform(-50, 50, 2), float(rng.uniform(-pi, pi)))
    places = np.cumsum(rng.uniform(-0.5, 1.0, (12, 2)), axis=0)
    return truth, sightings(rng, truth, places, **kwargs)


def test_on_a_moving_robot_it_is_as_sure_as_it_says():
    """200 random ways and headings: the squared errors have the mean of chi-square, 3."""
    squares = []
    for seed in range(200):
        truth, found = random_case(seed)
        belief = align(found, heading=0.0, needed=8)
        squares.append(error(belief, truth, found[-1].waypoint)[1])
    assert np.mean(squares) == pytest.approx(3.0, abs=0.5)


def test_outliers_have_no_say():
    missed = []
    for seed in range(100):
        truth, found = random_case(seed, outliers={0, 4, 7})
        belief = align(found, heading=0.0, needed=8)
        missed.append(error(belief, truth, found[-1].waypoint)[0])
    assert np.abs(missed).max() < 0.8


def test_at_rest_the_heading_stays_unknown():
    rng, truth = np.random.default_rng(1), Pose(3.0, 4.0, 2.5)
    found = sightings(rng, truth, [(1.0, 2.0)] * 20)
    belief = align(found, heading=-1.0, needed=15)
    assert belief.map_to_odom.theta == pytest.approx(-1.0, abs=1e-9)
    spread = covariance_at(belief, found[-1].waypoint, STILL)
    assert spread.tt == pytest.approx(UNKNOWN, rel=1e-6)
    assert spread.xx == pytest.approx(0.15**2 / 20, rel=1e-6)
    missed, _ = error(belief, truth, found[-1].waypoint)
    assert np.abs(missed[:2]).max() < 4 * 0.15 / 20**0.5


def test_measured_headings_are_used_at_rest():
    rng, truth = np.random.default_rng(1), Pose(3.0, 4.0, 2.5)
    found = sightings(rng, truth, [(1.0, 2.0)] * 5, heading_noise=0.05)
    belief = align(found, heading=0.0, needed=4)
    missed, square = error(belief, truth, found[-1].waypoint)
    assert abs(missed[2]) < 4 * 0.05 / 5**0.5
    assert square < 16.0


def test_measured_headings_are_worth_a_try_on_a_way_too_short_to_tell_one():
    """0.55 m at fixes of 0.15 m, known the wrong way round: without them few would agree."""
    rng, truth = np.random.default_rng(1), Pose(3.0, 4.0, 2.5)
    places = [(1.0 + 0.11 * i, 2.0) for i in range(6)]
    found = sightings(rng, truth, places, heading_noise=0.05)
    belief = align(found, heading=2.5 + pi, needed=6)
    assert abs(error(belief, truth, found[-1].waypoint)[0][2]) < 0.1


def test_fixes_that_do_not_agree_are_no_place():
    rng = np.random.default_rng(1)
    places = np.cumsum(rng.uniform(0.2, 1.0, (12, 2)), axis=0)
    found = sightings(rng, Pose(0.0, 0.0, 1.0), places, outliers=set(range(1, 9)))
    assert align(found, heading=0.0, needed=8) is None


def test_the_noise_of_odometry_since_makes_old_fixes_count_less():
    truth = Pose(0.0, 0.0, 0.0)
    old, new = sightings(np.random.default_rng(1), truth, [(0.0, 0.0), (0.0, 0.0)])
    walked = new.waypoint._replace(noise=Covariance(1.0, 0.0, 0.0, 1.0, 0.0, 0.0))
    belief = align([old, FixAtPose(new.fix, walked)], heading=0.0, needed=2)
    found = compose(belief.map_to_odom, walked.pose)
    share = 0.15**2 / (2 * 0.15**2 + 1.0)
    assert found.x == pytest.approx((1 - share) * new.fix.x + share * old.fix.x, abs=1e-12)


def test_thinning_keeps_the_whole_way_covered():
    rng = np.random.default_rng(1)
    found = sightings(rng, Pose(0.0, 0.0, 0.0), [(x, 0.0) for x in (0, 1, 2, 2.1, 2.2, 4, 6)])
    thin(found)
    assert [sighting.waypoint.pose.x for sighting in found] == [0, 1, 2, 2.2, 4, 6]
