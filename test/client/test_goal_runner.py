"""Goals of actions: one at a time, each with an end; a robot without a goal stands."""

from __future__ import annotations

import threading

import pytest

pytest.importorskip('rclpy')

from agv_motion.client.goal_runner import (
    CLOSED,
    REPLACED,
    ControllerError,
    Ending,
    GoalEnd,
    GoalError,
    GoalRunner,
)
from agv_motion.client.task import Fault, Feedback, Outcome, Result
from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.planar import Pose, Twist

RUNNING = Result(Outcome.RUNNING, 'under way')
ARRIVED = Result(Outcome.SUCCEEDED, 'arrived')
UNHEARD = SourceError('no answer')


class Robot:
    """Drives 0.5 m/s along x, turning 1 rad/s, by a clock that goes on while it is waited for."""

    def __init__(self):
        self.now, self.x, self.turn, self.fault = 100.0, 0.0, 0.0, Fault.NONE
        self.orders, self.calls, self.state = [], [], ARRIVED
        self.during = {}
        """what happens, by the number of the wait"""
        self.waits = 0
        self.deaf = False

    def clock(self):
        return self.now

    def drive(self, target):
        self.orders.append(target)
        self.state = RUNNING
        self.target = target

    def is_done(self):
        return self.state is not RUNNING

    def result(self):
        return self.state

    def wait(self, seconds):
        self.waits += 1
        self.during.get(self.waits, lambda: None)()
        self.now += seconds
        if self.state is RUNNING:
            self.x += 0.5 * seconds
            self.turn += seconds
            if self.x >= self.target:
                self.state = ARRIVED
        return self.state

    def cancel(self, _):
        self.calls.append('cancel')
        if self.deaf:
            raise UNHEARD
        self.state = Result(Outcome.CANCELLED, 'aborted')
        return self.state

    def stop(self):
        self.calls.append('stop')
        self.fail(Fault.STOPPED, 'STOP')

    def fail(self, fault, reason):
        self.fault, self.state = fault, Result(Outcome.FAILED, reason)

    def pose(self, frame=''):
        wrapped = (self.turn + 3.14159265) % 6.2831853 - 3.14159265
        return Pose(self.x, 0.0, wrapped) if frame in {'', 'map'} else None

    def twist(self):
        return Twist(0.3, -0.4, 1.0)

    def feedback(self):
        return Feedback('driving', self.target - self.x, '')


class Goal:
    """Of a client that may cancel it."""

    def __init__(self, target=1.0, frame='map', allowance=0.0, error=None):
        self.target, self.frame, self.allowance, self.error = target, frame, allowance, error
        self.cancelled, self.told = False, []

    def order(self, robot):
        if self.error:
            raise self.error
        robot.drive(self.target)

    def is_cancel_requested(self):
        return self.cancelled

    def tell(self, progress):
        self.told.append(progress)


@pytest.fixture
def robot():
    return Robot()


@pytest.fixture
def runner(robot):
    return GoalRunner(lambda: robot, robot.clock)


def run(runner, goal):
    """Carry out a goal that comes now."""
    return runner.run(goal, runner.admit())


def test_a_goal_is_ordered_watched_and_told(robot, runner):
    goal = Goal(5.0)
    end = run(runner, goal)
    assert end[:3] == (Ending.SUCCEEDED, GoalError.NONE, 'arrived')
    assert end.seconds == pytest.approx(10.0, abs=0.11)
    assert robot.orders == [5.0]
    assert robot.calls == []
    last = goal.told[-1]
    assert last.distance == pytest.approx(0.5 * last.seconds)
    assert last.distance_left == pytest.approx(5.0 - last.distance)
    assert last.turned == pytest.approx(last.seconds, abs=1e-5)  # more than a turn: counted on
    assert last.speed == pytest.approx(0.5)
    assert last.pose.x == pytest.approx(last.distance)


@pytest.mark.parametrize(
    ('goal', 'error', 'words'),
    [
        (Goal(frame='moon'), GoalError.FRAME, "in that frame: 'moon'"),
        (Goal(error=ConfigurationError('too far')), GoalError.REFUSED, 'too far'),
        (Goal(error=ControllerError('no MPPI')), GoalError.CONTROLLER, 'no MPPI'),
        (Goal(9.0, allowance=2.0), GoalError.TIMEOUT, 'not there after the 2 s that it may take'),
    ],
)
def test_what_is_no_goal_is_aborted_with_its_error(runner, goal, error, words):
    end = run(runner, goal)
    assert end[:2] == (Ending.ABORTED, error)
    assert words in end.reason


