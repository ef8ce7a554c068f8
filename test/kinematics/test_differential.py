"""Two wheels: hand calculations, both maps as inverses, limits, refusals."""

from __future__ import annotations

from itertools import pairwise
from math import inf, nan, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import GeometryError, SignalError
from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.odometry.base import DifferentialBase
from agv_motion.odometry.wheel_odometry import WheelOdometry
from agv_motion.planar import Twist

DRIVE = DifferentialDrive(0.4, [0.05, 0.04])
SPEEDS = st.floats(-10.0, 10.0)
DRIVES = st.builds(
    lambda track, left, right, factor: DifferentialDrive(track, [left, right], factor),
    st.floats(0.05, 5.0), st.floats(0.01, 1.0), st.floats(0.01, 1.0), st.floats(0.5, 2.0),
)  # fmt: skip


def test_a_hand_calculation():
    """0.5 m/s ahead and 1 rad/s to the left, track 0.4 m: 0.3 and 0.7 m/s; 6 and 17.5 rad/s."""
    command = DRIVE.command(Twist(0.5, 0.0, 1.0))
    assert command.speed == pytest.approx((0.3, 0.7), abs=1e-15)
    assert command.scale == 1.0
    assert DRIVE.rates(command.speed) == pytest.approx((6.0, 17.5), abs=1e-13)


def test_the_matrix_has_a_row_for_each_wheel():
    assert DRIVE.matrix == ((1.0, 0.0, -0.2), (1.0, 0.0, 0.2))
    assert len(DRIVE) == 2
    assert DifferentialDrive(0.4, [0.05, 0.04]).track == 0.4


@given(DRIVES, SPEEDS, SPEEDS)
def test_the_maps_are_inverse(drive, vx, wz):
    there = drive.command(Twist(vx, 0.0, wz)).speed
    assert drive.twist(there) == pytest.approx((vx, 0.0, wz), abs=1e-9)
    assert drive.speeds(drive.rates(there)) == pytest.approx(there, abs=1e-9)


@given(DRIVES, SPEEDS, SPEEDS, st.floats(0.01, 5.0))
def test_a_limit_keeps_the_arc(drive, vx, wz, limit):
    free, held = drive.command(Twist(vx, 0.0, wz)), drive.command(Twist(vx, 0.0, wz), limit)
    assert max(map(abs, held.speed)) <= limit * (1.0 + 1e-12)
    assert held.speed == pytest.approx([held.scale * speed for speed in free.speed], abs=1e-12)
    assert held.scale == 1.0 or max(map(abs, held.speed)) == pytest.approx(limit)


def test_the_track_multiplier_widens_the_track():
    wide = DifferentialDrive(0.4, [0.05, 0.05], 1.25)
    assert wide.track == pytest.approx(0.5)
    assert wide.command(Twist(0.0, 0.0, 1.0)).speed == pytest.approx((-0.25, 0.25))


def test_odometry_of_a_quarter_circle_is_exact_in_one_step():
    """Left wheel 0.5 m * pi / 2, right wheel 0.9 m * pi / 2: the middle goes round 0.7 m."""
    odometry = WheelOdometry(DifferentialBase(DRIVE.track), DRIVE.radii)
    odometry.update(0.0, [0.0, 0.0])
    odometry.update(0.5, [0.5 * pi / 2 / 0.05, 0.9 * pi / 2 / 0.04])
    assert odometry.pose == pytest.approx((0.7, 0.7, pi / 2), abs=1e-12)
    assert odometry.twist == pytest.approx((0.7 * pi, 0.0, pi), abs=1e-12)


@pytest.mark.parametrize('turning', [0.0, 1.0])
def test_the_covariance_of_odometry_grows_with_distance_and_turn(turning):
    odometry = WheelOdometry(DifferentialBase(DRIVE.track), DRIVE.radii)
    traces = []
    for step in range(4):
        odometry.update(0.1 * step, [5.0 * step * (1.0 - turning), 5.0 * step])
        covariance = odometry.covariance()
        traces.append((covariance.xx, covariance.tt))
    assert traces[0] == (0.0, 0.0)
    assert all(a[0] < b[0] and a[1] < b[1] for a, b in pairwise(traces))


@pytest.mark.parametrize('bad', [nan, inf])
def test_what_is_not_finite_is_refused(bad):
    for act in (
        lambda: DRIVE.command(Twist(bad, 0.0, 0.0)),
        lambda: DRIVE.command(Twist(0.0, bad, 0.0)),
        lambda: DRIVE.command(Twist(0.0, 0.0, bad)),
        lambda: DRIVE.twist([bad, 0.0]),
        lambda: DRIVE.rates([0.0, bad]),
        lambda: DRIVE.speeds([bad, bad]),
        lambda: DRIVE.speeds([bad, 0.0]),
        lambda: DRIVE.twist([0.0, bad]),
        lambda: DRIVE.command(Twist(bad, bad, bad)),
    ):
        with pytest.raises(SignalError, match='must be finite'):
            act()


def test_sideways_is_refused():
    with pytest.raises(SignalError, match=r'vy = 0\.1 m/s: a differential drive cannot'):
        DRIVE.command(Twist(0.5, 0.1, 0.0))


def test_one_wheel_is_refused():
    with pytest.raises(SignalError, match='1 wheel speeds for 2 wheels'):
        DRIVE.twist([1.0])


@pytest.mark.parametrize(
    ('values', 'word'),
    [
        ((0.0, [1.0, 1.0]), r'track = 0\.0 m'),
        ((nan, [1.0, 1.0]), 'track = nan m'),
        ((0.4, [0.0, 1.0]), r'left wheel radius = 0\.0 m'),
        ((0.4, [1.0, inf]), 'right wheel radius = inf m'),
        ((0.4, [1.0]), '1 wheel_radii for 2 wheels'),
        ((0.4, [1.0, 1.0], -1.0), r'track_multiplier = -1\.0'),
    ],
)
def test_an_impossible_base_is_refused(values, word):
    with pytest.raises(GeometryError, match=word):
        DifferentialDrive(*values)
