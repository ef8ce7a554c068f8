"""A robot behind its Ghost: arriving, waiting, losing it, holding, aborting, going elsewhere."""

from __future__ import annotations

import re
from itertools import pairwise
from math import hypot, inf, nan, pi

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from agv_motion.errors import SignalError
from agv_motion.planar import REST, Pose, Twist, integrate
from agv_motion.trajectory.follower import Follower
from agv_motion.trajectory.follower_parameters import FollowerParameters
from agv_motion.trajectory.follower_state import FollowerState
from agv_motion.trajectory.ghost_parameters import GhostParameters
from agv_motion.trajectory.holonomic import HolonomicGains
from agv_motion.trajectory.kanayama import KanayamaGains
from agv_motion.trajectory.pace import PaceParameters
from agv_motion.trajectory.ramsete import RamseteGains

ORIGIN = Pose(0.0, 0.0, 0.0)
GOAL = Pose(2.0, 1.0, 0.5)
DT = 0.02


class Ideal:
    """A robot that does what it is told, by ``share`` of it, behind its Follower."""

    def __init__(self, pose=ORIGIN, **parameters):
        """Stand at ``pose``."""
        self.follower = Follower(FollowerParameters(**parameters))
        self.pose, self.share = pose, 1.0
        self.twists = [REST]

    def go(self, goal=GOAL, delta=0.4, ramps=0.5, cruise=0.5, **kind):
        return self.follower.depart(
            self.pose, lambda ghost: ghost.compute_trajectory(goal, delta, ramps, cruise, **kind)
        )

    def run(self, seconds=60.0, until=lambda robot: robot.follower.at_rest):
        for _ in range(round(seconds / DT)):
            if until(self):
                break
            twist = self.follower.step(self.pose, DT)
            self.twists.append(twist)
            done = Twist(*(self.share * part for part in twist))
            self.pose = integrate(self.pose, done, DT)
        return self.follower.state


EACH_LAW = pytest.mark.parametrize('law', ['kanayama', 'ramsete', 'holonomic'])


@EACH_LAW
@pytest.mark.parametrize('kind', [{}, {'backward': True}, {'delta': 0.0}, {'pure_rotation': True}])
def test_it_arrives_where_it_was_sent(law, kind):
    robot = Ideal(Pose(0.0, 0.0, 0.2), law=law)
    robot.go(**kind)
    assert robot.run() is FollowerState.ARRIVED
    goal = Pose(0.0, 0.0, 0.5) if 'pure_rotation' in kind else GOAL
    assert hypot(robot.pose.x - goal.x, robot.pose.y - goal.y) < 0.015
    assert abs(robot.pose.theta - goal.theta) < 0.03
    assert robot.twists[-1] == REST


@EACH_LAW
@pytest.mark.parametrize('share', [0.3, 0.7, 1.2])
@pytest.mark.parametrize('kind', [{}, {'backward': True}, {'delta': 0.0}, {'pure_rotation': True}])
def test_with_slow_or_slipping_wheels_it_arrives_within_its_tolerances(law, share, kind):
    robot = Ideal(Pose(0.0, 0.0, 0.2), law=law)
    robot.share = share
    robot.go(**kind)
    assert robot.run() is FollowerState.ARRIVED
    goal = Pose(0.0, 0.0, 0.5) if 'pure_rotation' in kind else GOAL
    assert hypot(robot.pose.x - goal.x, robot.pose.y - goal.y) <= 0.03
    assert abs(robot.pose.theta - goal.theta) <= 0.06


def nearly_there(robot):
    ghost = robot.follower.ghost
    return ghost.trajectory.duration - ghost.time < 1.5 * DT


def test_a_robot_beside_its_goal_is_led_there():
    """A law of two wheels closes no error across at rest: 5 cm to the left of a goal ahead."""
    robot = Ideal()
    robot.go(Pose(1.0, 0.0, 0.0), delta=0.0)
    robot.run(until=nearly_there)
    robot.pose = robot.pose._replace(y=0.05)
    robot.run(until=lambda robot: robot.follower.state is FollowerState.CORRECTING)
    assert robot.follower.state is FollowerState.CORRECTING
    assert robot.run() is FollowerState.ARRIVED
    assert hypot(robot.pose.x - 1.0, robot.pose.y) <= 0.03
    assert abs(robot.pose.theta) <= 0.06


@EACH_LAW
def test_a_robot_that_cannot_come_up_has_not_arrived_and_says_how_far_it_is(law):
    robot = Ideal(law=law)
    robot.go(Pose(1.0, 0.0, 0.0), delta=0.0)
    robot.run(until=lambda robot: robot.pose.x > 0.9)
    robot.share = 0.0
    robot.run(until=lambda robot: robot.follower.ghost.finished)
    robot.pose = Pose(0.94, 0.0, 0.0)
    assert robot.run() is FollowerState.NOT_ARRIVED
    assert robot.twists[-1] == REST
    said = r'6\.[0-4] cm short, 0\.0 cm to the side, 0\.0 deg turned off; tolerance 3 cm, 3\.4 deg'
    assert re.fullmatch(said, robot.follower.failure)
    robot.share = 1.0
    robot.go()
    assert robot.follower.failure == ''
    assert robot.run() is FollowerState.ARRIVED


