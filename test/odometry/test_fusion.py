"""The fusion: consistent over seeds, robust against what UWB does, honest about what it knows."""

from __future__ import annotations

from math import cos, hypot, inf, nan, pi, sin, sqrt

import numpy as np
import pytest

from agv_motion.errors import SignalError
from agv_motion.odometry.covariance import CERTAIN, Covariance, scale
from agv_motion.odometry.fix import Fix, position_fix
from agv_motion.odometry.fusion import PoseFusion
from agv_motion.odometry.fusion_parameters import FusionParameters
from agv_motion.odometry.fusion_report import FixVerdict, FusionState
from agv_motion.planar import Pose, compose, inverse, wrap
from agv_motion.simulation.trials.omni import OmniTrial, TrialParameters
from agv_motion.simulation.uwb import UwbParameters

KNOWN = Covariance(0.01, 0.0, 0.0, 0.01, 0.0, 0.001)


def missed(trial):
    """Return the error of the estimate (x, y, heading), and its square in its covariance."""
    estimate, truth = trial.fusion.estimate(), trial.robot.pose
    error = np.array(
        [
            estimate.pose.x - truth.x,
            estimate.pose.y - truth.y,
            wrap(estimate.pose.theta - truth.theta),
        ]
    )
    xx, xy, xt, yy, yt, tt = estimate.covariance
    spread = np.array([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])
    return error, float(error @ np.linalg.solve(spread, error))


def run(trial, seconds):
    """Drive for a while; return the rows of errors and the squares, once a second."""
    errors, squares = [], []
    for i in range(round(seconds * trial.given.rate)):
        trial.step()
        if i % trial.given.rate == 0 and trial.fusion.health().state is not FusionState.SEARCHING:
            if trial.fusion.estimate() is None:
                continue
            error, square = missed(trial)
            errors.append(error)
            squares.append(square)
    return np.array(errors), np.array(squares)


def resting(seconds=0.0, **parameters):
    """Return a fusion that tracks a robot at rest at (1, 2), looking along x."""
    fusion = PoseFusion(FusionParameters(**parameters))
    fusion.add_odometry(0.0, Pose(0.0, 0.0, 0.0), CERTAIN)
    fusion.set_pose(Pose(1.0, 2.0, 0.0), KNOWN)
    for i in range(1, round(10 * seconds) + 1):
        fusion.add_odometry(0.1 * i, Pose(0.0, 0.0, 0.0), CERTAIN)
    return fusion


LATE_AND_GONE = UwbParameters(
    latency=1.0, outlier_share=0.1, dropout_interval=20.0, dropout_duration=10.0
)


@pytest.mark.parametrize(
    ('half', 'lost'),
    [
        (Covariance(0.6e8, 0.0, 0.0, 1.0, 0.0, 1.0), True),
        (Covariance(1.0, 0.0, 0.0, 0.6e8, 0.0, 1.0), True),
        (Covariance(1.0, 0.0, 0.0, 1.0, 0.0, 0.6e6), True),
        (Covariance(0.4e8, 0.0, 0.0, 0.4e8, 0.0, 0.4e6), False),
    ],
)
def test_it_is_lost_beyond_ten_kilometres_or_a_thousand_radians(half, lost):
    """Half of the variance was there at the start, and half came on the way."""
    fusion = PoseFusion(FusionParameters())
    fusion.add_odometry(0.0, Pose(0.0, 0.0, 0.0), CERTAIN)
    fusion.set_pose(Pose(0.0, 0.0, 0.0), half)
    fusion.add_odometry(0.1, Pose(0.0, 0.0, 0.0), half)
    verdict = fusion.add_fix(position_fix(0.1, 0.0, 0.0, 0.1))
    assert verdict is (FixVerdict.SEARCHING if lost else FixVerdict.ACCEPTED)


@pytest.mark.parametrize(('ahead', 'waits'), [(0.99, True), (1.01, False)])
def test_a_fix_that_is_ahead_of_odometry_is_waited_for_as_long_as_a_second(ahead, waits):
    fusion = resting(1.0, horizon=0.5)
    verdict = fusion.add_fix(position_fix(1.0 + ahead, 1.0, 2.0, 0.1))
    assert (verdict is FixVerdict.WAITING) == waits


