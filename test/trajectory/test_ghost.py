"""The Ghost: exact in time, exact at its goal, never a jump of speed, no limit exceeded."""

from __future__ import annotations

from itertools import accumulate
from math import atan2, hypot, inf, nan, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import ConfigurationError, GeometryError, SignalError
from agv_motion.planar import Pose, wrap
from agv_motion.trajectory.ghost import Ghost, Kinetics
from agv_motion.trajectory.ghost_parameters import GhostParameters
from agv_motion.trajectory.motion import STILL

ORIGIN = Pose(0.0, 0.0, 0.0)
ANGLES = st.floats(-pi, pi, exclude_max=True)
POSES = st.builds(Pose, st.floats(-4.0, 4.0), st.floats(-4.0, 4.0), ANGLES)
DELTAS = st.sampled_from([0.0, 0.2, 0.4, 0.7])
ROUNDINGS = st.sampled_from([0.0, 0.2])


def ghost(start=ORIGIN, **parameters):
    """Return an unlocked Ghost."""
    made = Ghost(start, GhostParameters(**parameters))
    made.lock(False)  # noqa: FBT003
    return made


def leave(made, goal, delta=0.4, ramps=0.5, cruise=0.8, **kind):
    """Send the Ghost on its way; False where the curve has a cusp, which is no matter here."""
    try:
        made.compute_trajectory(goal, delta, ramps, cruise, **kind)
    except GeometryError as error:
        if 'cusp' in str(error):
            return False
        raise
    return True


def test_a_straight_line_in_closed_form():
    """2 m with 0.5 m/s2 to 0.8 m/s: ramps of 1.6 s and 0.64 m, 0.72 m in 0.9 s; 4.1 s in all."""
    made = ghost()
    leave(made, Pose(2.0, 0.0, 0.0))
    assert made.trajectory.duration == pytest.approx(4.1, abs=1e-12)
    made.advance(1.0)
    assert made.controller_kinetics() == Kinetics(made.pose, pytest.approx(0.5, abs=1e-9), 0.0)
    assert made.pose == pytest.approx((0.25, 0.0, 0.0), abs=1e-9)
    made.advance(1.1)
    assert made.pose.x == pytest.approx(0.64 + 0.5 * 0.8, abs=1e-9)
    made.advance(1.5)
    assert made.pose.x == pytest.approx(2.0 - 0.25 * 0.5**2, abs=1e-9)


@settings(max_examples=40)
@given(POSES, POSES, DELTAS, st.booleans(), ROUNDINGS)
def test_the_goal_is_reached_whatever_the_step(start, goal, delta, backward, rounding):
    draw = np.random.default_rng(1)
    for step in (lambda: 0.5, lambda: 0.017, lambda: float(draw.uniform(0.0, 0.3))):
        made = ghost(start, s_curve=rounding)
        if not leave(made, goal, delta, backward=backward):
            return
        before = made.trajectory.pose(made.trajectory.duration - 1e-9)
        while not made.finished:
            made.advance(step())
        assert made.pose == goal
        assert made.speeds == STILL
        assert hypot(before.x - goal.x, before.y - goal.y) < 1e-9
        assert abs(wrap(before.theta - goal.theta)) < 1e-7


def test_the_goal_is_reached_by_milliseconds():
    made = ghost()
    leave(made, Pose(1.0, 0.5, 1.0))
    while not made.finished:
        made.advance(0.001)
    assert made.pose == Pose(1.0, 0.5, 1.0)


@given(POSES, DELTAS, ROUNDINGS, st.lists(st.floats(0.0, 0.5), max_size=12))
def test_where_it_is_depends_on_the_time_alone(goal, delta, rounding, steps):
    stepped, at_once = ghost(s_curve=rounding), ghost(s_curve=rounding)
    if not (leave(stepped, goal, delta) and leave(at_once, goal, delta)):
        return
    for step in steps:
        stepped.advance(step)
    at_once.advance(sum(steps))
    assert stepped.pose == pytest.approx(at_once.pose, abs=1e-9)


@settings(max_examples=60)
@given(POSES, DELTAS, st.booleans(), ROUNDINGS, st.floats(0.05, 0.95))
def test_the_speeds_are_those_of_the_pose(goal, delta, backward, rounding, share):
    made = ghost(s_curve=rounding)
    if not leave(made, goal, delta, backward=backward) or made.finished:
        return
    time, h = share * made.trajectory.duration, 1e-6
    before, now, after = (made.trajectory.pose(time + d) for d in (-h, 0.0, h))
    linear, angular = made.trajectory.speeds(time)
    moved = complex(after.x - before.x, after.y - before.y) / (2 * h)
    assert moved == pytest.approx(linear * complex(np.exp(1j * now.theta)), abs=1e-4)
    assert wrap(after.theta - before.theta) / (2 * h) == pytest.approx(angular, rel=1e-3, abs=1e-3)