def test_a_goal_whose_time_is_over_leaves_no_robot_that_drives(robot, runner):
    assert run(runner, Goal(9.0, allowance=2.0)).seconds == pytest.approx(2.1)
    assert robot.calls == ['cancel']


@pytest.mark.parametrize(
    ('fault', 'error'),
    [
        (Fault.STANDS, GoalError.NO_PROGRESS), (Fault.STOPPED, GoalError.UNKNOWN),
        (Fault.SILENT, GoalError.UNKNOWN), (Fault.NODE, GoalError.UNKNOWN),
    ],
)  # fmt: skip
def test_what_fails_on_its_way_is_told(robot, runner, fault, error):
    robot.during[3] = lambda: robot.fail(fault, 'because')
    assert run(runner, Goal())[:3] == (Ending.ABORTED, error, 'because')


def test_cancelled_it_brakes(robot, runner):
    goal = Goal()
    robot.during[2] = lambda: setattr(goal, 'cancelled', True)
    assert run(runner, goal)[:3] == (Ending.CANCELED, GoalError.NONE, 'aborted')
    assert robot.calls == ['cancel']


def test_where_it_cannot_be_cancelled_there_is_a_stop(robot, runner):
    goal = Goal()
    robot.deaf = goal.cancelled = True
    end = run(runner, goal)
    assert end.ending is Ending.CANCELED
    assert 'STOP, since it could not be cancelled: no answer' in end.reason
    assert robot.calls == ['cancel', 'stop']


def test_one_that_arrives_while_it_is_cancelled_has_succeeded(robot, runner, monkeypatch):
    goal = Goal()
    goal.cancelled = True
    monkeypatch.setattr(robot, 'cancel', lambda _: setattr(robot, 'state', ARRIVED))
    assert run(runner, goal).ending is Ending.SUCCEEDED


def beside(robot, runner, second):
    """Run a goal; give another in the midst of it; return how both end."""
    ends, threads = {}, []

    def give():
        ticket = runner.admit()
        thread = threading.Thread(target=lambda: ends.update(second=runner.run(second, ticket)))
        threads.append(thread)
        thread.start()

    robot.during[3] = give
    ends['first'] = run(runner, Goal(9.0))
    threads[0].join(60.0)
    return ends['first'], ends['second']


def test_of_goals_that_are_begun_in_another_order_than_they_came_the_newest_is_carried_out(
    robot, runner
):
    old, new = runner.admit(), runner.admit()
    assert runner.run(Goal(1.0), new).ending is Ending.SUCCEEDED
    assert runner.run(Goal(9.0), old)[:3] == (Ending.ABORTED, GoalError.UNKNOWN, REPLACED)
    assert robot.orders == [1.0]


def test_a_new_goal_takes_the_place_of_the_last_without_a_stop(robot, runner):
    first, second = beside(robot, runner, Goal(1.0))
    assert first[:3] == (Ending.ABORTED, GoalError.UNKNOWN, REPLACED)
    assert second.ending is Ending.SUCCEEDED
    assert robot.orders == [9.0, 1.0]
    assert robot.calls == []


def test_a_new_goal_that_is_refused_leaves_no_robot_that_drives_to_the_last(robot, runner):
    refused = Goal(error=ConfigurationError('nan'))
    first, second = beside(robot, runner, refused)
    assert (first.reason, second.reason) == (REPLACED, 'nan')
    assert robot.calls == ['cancel']
    assert robot.is_done()


def test_closed_the_goal_under_way_is_taken_back_and_no_other_is_begun(robot, runner):
    robot.during[2] = runner.end
    assert run(runner, Goal())[:3] == (Ending.ABORTED, GoalError.UNKNOWN, CLOSED)
    assert robot.calls == ['cancel']
    runner.close()
    assert run(runner, Goal()) == GoalEnd(Ending.ABORTED, GoalError.UNKNOWN, CLOSED)


def test_no_robot_is_an_aborted_goal_and_looked_for_again(robot):
    found = [SourceError('no robot'), robot]

    def find():
        one = found.pop(0)
        if isinstance(one, Exception):
            raise one
        return one

    runner = GoalRunner(find, robot.clock)
    assert run(runner, Goal())[:3] == (Ending.ABORTED, GoalError.UNKNOWN, 'no robot')
    assert run(runner, Goal()).ending is Ending.SUCCEEDED