@pytest.mark.parametrize(
    ('uwb', 'seconds', 'fixes'),
    [
        (UwbParameters(), 36.0, 16),
        (UwbParameters(heading_noise=0.1, latency=1.0), 36.0, 16),
        (LATE_AND_GONE, 60.0, 30),
    ],
    ids=['position only', 'with heading, late', 'late, outliers, drop-outs'],
)
def test_the_squared_errors_are_those_its_covariance_promises(uwb, seconds, fixes):
    """NEES of 60 seeds: over the times, nearly all means lie within their 95 % bounds."""
    runs = []
    for seed in range(60):
        trial = OmniTrial(TrialParameters(seed=seed, rate=5.0, uwb=uwb))
        runs.append(run(trial, seconds)[1][-fixes:])
    means = np.mean(runs, axis=0)
    half_width = 1.96 * sqrt(2.0 * 3.0 / 60)
    assert np.mean(np.abs(means - 3.0) < half_width) > 0.8
    assert abs(np.mean(means) - 3.0) < half_width


def test_at_one_fix_a_second_the_error_is_less_than_half_that_of_the_fixes():
    squares = []
    for seed in range(10):
        trial = OmniTrial(TrialParameters(seed=seed, rate=10.0))
        errors, _ = run(trial, 60.0)
        squares.extend(errors[10:, 0] ** 2 + errors[10:, 1] ** 2)
    assert sqrt(np.mean(squares)) < 0.5 * sqrt(2.0) * 0.15


def test_an_hour_of_outliers_drop_outs_and_multipath_leave_it_on_its_way():
    """The short form of the endurance run of 24 hours."""
    uwb = UwbParameters(
        latency=1.0,
        outlier_share=0.1,
        dropout_interval=600.0,
        dropout_duration=300.0,
        multipath_interval=450.0,
    )
    trial = OmniTrial(TrialParameters(seed=3, rate=5.0, uwb=uwb))
    errors, squares = run(trial, 3600.0)
    assert np.hypot(errors[:, 0], errors[:, 1]).max() < 4.0
    assert np.mean(squares < 16.3) > 0.97  # 99.9 % of a chi-square of 3
    assert np.abs(errors[-1]).max() < 0.5


def test_the_heading_is_found_once_the_robot_moves():
    for seed in range(20):
        trial = OmniTrial(TrialParameters(seed=seed))
        run(trial, 12.0)
        assert trial.fusion.health().state is FusionState.TRACKING
        error, square = missed(trial)
        assert abs(error[2]) < 0.6
        assert square < 25.0


def test_at_rest_the_position_is_told_and_the_heading_is_said_to_be_unknown():
    fusion = PoseFusion()
    rng = np.random.default_rng(1)
    for i in range(40):
        fusion.add_odometry(float(i), Pose(0.0, 0.0, 0.0), CERTAIN)
        x, y = rng.normal((5.0, 6.0), 0.15)
        assert fusion.add_fix(position_fix(float(i), x, y, 0.15)) is FixVerdict.SEARCHING
    health, estimate = fusion.health(), fusion.estimate()
    assert health.state is FusionState.SEARCHING
    assert health.heading_deviation > 1.5
    assert health.position_deviation < 0.05
    assert hypot(estimate.pose.x - 5.0, estimate.pose.y - 6.0) < 0.15


def test_kidnapping_is_noticed_and_the_robot_found_again():
    for seed in range(6):
        trial = OmniTrial(TrialParameters(seed=seed, rate=10.0))
        run(trial, 30.0)
        pose = trial.robot.pose
        trial.robot.carry_to(Pose((pose.x + 8.0) % 20.0, pose.y, wrap(pose.theta + 2.0)))
        run(trial, 5.0)
        assert trial.fusion.health().state is FusionState.DOUBTFUL
        run(trial, 40.0)
        health = trial.fusion.health()
        assert health.verdicts[FixVerdict.KIDNAPPED] == 1
        assert health.state is FusionState.TRACKING
        assert missed(trial)[1] < 25.0


def test_outliers_are_no_kidnapping():
    fusion, rng = resting(100.0), np.random.default_rng(1)
    for i in range(60):
        x, y = rng.uniform(-30.0, 30.0, 2)
        fusion.add_odometry(100.0 + i, Pose(0.0, 0.0, 0.0), CERTAIN)
        fusion.add_fix(position_fix(100.0 + i, x, y, 0.15))
    assert fusion.health().verdicts[FixVerdict.KIDNAPPED] == 0
    assert fusion.health().state is FusionState.DOUBTFUL
    assert hypot(fusion.estimate().pose.x - 1.0, fusion.estimate().pose.y - 2.0) < 0.2


def test_late_fixes_count_as_if_in_time():
    in_time, late = resting(), resting()
    rng = np.random.default_rng(1)
    fixes = [
        position_fix(0.1 * i, *rng.normal((1.0 + 0.1 * i, 2.0), 0.15), 0.15) for i in range(40)
    ]
    for i in range(1, 50):
        for fusion, delay in ((in_time, 0), (late, 9)):
            fusion.add_odometry(0.1 * i, Pose(0.1 * i, 0.0, 0.0), CERTAIN)
            if 0 < i - delay < 40:
                assert fusion.add_fix(fixes[i - delay]) is FixVerdict.ACCEPTED
    assert late.estimate().pose == pytest.approx(in_time.estimate().pose, abs=1e-12)
    assert late.estimate().covariance == pytest.approx(in_time.estimate().covariance, abs=1e-15)


