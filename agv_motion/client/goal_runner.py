"""Goals of actions, one at a time: an order to the robot, watched to its end, with its error.

Nothing here knows of ROS actions: who serves them hands in what a goal asks, and is told the end.
"""

from __future__ import annotations

import threading
import time
from contextlib import suppress
from enum import Enum
from math import dist, hypot
from typing import TYPE_CHECKING, NamedTuple, Protocol

from agv_motion.client.task import Fault, Outcome
from agv_motion.errors import AgvMotionError
from agv_motion.planar import wrap

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.client.task import Feedback, Result
    from agv_motion.planar import Pose, Twist

PERIOD = 0.1
"""[s] between two looks at how a goal goes, and two messages of feedback"""
BRAKING = 10.0
"""[s] that a robot may take to come to rest when its goal is cancelled"""
REPLACED = 'another goal took its place'
CLOSED = 'the node that serves goals was deactivated'


class Ending(Enum):
    """How a goal ends, as actions call it."""

    SUCCEEDED = 'succeeded'
    CANCELED = 'canceled'
    ABORTED = 'aborted'


class GoalError(Enum):
    """Why a goal was aborted; each action has a number of its own for it."""

    NONE = 'none'
    UNKNOWN = 'unknown'
    TIMEOUT = 'its time is over'
    FRAME = 'nobody tells where the robot is in that frame'
    REFUSED = 'the robot does not take it'
    CONTROLLER = 'there is no such controller'
    NO_PROGRESS = 'the robot stands'


class GoalEnd(NamedTuple):
    """How a goal ended."""

    ending: Ending
    error: GoalError
    reason: str
    seconds: float = 0.0
    """that it took, by the steady clock"""


class GoalProgress(NamedTuple):
    """How a goal goes."""

    seconds: float
    """since it was begun"""
    pose: Pose | None
    """where the robot is, in the frame of the goal; None as long as nobody tells"""
    distance_left: float
    """[m] along its path; NaN as long as nobody knows"""
    speed: float
    """[m/s], without sign"""
    distance: float
    """[m] from where it was begun, by the wheels"""
    turned: float
    """[rad] since then, left positive, of any size"""


class Mover(Protocol):
    """What a goal is carried out with: see `Robot`."""

    fault: Fault

    def is_done(self) -> bool: ...  # noqa: D102 - as of Robot, all of them
    def result(self) -> Result: ...  # noqa: D102
    def feedback(self) -> Feedback: ...  # noqa: D102
    def wait(self, seconds: float) -> Result: ...  # noqa: D102
    def cancel(self, seconds: float) -> Result: ...  # noqa: D102
    def stop(self) -> None: ...  # noqa: D102
    def pose(self, frame: str = '') -> Pose | None: ...  # noqa: D102
    def twist(self) -> Twist | None: ...  # noqa: D102


class ActionGoal(Protocol):
    """What somebody asks for by an action."""

    frame: str
    """in which it is told; empty: in that of the nodes that drive"""
    allowance: float
    """[s] that it may take; 0: any time"""

    def order(self, robot: Mover) -> None:
        """Give the order; raise an `AgvMotionError` where it is none."""

    def is_cancel_requested(self) -> bool:
        """Return whether its client wants it no more."""

    def tell(self, progress: GoalProgress) -> None:
        """Tell its client how it goes."""


class ControllerError(AgvMotionError):
    """A goal names a controller that is not there."""


