"""A robot behind its Ghost: one twist a cycle, from the measured pose.

The Ghost runs along its trajectory, a law of control keeps the robot on it, and the leash between
them makes the Ghost wait for a robot that falls back, and stop one that is lost.
"""

from __future__ import annotations

from enum import Enum
from math import hypot
from typing import TYPE_CHECKING

from agv_motion.planar import REST, Pose, Twist, require_finite
from agv_motion.trajectory.follower_parameters import FollowerParameters
from agv_motion.trajectory.ghost import Ghost
from agv_motion.trajectory.leash import Leash
from agv_motion.trajectory.motions import Speeds
from agv_motion.trajectory.tracking import TrackingError, tracking_error

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.trajectory.trajectory import Trajectory


class Following(Enum):
    """What the robot and its Ghost are doing."""

    IDLE = 'idle'
    LOCKED = 'locked'
    DRIVING = 'driving'
    WAITING = 'waiting'
    """The Ghost waits for the robot"""
    SETTLING = 'settling'
    """The Ghost has arrived, the robot closes the last centimetres"""
    ARRIVED = 'arrived'
    ABORTED = 'aborted'
    LOST = 'lost'


AT_REST = frozenset({Following.IDLE, Following.ARRIVED, Following.ABORTED, Following.LOST})
"""In these states nothing moves until there is a new trajectory."""


class Follower:
    """Ghost, law and leash of one robot."""

    def __init__(self, parameters: FollowerParameters | None = None) -> None:
        """Wait for a trajectory."""
        self.parameters = parameters or FollowerParameters()
        self.ghost = Ghost(Pose(0.0, 0.0, 0.0), self.parameters.ghost)
        self.state = Following.IDLE
        self.error = TrackingError(0.0, 0.0, 0.0)
        """As of the last step"""
        self.separation = 0.0
        """[m] as of the last step, heading included"""
        self.held = False
        """Whether the Ghost is to stand still"""
        self._law = self.parameters.make_law()
        self._leash = Leash(self.parameters.leash)
        self._aborting = False
        self._settling = 0.0

    @property
    def at_rest(self) -> bool:
        """Whether nothing moves until there is a new trajectory."""
        return self.state in AT_REST

    def depart(self, pose: Pose, plan: Callable[[Ghost], Trajectory]) -> Trajectory:
        """Set out on what ``plan`` makes the Ghost compute.

        A robot at rest leaves from ``pose``, where it is; in motion it goes over into the new
        trajectory without a jump of speed. If the plan is refused nothing changes.

        Args:
            pose: Where the robot is.
            plan: Calls one of the ``compute_...`` methods of the Ghost, and returns what it does.

        Raises:
            AgvMotionError: What ``plan`` raises.
            SignalError: ``pose`` is not finite.

        """
        require_finite('pose', pose)
        if self.at_rest:
            fresh = Ghost(pose, self.parameters.ghost)
            trajectory = plan(fresh)
            self.ghost = fresh
            self._leash.restart(moving=not self.held)
            fresh.lock(self.held)
        else:
            trajectory = plan(self.ghost)
        self.state = Following.LOCKED if self.held else Following.DRIVING
        self._aborting, self._settling = False, 0.0
        return trajectory

    def hold(self, state: bool) -> None:  # noqa: FBT001 - the name says what the flag is
        """Ease the Ghost to a halt where it is, or let it go on; a new one starts held too."""
        self.held = state

    def abort(self) -> None:
        """Brake to rest on the way; when that is done the state is `ABORTED`."""
        if self.at_rest:
            return
        self.held, self._aborting = False, True
        if self._leash.pace == 1.0:
            self.ghost.abort()  # at full pace, with the ramps of the trajectory

    def halt(self) -> None:
        """Stand at once and without a ramp, for as long as the pose is lost; `step` goes on."""
        self._leash.restart(moving=False)
        self.ghost.lock(True)  # noqa: FBT003 - the name says what the flag is
        if self._aborting:
            self._end(Following.ABORTED)

    def retune(self, parameters: FollowerParameters) -> None:
        """Go on with other gains and another leash; limits count from the next trajectory on."""
        self.parameters = parameters
        self._law = parameters.make_law()
        self._leash.parameters = parameters.leash

    def stop(self) -> None:
        """End it at once and without a ramp."""
        if not self.at_rest:
            self._end(Following.ABORTED)

    def step(self, dt: float, pose: Pose) -> Twist:
        """Return the twist for the next cycle.

        Args:
            dt: Time since the last step [s].
            pose: Where the robot is now.

        Raises:
            SignalError: A number is not finite, or ``dt`` is negative; nothing has changed.

        """
        require_finite('pose', pose)
        ghost = self.ghost
        if self.at_rest:
            return REST
        ghost.advance(dt, self._leash.pace)
        place, linear, angular = ghost.controller_kinetics(self.parameters.delay)
        self.error = tracking_error(place, pose)
        self.separation = self._leash.separation(self.error)
        if self._leash.is_lost(self.separation):
            return self._end(Following.LOST)
        self._pace(dt)
        if self.state is Following.LOCKED:
            return REST  # the robot stands, as near as it came
        twist = self._law.twist(self.error, Speeds(linear, angular))
        if ghost.finished:
            self._settling += dt
            if ghost.aborted:
                return self._end(Following.ABORTED)
            if self._is_settled(twist):
                return self._end(Following.ARRIVED)
        return twist

    def _pace(self, dt: float) -> None:
        """Let the Ghost go on, dawdle or wait, and say so."""
        ghost, leash = self.ghost, self._leash
        if not ghost.aborted:  # its braking must not be stretched
            leash.ease(self.separation, dt, hold=self.held or self._aborting)
        ghost.lock(leash.pace == 0.0)
        if self._aborting and ghost.locked:
            ghost.abort()
        if ghost.finished:
            self.state = Following.SETTLING
        elif ghost.locked:
            self.state = Following.LOCKED if self.held else Following.WAITING
        else:
            self.state = Following.DRIVING

    def _is_settled(self, twist: Twist) -> bool:
        given = self.parameters
        calm = (
            hypot(twist.vx, twist.vy) <= given.settle_speed and abs(twist.wz) <= given.settle_turn
        )
        return calm or self._settling > given.settle_time

    def _end(self, state: Following) -> Twist:
        self.ghost.lock(True)  # noqa: FBT003 - the name says what the flag is
        self.state = state
        return REST
