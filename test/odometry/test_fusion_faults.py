"""The fusion and what befalls it: carried away, clocks that leap, numbers that cannot be."""

from __future__ import annotations

from math import hypot, pi, sqrt

import numpy as np
import pytest

from agv_motion.errors import SignalError
from agv_motion.odometry.continuity import Succession
from agv_motion.odometry.covariance import CERTAIN, Covariance, is_positive_definite, scale, shift
from agv_motion.odometry.fix import Fix, position_fix
from agv_motion.odometry.fusion import PoseFusion
from agv_motion.odometry.fusion_parameters import FusionParameters
from agv_motion.odometry.fusion_report import FixVerdict, FusionState
from agv_motion.odometry.kalman import correct
from agv_motion.planar import Pose, Twist, compose, integrate, wrap

KNOWN = Covariance(0.01, 0.0, 0.0, 0.01, 0.0, 0.001)
WALK = Covariance(4e-4, 0.0, 0.0, 4e-4, 0.0, 4e-4)
"""Noise after one metre."""
START = Pose(1.0, 2.0, 0.3)


class Walk:
    """A robot on a circle at 0.5 m/s, told to a fusion at 20 Hz, with fixes at some rate."""

    def __init__(self, rate=2.0, seed=1, tag=(0.0, 0.0), **parameters):
        self.fusion = PoseFusion(FusionParameters(**parameters))
        self.rng, self.rate, self.tag = np.random.default_rng(seed), rate, Pose(*tag, 0.0)
        self.steps, self.fixes, self.clock, self.carried = 0, 0, 100.0, Pose(0.0, 0.0, 0.0)
        self.odom = Pose(0.0, 0.0, 0.0)
        self.tell()
        self.fusion.set_pose(START, KNOWN)

    @property
    def time(self):
        return self.steps / 20.0

    @property
    def truth(self):
        return compose(self.carried, compose(START, self.odom))

    def tell(self):
        noise = scale(WALK, 0.5 * self.time)
        return self.fusion.add_odometry(self.time + self.clock, self.odom, noise)

    def run(self, seconds):
        """Go on for a while; return the verdicts on the fixes."""
        verdicts = []
        for _ in range(round(seconds * 20)):
            self.steps += 1
            self.odom = integrate(self.odom, Twist(0.5, 0.0, 0.25), 0.05)
            self.tell()
            if self.time * self.rate >= self.fixes + 1:
                self.fixes += 1
                at = compose(self.truth, self.tag)
                x, y = self.rng.normal((at.x, at.y), 0.1)
                fix = position_fix(self.time + self.clock, x, y, 0.1)
                verdicts.append(self.fusion.add_fix(fix))
        return verdicts

    def missed(self):
        """Return the error of the position [m], and its deviation as it is told."""
        pose, truth = self.fusion.estimate().pose, self.truth
        error = hypot(pose.x - truth.x, pose.y - truth.y)
        return error, self.fusion.health().position_deviation


@pytest.mark.parametrize('rate', [0.5, 1.0, 2.4, 5.0, 20.0])
def test_a_robot_carried_away_is_searched_for_within_15_seconds(rate):
    walk = Walk(rate)
    walk.run(30.0)
    assert walk.fusion.health().verdicts[FixVerdict.KIDNAPPED] == 0
    walk.carried = Pose(50.0, 0.0, 0.0)
    walk.run(15.0)
    assert walk.fusion.health().verdicts[FixVerdict.KIDNAPPED] == 1
    walk.run(20.0)
    assert walk.fusion.health().state is FusionState.TRACKING
    assert walk.missed()[0] < 0.5


@pytest.mark.parametrize('leap', [-3600.0, -60.0, -5.0, 5.0, 60.0, 3600.0, 2e9])
def test_after_a_leap_of_the_clock_good_fixes_are_soon_taken_again(leap):
    walk = Walk()
    walk.run(30.0)
    walk.clock += leap
    walk.run(3.0)
    assert walk.fusion.estimate() is not None
    verdicts = walk.run(20.0)
    assert verdicts.count(FixVerdict.ACCEPTED) >= 0.9 * len(verdicts)
    error, deviation = walk.missed()
    assert error < 4.0 * deviation < 1.0


@pytest.mark.parametrize('x', [200.0, 9e4, 1e6, 1e20, 1e150, 1e308])
def test_one_odometry_that_cannot_be_changes_nothing(x):
    walk, other = Walk(), Walk()
    for each in (walk, other):
        each.run(20.0)
    message = walk.time + walk.clock + 0.01, Pose(x, 0.0, 0.0), scale(WALK, 0.5 * walk.time)
    if x > 1e5:
        with pytest.raises(SignalError, match=r'cannot be beyond 100000 m|covariance'):
            walk.fusion.add_odometry(*message)
    else:
        assert walk.fusion.add_odometry(*message) is Succession.DOUBTED
    for each in (walk, other):
        each.run(5.0)
    assert walk.fusion.estimate() == other.fusion.estimate()


