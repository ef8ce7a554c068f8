"""Sequences while they run, with an ideal robot: ends, time-outs, failures, pause and abort."""

from __future__ import annotations

import re
from itertools import pairwise
from math import hypot, nan, radians

import pytest

from agv_motion.errors import SignalError
from agv_motion.planar import REST, Pose, Twist, integrate, wrap
from agv_motion.route.parameters import FollowParameters
from agv_motion.route.route import Route
from agv_motion.sequence.actions import DriveArc, FollowRoute, GoTo, Rotate, Wait
from agv_motion.sequence.runner import SequenceRunner, SequenceState
from agv_motion.sequence.sequence import OnFailure, Sequence, SequenceStep
from agv_motion.trajectory.follower_parameters import FollowerParameters

ROUTE = Route([(0, 0), (2, 0), (2, 2)])
STOP, SKIP = OnFailure(), OnFailure(skip=True)


class Drive:
    """A robot that does at once what it is told, and the sequence that tells it."""

    def __init__(self, *actions, timeout=60.0, on_failure=STOP):
        steps = tuple(
            SequenceStep(type(action).__name__, action, timeout, on_failure, f'm.yaml:{i}:1')
            for i, action in enumerate(actions)
        )
        self.runner = SequenceRunner(
            Sequence('test', steps), FollowerParameters(), FollowParameters()
        )
        self.pose, self.share = Pose(0.0, 0.0, 0.0), 1.0
        self.time = 0.0
        self.twist = REST
        self.ends = []

    def tick(self, dt=0.05, *, seen=True, stuck=False):
        number = self.runner.status.number
        self.twist = self.runner.step(self.pose if seen else None, dt)
        if self.runner.status.number != number or self.runner.ended:
            self.ends.append(self.pose)
        if not stuck:
            done = Twist(*(self.share * part for part in self.twist))
            self.pose = integrate(self.pose, done, dt)
        self.time += dt

    def run(self, seconds=1000.0, dt=0.05, **options):
        """Go on for ``seconds``, or until it is over; return the state."""
        end = self.time + seconds
        while not self.runner.ended and self.time < end - 1e-9:
            self.tick(dt, **options)
        return self.runner.status.state


@pytest.mark.parametrize('dt', [0.01, 0.05, 0.1])
def test_all_actions_end_where_they_should_whatever_the_rate(dt):
    drive = Drive(
        GoTo(2.0, 1.0, 90.0), Rotate(by=270.0), DriveArc(-180.0, 0.7), Wait(0.5),
        GoTo(0.0, 0.0, 180.0), FollowRoute(ROUTE), Rotate(to=45.0),
    )  # fmt: skip
    assert drive.run(dt=dt) is SequenceState.DONE
    assert drive.twist == REST
    wanted = [(2.0, 1.0, 90.0), (2.0, 1.0, 0.0), (2.0, 0.0, -180.0), (2.0, 0.0, -180.0),
              (0.0, 0.0, 180.0)]  # fmt: skip
    for end, (x, y, heading) in zip(drive.ends, wanted, strict=False):
        assert hypot(end.x - x, end.y - y) < 0.01
        assert abs(wrap(end.theta - radians(heading))) < 0.02
    assert hypot(drive.pose.x - 2.0, drive.pose.y - 2.0) < 0.03
    assert drive.pose.theta == pytest.approx(radians(45.0), abs=0.02)


def test_small_errors_do_not_add_up():
    """Sixty turns of 90 deg end at the heading of the start, within the error of one."""
    drive = Drive(*[Rotate(by=90.0, speed=180.0, acceleration=720.0)] * 60)
    assert drive.run() is SequenceState.DONE
    assert abs(drive.pose.theta) < 0.02


def test_the_same_sequence_runs_the_same_twice():
    first, second = (Drive(GoTo(1.0, 1.0, 0.0), FollowRoute(ROUTE)) for _ in range(2))
    first.run()
    second.run()
    assert first.pose == second.pose
    assert first.time == second.time


