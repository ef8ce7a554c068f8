"""Actions while they run: one cycle after another, from the pose to the twist."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from agv_motion.errors import AgvMotionError
from agv_motion.planar import REST, Pose, Twist
from agv_motion.route.follower import RouteFollower
from agv_motion.trajectory.follower_state import FollowerState

if TYPE_CHECKING:
    from agv_motion.route.parameters import FollowParameters
    from agv_motion.route.route import Route
    from agv_motion.sequence.actions import GhostAction
    from agv_motion.trajectory.follower import Follower

EASE = 0.5
"""[s] In which a robot on a route comes from full speed to a pause."""


class ActionRun(Protocol):
    """One action on its way."""

    @property
    def done(self) -> bool:
        """Whether it has come to its end."""

    @property
    def failure(self) -> str:
        """Why it failed; empty if it has not."""

    @property
    def at_rest(self) -> bool:
        """Whether the robot stands."""

    @property
    def progress(self) -> float:
        """Share of the action that is behind, in [0, 1]."""

    def begin(self, pose: Pose) -> None:
        """Start, or try again, from ``pose``."""

    def step(self, pose: Pose, dt: float) -> Twist:
        """Return the twist for the next cycle."""

    def ease_to_halt(self) -> None:
        """Ease to a halt, until :meth:`go_on`."""

    def go_on(self) -> None:
        """Go on after a halt."""

    def brake_and_end(self) -> None:
        """Brake; at rest after some steps."""

    def freeze(self) -> None:
        """Stand at once, as long as the pose is lost; `step` goes on."""


class GhostRun:
    """Go to, rotate, arc: the robot follows a Ghost."""

    def __init__(self, action: GhostAction, follower: Follower) -> None:
        """Run ``action`` with ``follower``, which serves one action after another."""
        self._action = action
        self._follower = follower
        self.failure = ''
        self.end: Pose | None = None
        """Where it is to end; known once it has begun"""

    @property
    def done(self) -> bool:
        """Whether the robot has come to its end."""
        return self._follower.state is FollowerState.ARRIVED and not self.failure

    @property
    def at_rest(self) -> bool:
        """Whether the robot stands."""
        return self._follower.at_rest

    @property
    def progress(self) -> float:
        """Share of the Ghost's time that has passed."""
        ghost = self._follower.ghost
        if self.end is None:
            return 0.0
        return 1.0 if ghost.finished else ghost.time / ghost.trajectory.duration

    def begin(self, pose: Pose) -> None:
        """Send the Ghost out; again, to the same end."""
        action, end = self._action, self.end
        self.failure = ''
        try:
            if end is None:
                self.end = self._follower.depart(pose, action.plan).end
            else:
                self._follower.depart(pose, lambda ghost: action.plan_again(ghost, end))
        except AgvMotionError as error:
            self.failure = str(error)

    def step(self, pose: Pose, dt: float) -> Twist:
        """Follow the Ghost; where it was refused to set out, nothing is behind which to drive."""
        if self.failure:
            return REST
        twist = self._follower.step(pose, dt)
        self.failure = self._follower.failure
        return twist

    def ease_to_halt(self) -> None:
        """Ease the Ghost to a halt."""
        self._follower.ease_to_halt()

    def go_on(self) -> None:
        """Let the Ghost go on."""
        self._follower.go_on()

    def brake_and_end(self) -> None:
        """Brake with the ramps of the trajectory."""
        self._follower.brake_and_end()

    def freeze(self) -> None:
        """Stand at once."""
        self._follower.freeze()


class RouteRun:
    """Follow route; tried again, it goes on from where the virtual point waits."""

    failure = ''

    def __init__(self, route: Route, parameters: FollowParameters) -> None:
        """Stand before the start of ``route``."""
        self._follower = RouteFollower(route, parameters)
        self._length = route.length
        self._pace = self._wanted = 1.0
        self._to_go = route.length
        self._aborting = False
        self.done = False

    @property
    def at_rest(self) -> bool:
        """Whether the robot stands."""
        return self.done or self._pace == 0.0

    @property
    def progress(self) -> float:
        """Share of the route that is behind; of one without end, 0."""
        share = 1.0 - self._to_go / self._length if self._to_go < self._length else 0.0
        return 1.0 if self.done else max(share, 0.0)

    def begin(self, _: Pose) -> None:
        """Go on from rest."""
        self._follower.rest()
        self._aborting = False
        self._pace = self._wanted

    def step(self, pose: Pose, dt: float) -> Twist:
        """Follow the virtual point, slower while it eases to a halt."""
        wanted = 0.0 if self._aborting else self._wanted
        self._pace += min(max(wanted - self._pace, -dt / EASE), dt / EASE)
        if self._pace == 0.0:
            self._follower.rest()
            return REST
        found = self._follower.step(pose, dt)
        self._to_go = found.limits.to_go
        self.done = found.arrived
        return Twist(*(self._pace * part for part in found.twist))

    def ease_to_halt(self) -> None:
        """Ease to a halt."""
        self._wanted = 0.0

    def go_on(self) -> None:
        """Go on from there."""
        self._wanted = 1.0

    def brake_and_end(self) -> None:
        """Ease to a halt for good."""
        self._aborting = True

    def freeze(self) -> None:
        """Stand at once."""
        self._follower.rest()
        self._pace = 0.0


class WaitRun:
    """Stand still for a while."""

    at_rest = True
    failure = ''

    def __init__(self, seconds: float) -> None:
        """Wait for ``seconds``."""
        self._seconds = seconds
        self._waited = 0.0
        self._held = False

    @property
    def done(self) -> bool:
        """Whether it is over."""
        return self._waited >= self._seconds

    @property
    def progress(self) -> float:
        """Share of it that is over."""
        return 1.0 if self.done else self._waited / self._seconds

    def begin(self, _: Pose) -> None:
        """Begin; again, go on."""

    def step(self, _: Pose, dt: float) -> Twist:
        """Let time pass."""
        self._waited += 0.0 if self._held else dt
        return REST

    def ease_to_halt(self) -> None:
        """Let no time pass."""
        self._held = True

    def go_on(self) -> None:
        """Let time pass again."""
        self._held = False

    def brake_and_end(self) -> None:
        """Nothing moves."""

    def freeze(self) -> None:
        """Nothing moves."""
