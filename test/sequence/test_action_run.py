"""Actions one cycle after another: ends, halts, stops, and shares of what is behind."""

from __future__ import annotations

from math import hypot, pi

import pytest

from agv_motion.planar import REST, Pose, Twist, integrate
from agv_motion.route.parameters import FollowParameters
from agv_motion.route.route import Route
from agv_motion.sequence.action_run import EASE, GhostRun, RouteRun, WaitRun
from agv_motion.sequence.actions import GoTo, Rotate
from agv_motion.trajectory.follower import Follower
from agv_motion.trajectory.follower_parameters import FollowerParameters

ORIGIN, DT = Pose(0.0, 0.0, 0.0), 0.05


class Robot:
    """Does at once what it is told."""

    def __init__(self, run):
        self.run, self.pose, self.twist = run, ORIGIN, REST
        run.begin(self.pose)

    def go(self, until, most=2000):
        """Return how many cycles it takes until that holds."""
        for cycle in range(most):
            if until():
                return cycle
            self.twist = self.run.step(self.pose, DT)
            self.pose = integrate(self.pose, self.twist, DT)
        raise AssertionError(self.pose)

    def cycles(self, count):
        left = iter(range(count))
        self.go(lambda: next(left, None) is None)


def ghost_run(action):
    return GhostRun(action, Follower(FollowerParameters()))


def route_run(*points):
    return RouteRun(Route(points), FollowParameters())


def test_a_ghost_that_has_not_left_has_nothing_behind():
    run = ghost_run(GoTo(1.0, 0.0, 0.0))
    assert (run.progress, run.end, run.failure) == (0.0, None, '')


def test_a_drive_ends_at_its_goal_with_all_behind():
    run = ghost_run(GoTo(1.0, 0.5, 90.0))
    robot = Robot(run)
    assert run.end == pytest.approx((1.0, 0.5, pi / 2))
    robot.cycles(20)
    assert 0.0 < run.progress < 1.0
    assert not run.done
    robot.go(lambda: run.done)
    assert run.progress == 1.0
    assert hypot(robot.pose.x - 1.0, robot.pose.y - 0.5) < 0.01


def test_a_drive_tried_again_goes_to_the_end_of_the_first_time():
    """A turn by a quarter, stopped half way, ends at a quarter, not at three eighths more."""
    run = ghost_run(Rotate(by=90.0))
    robot = Robot(run)
    robot.go(lambda: robot.pose.theta > pi / 4)
    run.brake_and_end()
    robot.go(lambda: run.at_rest)
    run.begin(robot.pose)
    robot.go(lambda: run.done)
    assert robot.pose.theta == pytest.approx(pi / 2, abs=0.02)


def test_a_halt_is_eased_and_gone_on_from():
    run = ghost_run(GoTo(2.0, 0.0, 0.0))
    robot = Robot(run)
    robot.cycles(40)
    run.ease_to_halt()
    assert robot.go(lambda: robot.twist == REST) > 1
    assert not run.done
    run.go_on()
    robot.go(lambda: run.done)
    assert robot.pose.x == pytest.approx(2.0, abs=0.01)


def test_what_cannot_be_planned_is_told_and_forgotten_at_the_next_try():
    class SecondTime:
        tries = 0

        def plan(self, ghost):
            self.tries += 1
            curve = 9.0 if self.tries == 1 else 0.3
            return ghost.compute_trajectory(Pose(1.0, 0.0, 0.0), curve, 1.0, 1.0)

    run = ghost_run(SecondTime())
    run.begin(ORIGIN)
    assert 'must lie in [0, 5]' in run.failure
    assert run.end is None
    run.begin(ORIGIN)
    assert (run.failure, run.end) == ('', Pose(1.0, 0.0, 0.0))


def test_a_route_eases_to_a_halt_within_half_a_second_and_on_again():
    run = route_run((0, 0), (3, 0))
    robot = Robot(run)
    robot.cycles(60)
    fast = robot.twist.vx
    assert fast > 0.3
    run.ease_to_halt()
    robot.cycles(round(0.5 * EASE / DT))
    assert robot.twist.vx == pytest.approx(fast / 2, rel=0.1)
    assert robot.go(lambda: run.at_rest) in {
        5,
        6,
    }  # of the ten that it takes; the last may be a rounding
    assert run.step(robot.pose, DT) == REST
    run.go_on()
    robot.cycles(1)
    assert not run.at_rest
    robot.go(lambda: run.done)
    assert (run.progress, run.at_rest) == (1.0, True)
    assert robot.pose.x == pytest.approx(3.0, abs=0.1)


def test_a_route_that_is_ended_goes_on_when_it_is_tried_again():
    run = route_run((0, 0), (3, 0))
    robot = Robot(run)
    robot.cycles(60)
    behind = run.progress
    assert 0.1 < behind < 0.9
    run.brake_and_end()
    robot.go(lambda: run.at_rest)
    run.begin(robot.pose)
    robot.cycles(10)
    assert run.progress > behind
    assert robot.twist.vx > 0.0


def test_a_frozen_route_stands_at_once_and_gathers_speed_again():
    run = route_run((0, 0), (3, 0))
    robot = Robot(run)
    robot.cycles(60)
    fast = robot.twist.vx
    run.freeze()
    assert run.at_rest
    robot.cycles(1)
    assert 0.0 < robot.twist.vx < fast / 4


def test_a_wait_counts_no_time_while_it_is_held():
    run = WaitRun(1.0)
    run.begin(ORIGIN)
    assert run.step(ORIGIN, 0.25) == Twist(0.0, 0.0, 0.0)
    assert run.progress == 0.25
    run.ease_to_halt()
    run.step(ORIGIN, 10.0)
    assert (run.progress, run.done) == (0.25, False)
    run.go_on()
    run.step(ORIGIN, 0.75)
    assert (run.progress, run.done, run.at_rest) == (1.0, True, True)
    assert WaitRun(0.0).progress == 1.0
    longer = WaitRun(4.0)
    longer.step(ORIGIN, 1.0)
    assert (longer.progress, longer.done) == (0.25, False)


def test_a_route_that_has_not_begun_has_nothing_behind_and_sets_out_at_the_first_step():
    run = route_run((0, 0), (3, 0))
    assert (run.progress, run.done, run.at_rest) == (0.0, False, False)
    assert run.step(ORIGIN, DT).vx > 0.0
    assert 0.0 <= run.progress < 0.01


def test_the_pace_goes_from_one_to_zero_and_back_in_half_a_second():
    """A tenth of it in a cycle of a twentieth of a second, also where it is ended for good."""
    run = route_run((0, 0), (3, 0))
    robot = Robot(run)
    for act, left in (
        (run.ease_to_halt, 0.9), (run.go_on, 1.0), (run.brake_and_end, 0.9), (run.freeze, 0.0)
    ):  # fmt: skip
        act()
        robot.cycles(1)
        assert run._pace == pytest.approx(left)  # noqa: SLF001 - the twist has ramps of its own
    run.begin(robot.pose)
    assert run._pace == 1.0  # noqa: SLF001 - as above
    run.freeze()
    run.go_on()
    robot.cycles(3)
    assert run._pace == pytest.approx(0.3)  # noqa: SLF001 - as above