@settings(max_examples=60)
@given(POSES, st.sampled_from([0.2, 0.4, 1.0]), ROUNDINGS)
def test_the_limits_hold_at_every_moment(goal, delta, rounding):
    limits = GhostParameters(
        track=0.4, wheel_speed=0.7, lateral_acceleration=0.3, turn_rate=1.2, s_curve=rounding
    )
    made = Ghost(ORIGIN, limits)
    if not leave(made, goal, delta, cruise=0.6):
        return
    for time in np.linspace(0.0, made.trajectory.duration, 200):
        linear, angular = made.trajectory.speeds(float(time))
        assert abs(linear) <= 0.6 * (1 + 1e-9)
        assert abs(linear * angular) <= 0.3 * (1 + 1e-3)
        assert abs(angular) <= 1.2 * (1 + 1e-3)
        assert abs(linear) + 0.2 * abs(angular) <= 0.7 * (1 + 1e-3)


def test_without_handles_it_turns_drives_and_turns():
    """To (1, 1, 0): a turn of 45 degrees, sqrt(2) m, and 45 degrees back."""
    made = ghost()
    leave(made, Pose(1.0, 1.0, 0.0), 0.0)
    turn, drive, back = made.trajectory.motions
    assert turn.angle == back.angle == pytest.approx(pi / 4, abs=1e-12)
    assert drive.length == pytest.approx(sqrt(2.0), abs=1e-12)
    made.advance(turn.duration + 0.5 * drive.duration)
    assert made.pose == pytest.approx((0.5, 0.5, pi / 4), abs=1e-9)
    assert not made.rotating
    made.advance(0.5 * drive.duration + 0.1)
    assert made.rotating


def test_backwards_the_heading_is_against_the_way():
    made = ghost()
    leave(made, Pose(-2.0, 0.5, 0.3), backward=True)
    assert made.backward
    made.advance(1.0)
    linear, _ = made.speeds
    assert linear < 0.0
    assert made.pose.x < 0.0
    assert abs(made.pose.theta) < pi / 2


@given(ANGLES, ANGLES, st.floats(0.1, 1.0))
def test_a_pure_rotation_keeps_its_place(start, heading, ramps):
    made = ghost(Pose(1.0, 2.0, start))
    made.compute_trajectory(Pose(9.0, 9.0, heading), 0.4, ramps, 0.8, pure_rotation=True)
    angle = abs(wrap(heading - start))
    if angle > 1e-6:
        peak = min(0.8, sqrt(angle * ramps))
        assert made.trajectory.duration == pytest.approx(angle / peak + peak / ramps, rel=1e-9)
        assert made.rotating
    made.advance(made.trajectory.duration / 2)
    assert made.pose[:2] == (1.0, 2.0)
    assert abs(wrap(made.pose.theta - start)) == pytest.approx(angle / 2, abs=1e-9)
    made.advance(made.trajectory.duration)
    assert made.pose == (1.0, 2.0, heading)


@pytest.mark.parametrize('kind', [{}, {'pure_rotation': True}, {'backward': True}])
@pytest.mark.parametrize('delta', [0.0, 0.4])
def test_a_zero_move_finishes_at_once(delta, kind):
    made = ghost(Pose(1.0, 2.0, 3.0))
    made.compute_trajectory(Pose(1.0, 2.0, 3.0), delta, 0.5, 1.0, **kind)
    assert made.finished
    assert made.controller_kinetics(0.1) == (Pose(1.0, 2.0, 3.0), 0.0, 0.0)


def test_time_stands_still_while_locked():
    made = Ghost(ORIGIN)
    leave(made, Pose(2.0, 1.0, 0.0))
    assert made.locked
    made.advance(1.0)
    assert made.pose == ORIGIN
    assert made.controller_kinetics(0.5) == (ORIGIN, 0.0, 0.0)
    assert not made.finished


def test_the_servo_hears_of_the_speed_in_advance():
    made = ghost()
    leave(made, Pose(2.0, 0.0, 0.0))
    made.advance(1.0)
    pose, linear, _ = made.controller_kinetics(0.2)
    assert pose.x == pytest.approx(0.25, abs=1e-9)
    assert linear == pytest.approx(0.6, abs=1e-9)