def test_fixes_out_of_order_count_as_if_in_order():
    in_order, swapped = resting(1.0), resting(1.0)
    fixes = [position_fix(0.2 * i, 1.0 + 0.05 * i, 2.0, 0.15) for i in range(1, 6)]
    for fix in fixes:
        in_order.add_fix(fix)
    for i in (4, 0, 2, 1, 3):
        assert swapped.add_fix(fixes[i]) is FixVerdict.ACCEPTED
    assert swapped.estimate() == in_order.estimate()


def test_a_fix_waits_for_its_odometry():
    fusion = resting()
    fix = position_fix(0.25, 1.1, 2.0, 0.15)
    before = fusion.estimate().pose
    assert fusion.add_fix(fix) is FixVerdict.WAITING
    fusion.add_odometry(0.2, Pose(0.0, 0.0, 0.0), CERTAIN)
    assert fusion.estimate().pose == before
    fusion.add_odometry(0.3, Pose(0.0, 0.0, 0.0), CERTAIN)
    assert fusion.health().verdicts[FixVerdict.ACCEPTED] == 1
    assert fusion.estimate().pose.x > before.x
    assert fusion.add_fix(fix) is FixVerdict.DUPLICATE


def test_fixes_beside_the_time_are_ignored_and_counted():
    fusion = resting(10.0)
    assert fusion.add_fix(position_fix(8.0, 1.0, 2.0, 0.15)) is FixVerdict.LATE
    assert fusion.add_fix(position_fix(99.0, 1.0, 2.0, 0.15)) is FixVerdict.EARLY
    verdicts = fusion.health().verdicts
    assert (verdicts[FixVerdict.LATE], verdicts[FixVerdict.EARLY]) == (1, 1)


def test_the_pose_follows_odometry_between_fixes():
    """Hand calculation: a robot at (1, 2) looking along y that goes 3 m ahead is at (1, 5)."""
    fusion = PoseFusion()
    fusion.add_odometry(0.0, Pose(7.0, 7.0, pi), CERTAIN)
    fusion.set_pose(Pose(1.0, 2.0, pi / 2), KNOWN)
    fusion.add_odometry(1.0, Pose(4.0, 7.0, pi), CERTAIN)
    estimate = fusion.estimate()
    assert estimate.pose == pytest.approx((1.0, 5.0, pi / 2), abs=1e-12)
    assert compose(estimate.map_to_odom, Pose(4.0, 7.0, pi))[:2] == pytest.approx((1.0, 5.0))
    assert estimate.covariance.xx == pytest.approx(0.01 + 9 * 0.001, abs=1e-4)
    assert estimate.covariance.yy == pytest.approx(0.01, abs=1e-4)


def test_without_fixes_it_says_so_and_widens():
    fusion = resting(3.0, fix_timeout=5.0)
    fusion.add_fix(position_fix(3.0, 1.0, 2.0, 0.15))
    assert fusion.health().state is FusionState.TRACKING
    narrow = fusion.health().position_deviation
    walked = Covariance(0.04, 0.0, 0.0, 0.04, 0.0, 0.0)
    fusion.add_odometry(9.0, Pose(0.0, 0.0, 0.0), walked)
    assert fusion.health().state is FusionState.ODOMETRY_ONLY
    assert fusion.health().since_fix == pytest.approx(6.0)
    assert fusion.health().position_deviation == pytest.approx(hypot(narrow, 0.2), rel=0.01)


@pytest.mark.parametrize('new', [Pose(0.0, 0.0, 0.0), Pose(30.0, 5.0, -2.0)])
def test_odometry_that_begins_anew_moves_nobody(new):
    trial = OmniTrial(TrialParameters(seed=1))
    run(trial, 20.0)
    before, truth = trial.fusion.estimate(), trial.robot.pose
    trial.odometry.set_odometry(new)
    trial.step()
    after = trial.fusion.estimate()
    step = hypot(trial.robot.pose.x - truth.x, trial.robot.pose.y - truth.y)
    assert hypot(after.pose.x - before.pose.x, after.pose.y - before.pose.y) < step + 0.001
    assert after.covariance == pytest.approx(before.covariance, rel=0.1, abs=1e-4)
    _, squares = run(trial, 20.0)
    assert np.mean(squares) < 10.0


