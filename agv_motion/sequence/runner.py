"""A sequence while it runs: one twist a cycle; time-outs, failures, pause and abort."""

from __future__ import annotations

from enum import Enum
from math import hypot
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import SignalError
from agv_motion.planar import REST, Pose, Twist, require_finite
from agv_motion.sequence.action_run import (
    ActionRun,
    GhostRun,
    RouteRun,
    WaitRun,
)
from agv_motion.sequence.actions import FollowRoute, Wait
from agv_motion.trajectory.follower import Follower

if TYPE_CHECKING:
    from agv_motion.route.parameters import FollowParameters
    from agv_motion.sequence.sequence import Sequence, SequenceStep
    from agv_motion.trajectory.follower_parameters import FollowerParameters


class SequenceState(Enum):
    """What a sequence is doing."""

    READY = 'ready'
    RUNNING = 'running'
    PAUSED = 'paused'
    """At rest, or easing to it"""
    STOPPING = 'stopping'
    """Braking, after a time-out or an abort"""
    BLIND = 'stopped'
    """Standing until the pose is back, or for a while as it is blocked; the time-out counts on"""
    DONE = 'done'
    FAILED = 'failed'
    ABORTED = 'aborted'


ENDS = frozenset({SequenceState.DONE, SequenceState.FAILED, SequenceState.ABORTED})


class Status(NamedTuple):
    """How far it is."""

    state: SequenceState
    number: int
    """of the present action, from 0"""
    attempt: int
    """from 1"""
    elapsed: float
    """[s] of the present attempt, pauses not counted"""
    progress: float
    """share of the present action that is behind"""
    reason: str
    """why the last action that failed did; empty if none has"""


class SequenceRunner:
    """Runs one sequence once.

    Each action starts where the one before it was to end, not where the robot came to stand within
    its tolerance: so small errors do not add up, and turns and arcs end exactly where they should.
    """

    def __init__(
        self, sequence: Sequence, follower: FollowerParameters, follow: FollowParameters
    ) -> None:
        """Be ready to start.

        Args:
            sequence: What to do.
            follower: How the robot follows a Ghost.
            follow: How it follows a route.

        Raises:
            ConfigurationError: A lap of a route fits into the circle of its virtual point.

        """
        self.sequence = sequence
        self._follow = follow
        self._follower = Follower(follower)
        self._state = SequenceState.READY
        self._number = 0
        self._attempt = 1
        self._elapsed = 0.0
        self._reason = ''
        self._held = False
        self._after_stop = ''
        self._aborted = False
        self._nominal: Pose | None = None
        self._waiting = True
        self._runs = [self._run_of(step) for step in sequence.steps]

    @property
    def status(self) -> Status:
        """How far it is."""
        return Status(
            self._state, self._number, self._attempt, self._elapsed,
            self._run.progress, self._reason,
        )  # fmt: skip

    @property
    def present(self) -> SequenceStep:
        """The present action; at the end, the last one."""
        return self.sequence.steps[self._number]

    @property
    def _run(self) -> ActionRun:
        return self._runs[self._number]

    @property
    def ended(self) -> bool:
        """Whether it is over."""
        return self._state in ENDS

    def pause(self) -> None:
        """Ease to a halt and stay there."""
        self._held = True
        self._set_held()

    def resume(self) -> None:
        """Go on after a pause."""
        self._held = False
        self._set_held()

    def _set_held(self) -> None:
        """Let the present action know whether to halt or to go on."""
        if self._held:
            self._run.ease_to_halt()
        else:
            self._run.go_on()

    def abort(self) -> None:
        """Brake, and end it."""
        if not self.ended:
            self._aborted = True
            self._stop('aborted')

    def fail(self, reason: str) -> None:
        """Stand at once, and take the present action for failed: again, skip or end, as it says."""
        if self.ended:
            return
        self._run.go_on()
        self._run.brake_and_end()
        self._run.freeze()
        if self._state is SequenceState.STOPPING:
            self._after(self._after_stop)
        else:
            self._fail(reason)

    def step(self, pose: Pose | None, dt: float) -> Twist:
        """Return what to drive until the next cycle.

        Args:
            pose: Where the robot is; None while nobody knows, or it must not move: it stands.
            dt: Since the last cycle [s].

        Raises:
            SignalError: A number is not finite, or ``dt`` is negative; nothing has changed.

        """
        if pose is not None:
            require_finite('pose', pose)
        if not 0.0 <= dt < float('inf'):
            msg = f'dt = {dt} s: must be finite and not negative'
            raise SignalError(msg)
        if self.ended:
            return REST
        if not self._held:
            self._elapsed += dt
        twist = self._stand() if pose is None else self._move(pose, dt)
        self._judge()
        return twist

    def _stand(self) -> Twist:
        """Stand, because the pose is lost."""
        self._run.freeze()
        if self._state is not SequenceState.STOPPING:
            self._state = SequenceState.BLIND
        return REST

    def _move(self, pose: Pose, dt: float) -> Twist:
        if self._waiting:
            self._waiting = False
            self._run.begin(self._departure(pose))
        twist = self._run.step(pose, dt)
        if self._state is not SequenceState.STOPPING:
            self._state = SequenceState.PAUSED if self._held else SequenceState.RUNNING
        return twist

    def _judge(self) -> None:
        """Find out whether the present action is over, well or badly."""
        run = self._run
        if self._state is SequenceState.STOPPING:
            if run.at_rest or self._waiting:
                self._after(self._after_stop)
        elif run.failure:
            self._fail(run.failure)
        elif run.done and not self._waiting:
            self._next()
        elif self._elapsed > self.present.timeout:
            self._stop(f'not done within {self.present.timeout:g} s')

    def _stop(self, reason: str) -> None:
        """Brake first, then `_after`."""
        self._state, self._after_stop = SequenceState.STOPPING, reason
        self._run.go_on()
        self._run.brake_and_end()

    def _after(self, reason: str) -> None:
        if self._aborted:
            self._state = SequenceState.ABORTED
            self._reason = reason
        else:
            self._fail(reason)

    def _fail(self, reason: str) -> None:
        """Try again, skip, or end, as the action says."""
        step = self.present
        self._reason = f'{step.where}: {step.name}: {reason}'
        if self._attempt <= step.on_failure.retries:
            self._attempt += 1
            self._nominal = None
            self._begin()
        elif step.on_failure.skip:
            self._next(failed=True)
        else:
            self._state = SequenceState.FAILED

    def _next(self, *, failed: bool = False) -> None:
        run = self._run
        self._nominal = self._nominal if isinstance(run, WaitRun) else None
        if isinstance(run, GhostRun) and not failed:
            self._nominal = run.end
        if self._number + 1 == len(self.sequence.steps):
            self._state = SequenceState.DONE
            return
        self._number += 1
        self._attempt = 1
        self._begin()

    def _begin(self) -> None:
        """Let the present action start from the next pose."""
        self._set_held()
        self._elapsed, self._waiting = 0.0, True
        self._state = SequenceState.RUNNING

    def _departure(self, pose: Pose) -> Pose:
        """Return where the last action was to end, if the robot is near it, or ``pose``."""
        nominal = self._nominal
        if nominal is None:
            return pose
        near = self._follower.parameters.pace.slow_beyond
        return nominal if hypot(nominal.x - pose.x, nominal.y - pose.y) < near else pose

    def _run_of(self, step: SequenceStep) -> ActionRun:
        action = step.action
        if isinstance(action, Wait):
            return WaitRun(action.seconds)
        if isinstance(action, FollowRoute):
            return RouteRun(action.route, self._follow)
        return GhostRun(action, self._follower)
