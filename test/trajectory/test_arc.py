"""Arcs: hand calculations, the ratio at every moment, the exact stop, the predicted end."""

from __future__ import annotations

from math import copysign, inf, nan, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.kinematics.differential import DifferentialDrive
from agv_motion.planar import Pose, integrate, wrap
from agv_motion.trajectory.arc import Arc
from agv_motion.trajectory.arc_run import ArcRun
from agv_motion.trajectory.bounds import NO_RAMP
from agv_motion.trajectory.ghost import Ghost
from agv_motion.trajectory.ghost_parameters import GhostParameters

TRACK = 0.3
ORIGIN = Pose(0.0, 0.0, 0.0)
ARCS = st.builds(
    Arc,
    st.floats(-15.0, 15.0),
    st.one_of(st.just(0.0), st.floats(0.0, 5.0), st.floats(100.0, 1e4)),
    st.floats(0.1, 1.0),
    st.floats(0.05, 2.0).flatmap(lambda speed: st.sampled_from([speed, -speed])),
    st.floats(0.1, 3.0),
)
POSES = st.builds(Pose, st.floats(-4, 4), st.floats(-4, 4), st.floats(-pi, pi, exclude_max=True))


def driven(arc, start, steps):
    """Return where wheels that hold each cycle's speeds carry the robot."""
    drive, run, pose = DifferentialDrive(arc.track, [1.0, 1.0]), ArcRun(arc), start
    while not run.finished:
        dt = steps()
        pose = integrate(pose, drive.twist(run.advance(dt)), dt)
    assert run.advance(0.1) == (0.0, 0.0)
    return pose, run


def test_a_hand_calculation():
    """90 degrees round an inner circle of 1 m, track 0.3 m: 0.785 and 1.257 m, ratio 0.625."""
    arc = Arc(pi / 2, 1.0, TRACK, 0.4, 0.5)
    assert arc.ratio == pytest.approx(0.5 / 0.8)
    assert arc.wheels(arc.outer_distance) == pytest.approx((0.25 * pi, 0.4 * pi))
    assert arc.end(ORIGIN) == pytest.approx((0.65, 0.65, pi / 2), abs=1e-15)


@pytest.mark.parametrize(
    ('angle', 'speed', 'end'),
    [
        (pi / 2, 0.4, (0.65, 0.65, pi / 2)),
        (-pi / 2, 0.4, (0.65, -0.65, -pi / 2)),
        (pi / 2, -0.4, (-0.65, 0.65, -pi / 2)),
        (-pi / 2, -0.4, (-0.65, -0.65, pi / 2)),
    ],
)
def test_the_four_senses(angle, speed, end):
    """Left and right by the side of the centre, forward and backward by the speed."""
    arc = Arc(angle, 1.0, TRACK, speed, 0.5)
    assert arc.end(ORIGIN) == pytest.approx(end, abs=1e-15)
    wheels = arc.wheels(1.0)
    assert wheels[angle > 0.0] == copysign(1.0, speed)
    assert wheels[angle < 0.0] == pytest.approx(copysign(arc.ratio, speed))


def test_diameter_0_pivots_on_the_inner_wheel():
    """The left wheel stands at (0, 0.15); half a turn about it ends at (0, 0.3)."""
    arc = Arc(pi, 0.0, TRACK, 0.4, 0.5)
    assert arc.wheels(arc.outer_distance) == pytest.approx((0.0, 0.3 * pi))
    pose, _ = driven(arc, ORIGIN, lambda: 0.07)
    assert pose[:2] == pytest.approx((0.0, 0.3), abs=1e-9)
    assert abs(wrap(pose.theta - pi)) < 1e-9


def test_angle_0_is_done_at_once():
    run = ArcRun(Arc(0.0, 1.0, TRACK, 0.4, 0.5))
    assert run.finished
    assert run.advance(0.01) == (0.0, 0.0)
    ghost = Ghost(ORIGIN)
    ghost.compute_arc(0.0, 1.0, 0.5, 0.4)
    assert ghost.finished


@given(ARCS, POSES)
def test_the_wheels_end_exactly_where_predicted_whatever_the_step(arc, start):
    draw = np.random.default_rng(1)
    expected = arc.end(start)
    for longest in (0.017, 3.0):
        step = max(longest, ArcRun(arc).duration / 2000.0)  # not millions of them
        pose, run = driven(arc, start, lambda step=step: float(draw.uniform(0.1, 1.0)) * step)
        assert run.travel == pytest.approx(arc.wheels(arc.outer_distance), abs=1e-12)
        scale = 1.0 + arc.length
        assert pose[:2] == pytest.approx(expected[:2], abs=1e-9 * scale)
        assert abs(wrap(pose.theta - expected.theta)) < 1e-9


@given(ARCS)
def test_the_ramps_keep_the_ratio(arc):
    run, dt = ArcRun(arc), ArcRun(arc).duration / 37.3 or 0.1
    while not run.finished:
        inner, outer = sorted(map(abs, run.advance(dt)))
        assert inner == pytest.approx(arc.ratio * outer, abs=1e-12)
        assert outer <= abs(arc.speed) * (1.0 + 1e-9)


def test_speed_and_ramp_are_those_of_the_outer_wheel():
    """2 m of the outer wheel at 0.4 m/s with 0.5 m/s2: 2 / 0.4 + 0.4 / 0.5 = 5.8 s."""
    assert ArcRun(Arc(2.0 / 0.8, 1.0, TRACK, 0.4, 0.5)).duration == pytest.approx(5.8)
    limits = GhostParameters(track=TRACK, lateral_acceleration=9.0, turn_rate=9.0)
    ghost = Ghost(ORIGIN, limits)
    assert ghost.compute_arc(2.0 / 0.8, 1.0, 0.5, 0.4).duration == pytest.approx(5.8)