def test_beyond_its_goal_it_says_so():
    robot = Ideal(corrections=0)
    robot.go(Pose(-1.0, 0.0, 0.0), delta=0.0, backward=True)
    robot.run(until=nearly_there)
    robot.pose, robot.share = Pose(-1.05, 0.0, 0.0), 0.0
    assert robot.run() is FollowerState.NOT_ARRIVED
    assert robot.follower.failure.startswith('5.0 cm too far')


@EACH_LAW
def test_pushed_aside_while_the_ghost_waits_it_is_led_back_to_its_way(law):
    """0.35 m beside a Ghost that waits from 0.25 m on: without a correction it would for ever."""
    robot = Ideal(law=law)
    robot.go(Pose(3.0, 0.0, 0.0))
    robot.run(seconds=3.0)
    x, y, theta = robot.pose
    robot.pose = Pose(x, y + 0.35, theta)
    assert robot.run() is FollowerState.ARRIVED
    assert hypot(robot.pose.x - 3.0, robot.pose.y) <= 0.03


def test_a_zero_move_arrives_at_once():
    robot = Ideal(GOAL)
    robot.go()
    robot.run(seconds=DT)
    assert robot.follower.state is FollowerState.ARRIVED


def test_before_and_after_it_stands():
    robot = Ideal()
    assert robot.follower.step(ORIGIN, DT) == REST
    assert robot.follower.state is FollowerState.IDLE
    robot.go()
    robot.run()
    assert robot.follower.step(robot.pose, DT) == REST


@EACH_LAW
@pytest.mark.parametrize('seconds', [2.0, 50.0])
def test_the_ghost_waits_for_a_robot_that_is_held_and_goes_on_with_it(law, seconds):
    robot = Ideal(law=law)
    robot.go()
    robot.run(seconds=2.0)
    robot.share = 0.0  # somebody stands in the way
    robot.run(seconds=seconds)
    assert robot.follower.state is FollowerState.WAITING
    assert robot.follower.ghost.locked
    assert 0.2 < robot.follower.separation < 0.6
    where = robot.follower.ghost.pose
    robot.run(seconds=1.0)
    assert robot.follower.ghost.pose == where
    robot.share = 1.0
    assert robot.run() is FollowerState.ARRIVED


def test_a_robot_carried_away_is_lost_and_stops_until_there_is_a_new_goal():
    robot = Ideal()
    robot.go()
    robot.run(seconds=2.0)
    robot.pose = Pose(robot.pose.x, robot.pose.y + 0.7, robot.pose.theta)
    robot.run(seconds=DT)
    assert robot.follower.state is FollowerState.LOST
    assert robot.twists[-1] == REST
    assert robot.follower.separation >= 0.6
    robot.go()
    assert robot.follower.ghost.pose == robot.pose
    assert robot.run() is FollowerState.ARRIVED


def test_a_robot_turned_away_is_lost_too():
    robot = Ideal(pace=PaceParameters(heading_arm=0.3))
    robot.go()
    robot.run(seconds=1.0)
    robot.pose = robot.pose._replace(theta=-pi)
    robot.run(seconds=DT)
    assert robot.follower.state is FollowerState.LOST


def excess(twist, limits):
    """Return the share of its limit that the fastest part of ``twist`` uses."""
    linear = hypot(twist.vx, twist.vy)
    rim = linear + 0.5 * limits.track * abs(twist.wz)
    return max(
        linear / limits.linear_speed, abs(twist.wz) / limits.turn_rate, rim / limits.wheel_speed
    )


@EACH_LAW
def test_held_it_asks_for_no_more_than_the_robot_can_do_and_goes_no_faster_when_released(law):
    """4 1/s times 0.25 m and more would be 1 m/s; its wheels do 0.3 m/s."""
    robot = Ideal(law=law, ghost=GhostParameters(wheel_speed=0.3))
    robot.go()
    robot.run(seconds=2.0)
    robot.share = 0.0
    robot.run(seconds=50.0)
    assert hypot(*robot.twists[-1][:2]) > 0.1
    robot.share = 1.0
    assert robot.run() is FollowerState.ARRIVED
    assert max(excess(t, robot.follower.parameters.ghost) for t in robot.twists) < 1.0 + 1e-9


GAINS = st.floats(0.001, 100.0)