@settings(max_examples=60)
@given(st.tuples(POSES, POSES), DELTAS, st.booleans(), ROUNDINGS, st.floats(0.05, 0.95))
def test_a_new_goal_in_motion_makes_no_jump_of_speed(goals, delta, backward, rounding, share):
    """Whatever the second goal: if its curve cannot be gone at once, the Ghost brakes first."""
    made = ghost(s_curve=rounding, turn_step=0.2)
    first, second = goals
    if not leave(made, first, 0.4):
        return
    made.advance(share * made.trajectory.duration)
    pose, (linear, angular) = made.pose, made.speeds
    if not leave(made, second, delta, backward=backward):
        assert made.pose == pose
        return
    assert made.pose == pytest.approx(pose, abs=1e-9)
    assert made.speeds.linear == pytest.approx(linear, abs=1e-9)
    assert made.speeds.angular == pytest.approx(angular, abs=0.2 + 1e-6)
    for start in accumulate(motion.duration for motion in made.trajectory.motions[:-1]):
        before, after = (made.trajectory.speeds(start + h).angular for h in (-1e-7, 1e-7))
        assert abs(after - before) <= 0.2 + 1e-3
    times = np.linspace(0.0, made.trajectory.duration, 400)
    speeds = np.array([made.trajectory.speeds(float(time)).linear for time in times])
    assert np.abs(np.diff(speeds)).max() <= 0.5 * (times[1] - times[0]) * (1 + 1e-6) + 1e-9
    places = np.array([made.trajectory.pose(float(time))[:2] for time in times])
    assert np.hypot(*np.diff(places, axis=0).T).max() <= 0.8 * (times[1] - times[0]) + 1e-9
    made.advance(made.trajectory.duration + 1.0)
    assert made.pose == second


def away(trajectory, pose):
    """Return how far a pose lies off a trajectory [m]: looked for in steps, then in finer ones."""
    first, last = 0.0, trajectory.duration
    for _ in range(2):
        times = np.linspace(first, last, 80)
        ways = [trajectory.pose(float(time)) for time in times]
        distances = [hypot(p.x - pose.x, p.y - pose.y) for p in ways]
        nearest = int(np.argmin(distances))
        first, last = times[max(nearest - 1, 0)], times[min(nearest + 1, 79)]
    return min(distances)


@settings(max_examples=60)
@given(POSES, DELTAS, ROUNDINGS, st.floats(0.0, 1.0))
def test_aborted_it_brakes_on_its_way(goal, delta, rounding, share):
    made = ghost(s_curve=rounding)
    if not leave(made, goal, delta):
        return
    planned = made.trajectory
    made.advance(share * planned.duration)
    linear, angular = made.speeds
    had_arrived = made.finished
    made.brake_and_end()
    assert made.aborted is not had_arrived
    assert made.speeds == pytest.approx((linear, angular), abs=1e-9)
    left = made.trajectory.duration - made.time
    assert left <= max(abs(linear) / 0.5, abs(angular) / 2.0) + 1.5 * rounding + 1e-9
    made.advance(left + 1e-9)
    assert made.finished
    assert away(planned, made.pose) < 5e-3


def test_a_dawdling_ghost_is_slow_and_on_its_way():
    made, swift = ghost(), ghost()
    leave(made, Pose(2.0, 1.0, 0.5))
    leave(swift, Pose(2.0, 1.0, 0.5))
    made.advance(2.0, rate=0.5)
    swift.advance(1.0)
    assert made.pose == swift.pose
    assert made.speeds.linear == pytest.approx(0.5 * swift.speeds.linear, rel=1e-12)


def test_a_path_is_driven_through_without_a_stop():
    made = ghost()
    via, end = Pose(2.0, 1.0, 0.6), Pose(4.0, 1.0, -0.6)
    made.compute_path([via, end], 0.4, 0.5, 0.8)
    times = np.linspace(0.0, made.trajectory.duration, 3001)
    poses = [made.trajectory.pose(float(time)) for time in times]
    nearest = int(np.argmin([hypot(p.x - via.x, p.y - via.y) for p in poses]))
    assert hypot(poses[nearest].x - via.x, poses[nearest].y - via.y) < 1e-3
    assert abs(poses[nearest].theta - via.theta) < 2e-3
    assert made.trajectory.speeds(float(times[nearest])).linear > 0.5
    assert made.trajectory.end == end


def test_where_two_curves_meet_the_turn_rate_hardly_jumps():
    """Two quarter-like bends, one left and one right: the curvature jumps where they meet."""
    made = Ghost(ORIGIN, GhostParameters(turn_step=0.1))
    made.compute_path([Pose(1.0, 1.0, pi / 2), Pose(2.0, 2.0, 0.0)], 0.5, 0.5, 0.8)
    (drive,) = made.trajectory.motions
    (joint,) = np.flatnonzero(np.diff(drive.course.way) == 0.0)
    jump = np.diff(drive.course.curvature)[joint]
    (slow,) = [s for s in made.report().slow if s.reason == 'jump of curvature']
    assert slow.start == slow.end == pytest.approx(drive.course.way[joint])
    assert slow.speed == pytest.approx(0.1 / abs(jump))
    times = np.linspace(0.0, made.trajectory.duration, 20001)
    rates = [made.trajectory.speeds(float(time)).angular for time in times]
    assert np.abs(np.diff(rates)).max() < 0.1 + 1e-2