def test_progress_counts_up():
    drive = Drive(GoTo(2.0, 0.0, 0.0), Wait(1.0))
    shares = []
    while not drive.runner.ended:
        drive.tick()
        status = drive.runner.status
        shares.append(status.number + status.progress)
    assert all(a <= b for a, b in pairwise(shares))
    assert shares[0] < 0.1
    assert shares[-1] == 2.0


def test_the_time_of_each_action_is_its_own():
    drive, begun = Drive(Wait(1.0), Wait(0.5), Wait(1.0)), [0.0]
    while not drive.runner.ended:
        assert drive.runner.status.elapsed == pytest.approx(drive.time - begun[-1])
        before = drive.runner.status.number
        drive.tick()
        if drive.runner.status.number != before:
            begun.append(drive.time)
    assert begun == pytest.approx([0.0, 1.0, 1.5], abs=0.11)


def test_a_timeout_stops_the_robot_with_a_ramp_and_ends_it():
    drive = Drive(GoTo(9.0, 0.0, 0.0), Wait(1.0), timeout=5.0)
    drive.run(5.0)
    assert drive.twist.vx == pytest.approx(0.4, abs=0.02)
    speeds = []
    while not drive.runner.ended:
        drive.tick()
        speeds.append(drive.twist.vx)
    assert drive.runner.status.state is SequenceState.FAILED
    assert drive.runner.status.number == 0
    assert 'm.yaml:0:1: GoTo: not done within 5 s' in drive.runner.status.reason
    assert 0.8 < 0.05 * len(speeds) < 2.0
    assert drive.runner.step(drive.pose, 0.05) == REST


def test_a_failure_may_be_skipped():
    drive = Drive(GoTo(9.0, 0.0, 0.0), Rotate(by=90.0), timeout=5.0, on_failure=SKIP)
    assert drive.run() is SequenceState.DONE
    assert 1.0 < drive.pose.x < 4.0
    assert drive.pose.theta == pytest.approx(radians(90.0), abs=0.02)
    assert 'not done within' in drive.runner.status.reason


def test_a_retry_goes_on_to_the_same_end():
    """9 m take 24 s; three times 10 s are enough, two are not."""
    enough = Drive(GoTo(9.0, 0.0, 0.0), timeout=10.0, on_failure=OnFailure(2))
    assert enough.run() is SequenceState.DONE
    assert enough.runner.status.attempt == 3
    assert enough.pose.x == pytest.approx(9.0, abs=0.01)
    too_few = Drive(GoTo(9.0, 0.0, 0.0), timeout=10.0, on_failure=OnFailure(1))
    assert too_few.run() is SequenceState.FAILED


@pytest.mark.parametrize(
    ('action', 'end'),
    [
        (Rotate(by=350.0), (0.0, 0.0, -10.0)),
        (DriveArc(180.0, 2.0), (0.0, 2.3, 180.0)),
        (FollowRoute(ROUTE), (2.0, 2.0, 90.0)),
        (Wait(6.0), (0.0, 0.0, 0.0)),
    ],
)
def test_every_action_may_be_tried_again(action, end):
    drive = Drive(action, timeout=4.0, on_failure=OnFailure(5))
    assert drive.run() is SequenceState.DONE
    assert drive.runner.status.attempt > 1
    assert hypot(drive.pose.x - end[0], drive.pose.y - end[1]) < 0.03
    assert abs(wrap(drive.pose.theta - radians(end[2]))) < 0.1


def test_a_robot_that_is_stuck_has_failed():
    """The Ghost waits for it, until the time is over."""
    drive = Drive(GoTo(2.0, 0.0, 0.0), timeout=5.0)
    assert drive.run(stuck=True) is SequenceState.FAILED
    assert drive.time < 8.0


def test_a_robot_carried_away_has_failed_at_once():
    drive = Drive(GoTo(2.0, 0.0, 0.0))
    drive.run(2.0)
    drive.pose = Pose(0.0, 3.0, 0.0)
    drive.tick()
    assert drive.twist == REST
    assert drive.runner.status.state is SequenceState.FAILED
    assert 'off its way' in drive.runner.status.reason