@settings(max_examples=60)
@given(
    st.sampled_from(['kanayama', 'ramsete', 'holonomic']), GAINS, GAINS,
    st.builds(
        GhostParameters, wheel_speed=st.floats(0.01, 5.0), linear_speed=st.floats(0.01, 5.0),
        turn_rate=st.floats(0.01, 9.0), track=st.floats(0.01, 3.0),
    ),
    st.lists(
        st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.floats(-pi, pi)),
        min_size=1, max_size=20,
    ),
)  # fmt: skip
def test_whatever_the_gains_and_the_offset_the_twist_holds_every_limit(
    law, first, second, limits, offsets
):
    robot = Ideal(
        law=law,
        ghost=limits,
        kanayama=KanayamaGains(first, second, second),
        ramsete=RamseteGains(b=first, at_rest=max(second, 0.01)),
        holonomic=HolonomicGains(first, second),
        pace=PaceParameters(lost_beyond=50.0),
    )
    robot.go()
    for dx, dy, turn in offsets:
        x, y, _ = robot.follower.ghost.pose
        robot.pose = Pose(x + dx, y + dy, turn)
        robot.run(seconds=0.2)
    assert max(excess(twist, limits) for twist in robot.twists) < 1.0 + 1e-9


def greatest_change(twists):
    return max(abs(b.vx - a.vx) / DT for a, b in pairwise(twists))


def test_held_it_eases_to_a_halt_and_goes_on_again():
    robot = Ideal()
    robot.go()
    robot.run(seconds=3.0)
    robot.follower.ease_to_halt()
    robot.run(seconds=2.0)
    assert robot.follower.state is FollowerState.LOCKED
    assert robot.follower.ghost.locked
    assert robot.follower.ghost.speeds == (0.0, 0.0)
    assert abs(robot.twists[-1].vx) < 0.01
    robot.follower.go_on()
    assert robot.run() is FollowerState.ARRIVED
    assert greatest_change(robot.twists) < 1.6


def test_held_beforehand_it_waits_for_the_word():
    robot = Ideal()
    robot.follower.ease_to_halt()
    robot.go()
    assert robot.follower.state is FollowerState.LOCKED
    robot.run(seconds=1.0)
    assert robot.pose == ORIGIN
    robot.follower.go_on()
    assert robot.run() is FollowerState.ARRIVED


@pytest.mark.parametrize('held', [False, True])
def test_aborted_it_brakes_and_stays(held):
    robot = Ideal()
    robot.go()
    robot.run(seconds=3.0)
    if held:
        robot.follower.ease_to_halt()
    robot.run(seconds=0.1)
    robot.follower.brake_and_end()
    assert not robot.follower.at_rest
    assert robot.run(seconds=3.0) is FollowerState.ABORTED
    assert greatest_change(robot.twists) < 1.6
    assert robot.twists[-1] == REST
    assert robot.pose.x < 1.9


@pytest.mark.parametrize('aborting', [False, True])
def test_frozen_while_it_brakes_it_has_ended_else_it_goes_on(aborting):
    robot = Ideal()
    robot.go()
    robot.run(seconds=3.0)
    if aborting:
        robot.follower.brake_and_end()
    robot.follower.freeze()
    assert (robot.follower.state is FollowerState.ABORTED) == aborting
    assert robot.run() is (FollowerState.ABORTED if aborting else FollowerState.ARRIVED)


def test_stopped_it_stands_at_once():
    robot = Ideal()
    robot.go()
    robot.run(seconds=2.0)
    robot.follower.end_now()
    assert robot.follower.step(robot.pose, DT) == REST
    assert robot.follower.state is FollowerState.ABORTED
    assert robot.follower.leader.locked


def test_a_new_goal_in_motion_is_taken_up_without_a_jump():
    """It brakes by 0.5 m/s2, and feeds that forward by 30 ms in its first cycle of 20 ms."""
    robot = Ideal()
    robot.go()
    robot.run(seconds=3.0)
    del robot.twists[:-1]
    robot.go(Pose(3.0, 0.0, -0.5))
    assert robot.run() is FollowerState.ARRIVED
    assert hypot(robot.pose.x - 3.0, robot.pose.y) < 0.015
    assert greatest_change(robot.twists) < 1.05 * 0.5 * (0.03 + 0.02) / 0.02 + 0.03


def test_a_refused_goal_changes_nothing():
    robot = Ideal()
    robot.go()
    robot.run(seconds=2.0)
    with pytest.raises(SignalError, match='finite'):
        robot.go(Pose(nan, 0.0, 0.0))
    assert robot.run() is FollowerState.ARRIVED
    assert hypot(robot.pose.x - GOAL.x, robot.pose.y - GOAL.y) < 0.015


@pytest.mark.parametrize('bad', [nan, inf])
def test_a_pose_that_is_none_is_refused_and_changes_nothing(bad):
    robot = Ideal()
    with pytest.raises(SignalError, match='pose'):
        robot.follower.depart(Pose(bad, 0.0, 0.0), lambda ghost: ghost.trajectory)
    robot.go()
    robot.run(seconds=1.0)
    before = robot.follower.ghost.time
    with pytest.raises(SignalError, match='pose'):
        robot.follower.step(Pose(0.0, bad, 0.0), DT)
    assert robot.follower.ghost.time == before