@pytest.mark.parametrize('variance', [1e18, 1e100, -1.0, 1e308])
def test_a_covariance_of_odometry_that_cannot_be_is_refused_and_changes_nothing(variance):
    walk, other = Walk(), Walk()
    for each in (walk, other):
        each.run(10.0)
    bad = Covariance(variance, 0.0, 0.0, variance, 0.0, variance)
    with pytest.raises(SignalError, match='covariance'):
        walk.fusion.add_odometry(walk.time + walk.clock + 0.01, walk.odom, bad)
    for each in (walk, other):
        each.run(5.0)
    assert walk.fusion.estimate() == other.fusion.estimate()


def test_a_covariance_that_does_not_grow_with_the_way_is_doubted():
    """One that stays the same about the robot makes nothing less sure: it is none."""
    fusion = PoseFusion()
    fusion.add_odometry(0.0, Pose(0.0, 0.0, 0.0), KNOWN)
    fusion.set_pose(START, KNOWN)
    steps = set()
    for i in range(1, 40):
        x = 0.5 * i
        about_origin = shift(KNOWN, -x, 0.0)
        steps.add(fusion.add_odometry(0.1 * i, Pose(x, 0.0, 0.0), about_origin))
    assert steps == {Succession.DOUBTED}


@pytest.mark.parametrize('variance', [1e18, 1e100, 0.0, 1e-30, 1e9])
def test_a_covariance_of_a_fix_that_cannot_be_is_refused_by_name(variance):
    with pytest.raises(SignalError, match=r'fix at 1\.0 s: '):
        Fix(1.0, 0.0, 0.0, Covariance(variance, 0.0, 0.0, variance, 0.0, 0.0))
    with pytest.raises(SignalError, match=r'fix at 1\.0 s'):
        Fix(1.0, 1e20, 0.0, KNOWN)


@pytest.mark.parametrize('prior', [1e2, 1e6, 1e8, 1e18])
@pytest.mark.parametrize('noise', [1e-12, 1e-6, 1.0])
def test_a_measurement_far_surer_than_what_was_known_leaves_a_covariance(prior, noise):
    before = Covariance(prior, 0.9 * prior, 0.0, prior, 0.0, 1.0)
    sure = Covariance(noise, 0.0, 0.0, noise, 0.0, noise)
    for count in (2, 3):
        update = correct(before, (1.0, 2.0, 0.1), sure, count)
        assert is_positive_definite(update.covariance)
        assert update.covariance.xx == pytest.approx(noise, rel=max(8.0 * noise / prior, 1e-3))


@pytest.mark.parametrize('tag', [(0.8, 0.0), (-0.3, 0.6)])
def test_the_tag_has_a_place_on_the_robot(tag):
    """NEES of 24 drives within bounds; taken to be at the centre the error is half a metre.

    Their odometry and start are exact, so that the squares are smaller than 3.
    """
    squares, wrong = [], []
    for seed in range(24):
        walk = Walk(seed=seed, tag=tag, tag_x=tag[0], tag_y=tag[1])
        walk.run(20.0)
        estimate, truth = walk.fusion.estimate(), walk.truth
        error = np.array([*np.subtract(estimate.pose[:2], truth[:2]),
                          wrap(estimate.pose.theta - truth.theta)])  # fmt: skip
        xx, xy, xt, yy, yt, tt = estimate.covariance
        spread = np.array([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])
        squares.append(float(error @ np.linalg.solve(spread, error)))
    for seed in range(8):
        blind = Walk(seed=seed, tag=tag)
        blind.run(20.0)
        wrong.append(blind.missed()[0])
    assert 0.5 < np.mean(squares) < 3.0 + 2.0 * sqrt(2.0 * 3.0 / 24)
    assert np.mean(wrong) > 0.25


def test_at_rest_a_tag_off_the_centre_leaves_the_centre_unsure():
    """With any heading, the centre lies anywhere on a circle of 0.8 m about the tag."""
    fusion = PoseFusion(FusionParameters(tag_x=0.8))
    for i in range(40):
        fusion.add_odometry(float(i), Pose(0.0, 0.0, 0.0), CERTAIN)
        fusion.add_fix(position_fix(float(i), 5.0, 6.0, 0.15))
    assert fusion.health().state is FusionState.SEARCHING
    assert fusion.health().position_deviation > 0.8 * pi / sqrt(3.0) * 0.9


def test_fixes_of_another_time_are_told_by_name():
    walk = Walk()
    walk.run(10.0)
    at = walk.time + walk.clock
    assert walk.fusion.add_fix(position_fix(0.0, 0.0, 0.0, 0.1)) is FixVerdict.LATE
    assert walk.fusion.add_fix(position_fix(at - 2.0, 0.0, 0.0, 0.1)) is FixVerdict.LATE
    assert walk.fusion.add_fix(position_fix(at + 90.0, 0.0, 0.0, 0.1)) is FixVerdict.EARLY
    assert walk.fusion.newest_stamp == pytest.approx(at)