@pytest.mark.parametrize('action', [GoTo(4.0, 0.0, 0.0), FollowRoute(ROUTE), Wait(4.0)])
def test_pause_eases_to_a_halt_and_its_time_does_not_count(action):
    drive = Drive(action, timeout=20.0)
    drive.run(2.0)
    drive.runner.pause()
    drive.run(1.0)
    assert drive.runner.status.state is SequenceState.PAUSED
    assert drive.twist == REST
    place = drive.pose
    drive.run(100.0)
    assert drive.pose == place
    drive.runner.resume()
    assert drive.run() is SequenceState.DONE


def test_pause_changes_the_speed_without_a_jump():
    drive = Drive(GoTo(4.0, 0.0, 0.0))
    drive.run(3.0)
    drive.runner.pause()
    speeds = [drive.twist.vx]
    for _ in range(12):
        drive.tick()
        speeds.append(drive.twist.vx)
    assert max(a - b for a, b in pairwise(speeds)) < 0.1
    assert speeds[-1] == 0.0


@pytest.mark.parametrize('action', [GoTo(4.0, 0.0, 0.0), FollowRoute(ROUTE), Wait(4.0)])
@pytest.mark.parametrize('paused', [False, True])
def test_abort_ends_it_at_rest(action, paused):
    drive = Drive(action, Wait(1.0))
    drive.run(2.0)
    if paused:
        drive.runner.pause()
        drive.run(1.0)
    drive.runner.abort()
    assert drive.run(3.0) is SequenceState.ABORTED
    assert drive.twist == REST
    assert drive.runner.status.number == 0


@pytest.mark.parametrize('action', [GoTo(4.0, 0.0, 0.0), FollowRoute(ROUTE)])
def test_without_a_pose_it_stands_at_once_and_goes_on_when_it_comes_back(action):
    drive = Drive(action)
    drive.run(2.0)
    drive.tick(seen=False)
    assert drive.twist == REST
    assert drive.runner.status.state is SequenceState.BLIND
    drive.run(2.0, seen=False)
    drive.tick()
    assert drive.twist.vx < 0.1
    assert drive.run() is SequenceState.DONE


@pytest.mark.parametrize('action', [GoTo(4.0, 0.0, 0.0), FollowRoute(ROUTE), Wait(9.0)])
def test_a_pose_that_never_comes_is_a_timeout(action):
    drive = Drive(action, timeout=5.0)
    assert drive.run(seen=False) is SequenceState.FAILED
    assert drive.time == pytest.approx(5.1, abs=0.2)


@pytest.mark.parametrize(
    ('pose', 'dt'), [(Pose(nan, 0.0, 0.0), 0.1), (Pose(0.0, 0.0, 0.0), -1.0), (None, nan)]
)
def test_a_bad_pose_or_time_is_refused_and_changes_nothing(pose, dt):
    drive = Drive(GoTo(1.0, 0.0, 0.0))
    drive.run(1.0)
    before = drive.runner.status
    with pytest.raises(SignalError, match='must be finite'):
        drive.runner.step(pose, dt)
    assert drive.runner.status == before


@pytest.mark.parametrize('action', [GoTo(2.0, 0.0, 0.0), FollowRoute(ROUTE), Rotate(by=170.0)])
def test_failed_from_outside_it_stands_at_once_and_a_retry_leaves_from_where_the_robot_is(action):
    """Held while the Ghost ran ahead; the second attempt begins without a jump of speed."""
    drive = Drive(action, on_failure=OnFailure(1))
    drive.run(1.0)
    drive.run(3.0, stuck=True)
    drive.runner.fail('blocked: held')
    assert drive.runner.status.attempt == 2
    assert drive.runner.status.reason == f'm.yaml:0:1: {type(action).__name__}: blocked: held'
    drive.tick()
    assert hypot(drive.twist.vx, drive.twist.vy) < 0.1
    assert abs(drive.twist.wz) < 0.3
    assert drive.run() is SequenceState.DONE
    drive.runner.fail('too late')
    assert drive.runner.status.state is SequenceState.DONE