def test_the_report_names_what_makes_it_slow():
    """A U-turn 0.3 m wide: its bend is too sharp for the lateral acceleration."""
    made = Ghost(ORIGIN, GhostParameters(lateral_acceleration=0.2, wheel_speed=5.0, turn_rate=9.0))
    leave(made, Pose(0.0, 1.0, -pi), delta=0.6, cruise=1.0)
    report = made.report()
    assert report.duration == made.trajectory.duration
    assert {slow.reason for slow in report.slow} == {'lateral acceleration'}
    slow = min(report.slow, key=lambda stretch: stretch.speed)
    assert 0.0 <= slow.start < slow.end <= report.length
    assert slow.speed == pytest.approx(sqrt(0.2 / report.top_curvature), rel=0.01)


def test_the_report_of_a_straight_line():
    made = ghost()
    leave(made, Pose(3.0 * 0.6, 3.0 * 0.8, atan2(0.8, 0.6)), 0.0)
    report = made.report()
    assert report.length == pytest.approx(3.0, abs=1e-12)
    assert report.turn == pytest.approx(2 * 0.0 + atan2(0.8, 0.6), abs=1e-12)
    assert report.top_speed == 0.8
    assert report.slow == ()


def test_placed_it_starts_from_there():
    made = ghost()
    made.place(Pose(1.0, 1.0, 3.5 * pi))
    assert made.pose == pytest.approx((1.0, 1.0, -pi / 2), abs=1e-12)
    leave(made, Pose(4.0, 4.0, 0.0))
    made.advance(1.0)
    with pytest.raises(GeometryError, match='abort or lock'):
        made.place(ORIGIN)


@pytest.mark.parametrize(
    ('goal', 'delta', 'ramps', 'cruise', 'word'),
    [
        (Pose(nan, 0, 0), 0.4, 0.5, 1.0, 'finite'),
        (Pose(1, 0, inf), 0.4, 0.5, 1.0, 'finite'),
        (Pose(1, 0, 0), -0.1, 0.5, 1.0, 'delta_curve = -0.1'),
        (Pose(1, 0, 0), nan, 0.5, 1.0, 'delta_curve = nan'),
        (Pose(1, 0, 0), 0.4, -0.5, 1.0, 'speed_ramps = -0.5'),
        (Pose(1, 0, 0), 0.4, 5e-324, 1.0, r'speed_ramps = 5e-324 m/s2: .* for no ramp give 0'),
        (Pose(1, 0, 0), 0.4, 0.5, 5e-324, 'cruising_speed = 5e-324'),
        (Pose(1, 0, 0), 0.4, inf, 1.0, 'speed_ramps = inf'),
        (Pose(1, 0, 0), 0.4, 0.5, -1.0, 'cruising_speed = -1.0'),
    ],
)
def test_what_cannot_be_is_refused_and_changes_nothing(goal, delta, ramps, cruise, word):
    made = ghost()
    leave(made, Pose(2.0, 0.0, 0.0))
    made.advance(1.0)
    before = made.trajectory, made.pose
    with pytest.raises((SignalError, ConfigurationError), match=word):
        made.compute_trajectory(goal, delta, ramps, cruise)
    assert (made.trajectory, made.pose) == before


def test_no_goal_is_refused():
    with pytest.raises(ConfigurationError, match='at least one'):
        ghost().compute_path([], 0.4, 0.5, 1.0)


@pytest.mark.parametrize(('dt', 'rate'), [(-0.1, 1.0), (nan, 1.0), (inf, 1.0), (0.1, 1.5)])
def test_time_that_cannot_pass_is_refused(dt, rate):
    with pytest.raises(SignalError, match='dt ='):
        ghost().advance(dt, rate)


@pytest.mark.parametrize('name', ['track', 'wheel_speed', 'lateral_acceleration', 'turn_rate'])
@pytest.mark.parametrize('value', [0.0, -1.0, nan, inf])
def test_limits_that_cannot_be_are_refused(name, value):
    with pytest.raises(ConfigurationError, match=name):
        GhostParameters(**{name: value})


def test_headings_lie_in_their_range():
    made = ghost(Pose(0.0, 0.0, 3.0))
    leave(made, Pose(-2.0, -1.0, -3.0))
    for time in np.linspace(0.0, made.trajectory.duration, 500):
        assert -pi <= made.trajectory.pose(float(time)).theta < pi
    assert sin(made.trajectory.end.theta) == sin(-3.0)