@given(ARCS, POSES, st.floats(0.0, 1.0))
def test_the_ghost_keeps_to_the_circle_and_ends_where_predicted(arc, start, share):
    limits = GhostParameters(
        track=arc.track, lateral_acceleration=1.0, longest_way=1e6, longest_time=1e7
    )
    ghost = Ghost(start, limits)
    ghost.compute_arc(arc.angle, arc.diameter, arc.ramp, arc.speed)
    expected = arc.end(start)
    assert ghost.trajectory.end == expected
    before = ghost.trajectory.pose(ghost.trajectory.duration * (1.0 - 1e-12))
    assert before[:2] == pytest.approx(expected[:2], abs=1e-9 * (1.0 + arc.length))
    time = share * ghost.trajectory.duration
    linear, angular = ghost.trajectory.speeds(time)
    left, right = DifferentialDrive(arc.track, [1.0, 1.0]).command((linear, 0.0, angular)).speed
    inner, outer = (left, right) if arc.angle > 0.0 else (right, left)
    assert inner == pytest.approx(arc.ratio * outer, abs=1e-9)
    assert abs(outer) <= min(abs(arc.speed), 1.0) * (1.0 + 1e-9)
    assert abs(linear * angular) <= 1.0 + 1e-9


def test_the_report_says_why_an_arc_is_slow():
    ghost = Ghost(ORIGIN, GhostParameters(track=TRACK, lateral_acceleration=0.1))
    ghost.compute_arc(pi, 1.0, 0.5, 0.8)
    report = ghost.report()
    assert report.length == pytest.approx(0.65 * pi)
    assert report.top_curvature == pytest.approx(1.0 / 0.65)
    assert [slow.reason for slow in report.slow] == ['lateral acceleration']


def test_aborted_on_an_arc_it_brakes_on_its_circle():
    ghost = Ghost(ORIGIN, GhostParameters(track=TRACK))
    ghost.lock(False)  # noqa: FBT003
    ghost.compute_arc(pi, 2.0, 0.5, 0.5)
    ghost.advance(2.0)
    ghost.brake_and_end()
    ghost.advance(5.0)
    assert ghost.finished
    assert abs(complex(ghost.pose.x, ghost.pose.y) - 1.15j) == pytest.approx(1.15, abs=1e-9)


@pytest.mark.parametrize(
    ('values', 'word'),
    [
        ((nan, 1.0, 0.3, 0.4, 0.5), 'angle = nan'),
        ((1.0, -1.0, 0.3, 0.4, 0.5), r'diameter = -1\.0 m'),
        ((1.0, inf, 0.3, 0.4, 0.5), 'diameter = inf'),
        ((1.0, 1.0, 0.0, 0.4, 0.5), r'track = 0\.0'),
        ((1.0, 1.0, 0.3, 0.0, 0.5), 'speed'),
        ((1.0, 1.0, 0.3, nan, 0.5), 'speed'),
        ((1.0, 1.0, 0.3, 0.4, -0.5), r'ramp = -0\.5'),
        ((1.5e9, 1.0, 0.3, 0.4, 0.5), 'angle = 1500000000'),
        ((1.0, 1.5e9, 0.3, 0.4, 0.5), 'diameter = 1500000000'),
        ((1.0, 1.0, 1.5e9, 0.4, 0.5), 'track = 1500000000'),
        ((1.0, 1.0, 0.9e-6, 0.4, 0.5), 'track = 9e-07'),
    ],
)
def test_an_impossible_arc_is_refused(values, word):
    with pytest.raises(ConfigurationError, match=word):
        Arc(*values)


@pytest.mark.parametrize('dt', [0.0, -0.1, nan, inf])
def test_time_that_cannot_pass_is_refused(dt):
    with pytest.raises(SignalError, match='dt ='):
        ArcRun(Arc(1.0, 1.0, TRACK, 0.4, 0.5)).advance(dt)


@pytest.mark.parametrize(
    ('angle', 'speed', 'rate'), [(pi, 0.5, 1.0), (-pi, 0.5, -1.0), (pi, -0.5, -1.0)]
)
def test_it_tells_duration_and_turn_rate(angle, speed, rate):
    """Outer radius 0.5 m: pi/2 m at 0.5 m/s, ramps of 0.25 m/s2 add 2 s."""
    arc = Arc(angle, 0.4, 0.3, speed, 0.25)
    assert arc.turn_rate == pytest.approx(rate)
    assert arc.duration == pytest.approx(pi + 2.0)
    assert arc.duration == pytest.approx(ArcRun(arc).duration, rel=1e-12)


def test_without_ramp_it_takes_length_over_speed():
    assert Arc(pi, 0.4, 0.3, 0.5, NO_RAMP).duration == pytest.approx(pi)
    assert Arc(0.0, 0.4, 0.3, 0.5, 1.0).duration == 0.0


@pytest.mark.parametrize(('angle', 'rate'), [(0.5, 0.8), (-0.5, -0.8), (2.0, 0.8), (-2.0, -0.8)])
def test_how_fast_the_heading_turns_by_hand(angle, rate):
    """0.4 m/s on a radius of half of 0.4 m and a track of 0.3 m, however short the arc."""
    assert Arc(angle, 0.4, 0.3, 0.4, 0.3).turn_rate == pytest.approx(rate)