def test_failed_from_outside_without_a_retry_it_ends():
    drive = Drive(GoTo(2.0, 0.0, 0.0), Wait(1.0))
    drive.run(2.0)
    drive.runner.fail('blocked: held')
    assert drive.runner.status.state is SequenceState.FAILED
    assert drive.runner.step(drive.pose, 0.05) == REST


@pytest.mark.parametrize(
    ('action', 'share'), [(GoTo(2.0, 1.0, 0.0), 0.5), (Rotate(by=90.0), 0.5),
                          (DriveArc(90.0, 1.0), 0.5), (GoTo(2.0, 1.0, 0.0), 1.2)]
)  # fmt: skip
def test_with_wheels_that_slip_each_action_ends_within_the_tolerances(action, share):
    drive = Drive(action)
    drive.share = share
    assert drive.run() is SequenceState.DONE
    end = {GoTo: (2.0, 1.0, 0.0), Rotate: (0.0, 0.0, 90.0), DriveArc: (0.65, 0.65, 90.0)}
    x, y, heading = end[type(action)]
    assert hypot(drive.pose.x - x, drive.pose.y - y) <= 0.03
    assert abs(wrap(drive.pose.theta - radians(heading))) <= 0.06


def test_an_action_that_does_not_come_to_its_end_has_failed_by_so_much():
    drive = Drive(GoTo(1.0, 0.0, 0.0))
    while drive.pose.x < 0.9:
        drive.tick()
    drive.pose = Pose(0.94, 0.0, 0.0)
    assert drive.run(stuck=True) is SequenceState.FAILED
    assert re.search(r'GoTo: 6\.\d cm short, .* tolerance 3 cm', drive.runner.status.reason)


def test_after_a_failure_that_is_skipped_the_next_action_leaves_from_where_the_robot_is():
    """Where the failed one was to end counts for no other, however near that is."""
    drive = Drive(GoTo(0.5, 0.0, 0.0), DriveArc(180.0, 2.0), timeout=2.0, on_failure=SKIP)
    while drive.runner.status.number == 0:
        drive.tick()
    assert 'not done within' in drive.runner.status.reason
    assert hypot(drive.pose.x - 0.5, drive.pose.y) < 0.01
    begun = drive.pose = drive.pose._replace(y=0.03)
    drive.tick()
    leader = drive.runner._follower.leader.pose  # noqa: SLF001 - before anything has moved
    assert hypot(leader.x - begun.x, leader.y - begun.y) < 0.001


@pytest.mark.parametrize(
    ('on_failure', 'state', 'end'),
    [(STOP, SequenceState.FAILED, 1.0), (OnFailure(retries=2), SequenceState.FAILED, 1.0),
     (SKIP, SequenceState.DONE, 2.0)],
)  # fmt: skip
def test_an_action_that_is_refused_on_the_way_has_failed(on_failure, state, end):
    """The Ghost of the action before has arrived: that must not count for the one refused."""
    drive = Drive(
        GoTo(1.0, 0.0, 0.0), GoTo(5000.0, 0.0, 0.0), GoTo(2.0, 0.0, 0.0), on_failure=on_failure
    )
    assert drive.run() is state
    assert drive.pose.x == pytest.approx(end, abs=0.03)
    assert 'm.yaml:1:1: GoTo: a way of' in drive.runner.status.reason
    assert drive.time < 30.0  # at once, not by its time-out


def test_a_wait_forgets_neither_where_the_robot_was_to_be_nor_how_often_it_may_fail():
    drive = Drive(GoTo(0.5, 0.0, 0.0), Wait(0.1), DriveArc(180.0, 2.0), on_failure=OnFailure(1))
    attempts = set()
    while drive.runner.status.number < 2:
        drive.tick()
        attempts.add(drive.runner.status.attempt)
    drive.pose = drive.pose._replace(y=0.03)
    drive.tick()
    leader = drive.runner._follower.leader.pose  # noqa: SLF001 - before anything has moved
    assert (leader.x, leader.y) == pytest.approx((0.5, 0.0), abs=1e-3)
    assert attempts == {1}