@pytest.mark.parametrize(
    ('pose', 'noise'),
    [(Pose(30.0, 5.0, -2.0), 2.0), (Pose(1.1, 0.0, 0.0), 0.0)],
    ids=['the pose jumps', 'the covariance begins anew'],
)
def test_either_sign_of_odometry_that_begins_anew_is_seen(pose, noise):
    fusion, walked = resting(), Covariance(0.01, 0.0, 0.0, 0.01, 0.0, 0.01)
    fusion.add_odometry(0.1, Pose(1.0, 0.0, 0.0), walked)
    before = fusion.estimate()
    fusion.add_odometry(0.2, pose, scale(walked, noise))
    assert fusion.estimate().pose == pytest.approx(before.pose, abs=1e-9)
    assert fusion.estimate().covariance == pytest.approx(before.covariance, abs=1e-5)


def test_a_clock_and_a_pose_that_both_leap_start_the_search_again():
    fusion = resting(30.0)
    fusion.add_odometry(1.0, Pose(500.0, 0.0, 0.0), CERTAIN)
    assert fusion.estimate().stamp == pytest.approx(30.0)
    fusion.add_odometry(1.1, Pose(500.0, 0.0, 0.0), CERTAIN)
    assert fusion.estimate() is None
    assert fusion.health().state is FusionState.WAITING
    assert fusion.add_fix(position_fix(1.1, 0.0, 0.0, 0.15)) is FixVerdict.SEARCHING


def test_before_all_it_knows_nothing():
    fusion = PoseFusion()
    assert fusion.estimate() is None
    health = fusion.health()
    assert (health.state, health.position_deviation) == (FusionState.WAITING, inf)
    assert fusion.add_fix(position_fix(1.0, 0.0, 0.0, 0.15)) is FixVerdict.WAITING
    with pytest.raises(SignalError, match='once there is odometry'):
        fusion.set_pose(Pose(0.0, 0.0, 0.0), KNOWN)


def test_malformed_odometry_and_poses_are_refused():
    fusion = resting()
    with pytest.raises(SignalError, match='odometry must be finite'):
        fusion.add_odometry(1.0, Pose(0.0, nan, 0.0), CERTAIN)
    with pytest.raises(SignalError, match='pose must be finite'):
        fusion.set_pose(Pose(inf, 0.0, 0.0), KNOWN)
    with pytest.raises(SignalError, match='not positive definite'):
        fusion.set_pose(Pose(0.0, 0.0, 0.0), CERTAIN)
    assert fusion.estimate().pose == pytest.approx((1.0, 2.0, 0.0), abs=1e-15)


def test_headings_across_the_seam_are_no_surprise():
    fusion = PoseFusion()
    fusion.add_odometry(0.0, Pose(0.0, 0.0, 0.0), CERTAIN)
    fusion.set_pose(Pose(0.0, 0.0, 3.13), KNOWN)
    fusion.add_odometry(1.0, Pose(0.0, 0.0, 0.0), CERTAIN)
    fix = Fix(1.0, 0.0, 0.0, Covariance(0.02, 0.0, 0.0, 0.02, 0.0, 0.001), -3.13)
    assert fusion.add_fix(fix) is FixVerdict.ACCEPTED
    assert abs(wrap(fusion.estimate().pose.theta - pi)) < 0.01


def test_the_frame_of_odometry_does_not_matter():
    """The same drive seen from another `odom`: the same estimate."""
    frame = Pose(100.0, -40.0, 2.0)
    plain, moved = PoseFusion(), PoseFusion()
    for i in range(60):
        pose = Pose(0.2 * i, sin(0.2 * i), wrap(0.1 * i))
        for fusion, odom in ((plain, pose), (moved, compose(inverse(frame), pose))):
            fusion.add_odometry(float(i), odom, CERTAIN)
            fusion.add_fix(position_fix(float(i), pose.x + 0.1 * cos(i), pose.y, 0.15))
    assert moved.estimate().pose == pytest.approx(tuple(plain.estimate().pose), abs=1e-6)
    assert moved.estimate().covariance == pytest.approx(
        tuple(plain.estimate().covariance), abs=1e-6
    )


def test_the_search_looks_at_no_fix_older_than_it_may_take():
    """Of 10 s: that of 2 s counts until 12 s, and no longer."""
    fusion = PoseFusion(FusionParameters(search_time=10.0, alignment_fixes=9))
    for k in range(26):
        fusion.add_odometry(0.5 * k, Pose(0.05 * k, 0.0, 0.0), CERTAIN)
        if k in {2, 4, 6, 24, 25}:
            verdict = fusion.add_fix(position_fix(0.5 * k, 0.05 * k, 0.0, 0.15))
            assert verdict is FixVerdict.SEARCHING
    stamps = [known.fix.stamp for known in fusion._sightings]  # noqa: SLF001 - what is kept
    assert stamps == [3.0, 12.0, 12.5]