class GoalRunner:
    """Carries out the newest goal; the one before is aborted, without a stop between them.

    `run` is called by a thread for each goal. A goal that is refused leaves no robot behind that
    drives to the one before: nobody would watch it.
    """

    def __init__(
        self, find: Callable[[], Mover], clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Wait for goals.

        Args:
            find: Returns the robot, or raises an `AgvMotionError`; called with the first goal.
            clock: A steady one [s].

        """
        self._find, self._clock = find, clock
        self._robot: Mover | None = None
        self._turn = threading.Lock()
        self._newest: object = None
        """ticket of the goal that came last"""
        self._closed = False

    def admit(self) -> object:
        """Return the ticket of a goal that comes now: those before it give way to it."""
        self._newest = ticket = object()
        return ticket

    def run(self, goal: ActionGoal, ticket: object) -> GoalEnd:
        """Carry out the goal with this ticket, or tell why not; returns when it is over."""
        while not self._turn.acquire(timeout=PERIOD):
            if self._newest is not ticket:
                return _aborted(REPLACED)
        try:
            if self._closed or self._newest is not ticket:
                return _aborted(CLOSED if self._closed else REPLACED)
            began = self._clock()
            end = self._begin(goal) or self._watch(goal, ticket, began)
            return end._replace(seconds=self._clock() - began)
        finally:
            self._turn.release()

    def end(self) -> None:
        """Let the goal that is under way be taken back, and begin no other."""
        self._closed = True

    def close(self) -> None:
        """Do the same, and wait until the robot stands."""
        self.end()
        with self._turn:
            pass

    def _begin(self, goal: ActionGoal) -> GoalEnd | None:
        """Send the robot; return how the goal ended where that did not work."""
        try:
            if self._robot is None:
                self._robot = self._find()
        except AgvMotionError as error:
            return _aborted(str(error))
        robot = self._robot
        try:
            if goal.frame and robot.pose(goal.frame) is None:
                what, reason = GoalError.FRAME, f"{GoalError.FRAME.value}: '{goal.frame}'"
            else:
                goal.order(robot)
                return None
        except ControllerError as error:
            what, reason = GoalError.CONTROLLER, str(error)
        except AgvMotionError as error:
            what, reason = GoalError.REFUSED, str(error)
        self._leave(robot)
        return GoalEnd(Ending.ABORTED, what, reason)

    def _watch(self, goal: ActionGoal, ticket: object, began: float) -> GoalEnd:
        robot = self._robot
        assert robot is not None
        way = _Odometer(robot)
        while not robot.is_done():
            seconds = self._clock() - began
            if self._closed:
                self._leave(robot)
                return _aborted(CLOSED)
            if goal.is_cancel_requested():
                return self._cancelled(robot)
            if self._newest is not ticket:
                return _aborted(REPLACED)
            if 0.0 < goal.allowance < seconds:
                self._leave(robot)
                reason = f'not there after the {goal.allowance:g} s that it may take'
                return GoalEnd(Ending.ABORTED, GoalError.TIMEOUT, reason)
            goal.tell(way.progress(seconds, goal.frame))
            robot.wait(PERIOD)
        return _ended(robot)

    def _cancelled(self, robot: Mover) -> GoalEnd:
        left = self._leave(robot)
        end = _ended(robot)
        if end.ending is Ending.SUCCEEDED:  # it was there before
            return end
        return GoalEnd(Ending.CANCELED, GoalError.NONE, left or end.reason)

    def _leave(self, robot: Mover) -> str:
        """Brake to rest, by STOP where nothing else is heard; return what was done in that case."""
        if robot.is_done():
            return ''
        try:
            robot.cancel(BRAKING)
        except AgvMotionError as error:
            with suppress(AgvMotionError):
                robot.stop()
            return f'STOP, since it could not be cancelled: {error}'
        return ''


class _Odometer:
    """What a robot has gone since a goal was begun."""

    def __init__(self, robot: Mover) -> None:
        self._robot = robot
        self._start = self._last = robot.pose()
        self._turned = 0.0

    def progress(self, seconds: float, frame: str) -> GoalProgress:
        """Return how far it is by now."""
        pose, twist, distance = self._robot.pose(), self._robot.twist(), 0.0
        if pose is not None and self._last is not None and self._start is not None:
            self._turned += wrap(pose.theta - self._last.theta)
            distance = dist(pose[:2], self._start[:2])
        self._start, self._last = self._start or pose, pose or self._last
        return GoalProgress(
            seconds, self._robot.pose(frame) if frame else pose,
            self._robot.feedback().distance_left,
            0.0 if twist is None else hypot(twist.vx, twist.vy), distance, self._turned,
        )  # fmt: skip


def _aborted(reason: str) -> GoalEnd:
    return GoalEnd(Ending.ABORTED, GoalError.UNKNOWN, reason)


def _ended(robot: Mover) -> GoalEnd:
    """Return how an order that is over ended the goal that it was for."""
    result = robot.result()
    if result.outcome is Outcome.SUCCEEDED:
        return GoalEnd(Ending.SUCCEEDED, GoalError.NONE, result.reason)
    error = GoalError.NO_PROGRESS if robot.fault is Fault.STANDS else GoalError.UNKNOWN
    return GoalEnd(Ending.ABORTED, error, result.reason)
