"""A robot behind its Ghost: one twist a cycle, from the measured pose.

The Ghost runs along its trajectory, a law of control keeps the robot on it, and the pace of the
Ghost is controlled: it waits for a robot that falls back; one that is lost is stopped. Whatever the
law asks for, the twist keeps the limits of the robot.

Arrival is measured: by the pose, not by the Ghost. A law of two wheels closes no error across at
rest, and wheels may be slow or slip; where the law brings the robot no nearer, a second Ghost leads
it from where it is to where the first one stands, by turns on the spot and a straight line.
"""

from __future__ import annotations

from math import degrees, hypot
from typing import TYPE_CHECKING

from agv_motion.planar import REST, Pose, Twist, compose, inverse, require_finite
from agv_motion.trajectory.approach import Approach, is_calm
from agv_motion.trajectory.follower_parameters import FollowerParameters
from agv_motion.trajectory.follower_state import AT_REST, FollowerState
from agv_motion.trajectory.ghost import Ghost
from agv_motion.trajectory.motion import Speeds
from agv_motion.trajectory.pace import PaceController
from agv_motion.trajectory.tracking import TrackingError, tracking_error

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.trajectory.trajectory import Trajectory


CORRECTION_SPEED, CORRECTION_RAMPS = 0.1, 0.2
"""[m/s], [m/s2] Of the second Ghost, which leads over centimetres."""


class Follower:
    """Ghost, law and pace of one robot."""

    def __init__(self, parameters: FollowerParameters | None = None) -> None:
        """Wait for a trajectory."""
        self.parameters = parameters or FollowerParameters()
        self.ghost = Ghost(Pose(0.0, 0.0, 0.0), self.parameters.ghost)
        self.state = FollowerState.IDLE
        self.error = TrackingError(0.0, 0.0, 0.0)
        """As of the last step"""
        self.separation = 0.0
        """[m] as of the last step, heading included"""
        self.held = False
        """Whether the Ghost is to stand still"""
        self.failure = ''
        """Why it ended without having arrived; empty if it did not"""
        self._law = self.parameters.make_law()
        self._pace = PaceController(self.parameters.pace)
        self._aborting = False
        self._correction: Ghost | None = None
        self._corrections = 0
        self._approach = Approach()
        self._heed = 0.0

    @property
    def at_rest(self) -> bool:
        """Whether nothing moves until there is a new trajectory."""
        return self.state in AT_REST

    @property
    def leader(self) -> Ghost:
        """The Ghost behind which the robot is: its own, or the one that corrects."""
        return self._correction or self.ghost

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
        if self.at_rest or self._correction:
            fresh = Ghost(pose, self.parameters.ghost)
            trajectory = plan(fresh)
            self.ghost = fresh
            self._start_from_rest(moving=not self.held)
            fresh.lock(self.held)
        else:
            trajectory = plan(self.ghost)
        self.state = FollowerState.LOCKED if self.held else FollowerState.DRIVING
        self._aborting, self.failure = False, ''
        self._correction, self._corrections = None, 0
        self._approach.restart()
        return trajectory

    def ease_to_halt(self) -> None:
        """Ease the Ghost to a halt where it is; a new one starts held too, until :meth:`go_on`."""
        self.held = True

    def go_on(self) -> None:
        """Let a Ghost that was held go on."""
        self.held = False

    def brake_and_end(self) -> None:
        """Brake to rest on the way; when that is done the state is `ABORTED`."""
        if self.at_rest:
            return
        self.held, self._aborting = False, True
        if self._pace.pace == 1.0:
            self.leader.brake_and_end()  # at full pace, with the ramps of the trajectory

    def freeze(self) -> None:
        """Stand at once and without a ramp, as long as something is wrong; `step` goes on."""
        self._start_from_rest(moving=False)
        self.leader.lock(True)  # noqa: FBT003 - the name says what the flag is
        if self._aborting:
            self._end(FollowerState.ABORTED)

    def retune(self, parameters: FollowerParameters) -> None:
        """Go on with other gains and distances; limits count from the next trajectory on."""
        self.parameters = parameters
        self._law = parameters.make_law()
        self._pace.parameters = parameters.pace

    def end_now(self) -> None:
        """End it at once and without a ramp."""
        if not self.at_rest:
            self._end(FollowerState.ABORTED)

    def step(self, pose: Pose, dt: float) -> Twist:
        """Return the twist for the next cycle.

        Args:
            pose: Where the robot is now.
            dt: Time since the last step [s].

        Raises:
            SignalError: A number is not finite, or ``dt`` is negative; nothing has changed.

        """
        require_finite('pose', pose)
        if self.at_rest:
            return REST
        leader = self.leader
        leader.advance(dt, self._pace.pace)
        place, linear, angular = leader.controller_kinetics(self.parameters.delay)
        self.error = tracking_error(place, pose)
        self.separation = self._pace.separation(self.error)
        if self._pace.is_lost(self.separation):
            return self._lose()
        self._set_pace(dt)
        if self.state is FollowerState.LOCKED:
            self._heed = 0.0
            return REST  # the robot stands, as near as it came
        twist = self._twist(Speeds(linear, angular), dt)
        if leader.finished and leader.aborted:
            return self._end(FollowerState.ABORTED)
        return self._close_in(twist, dt)

    def _lose(self) -> Twist:
        limit = self.parameters.pace.lost_beyond
        return self._end(
            FollowerState.LOST, f'{self.separation:.2f} m off its way, limit {limit:g} m'
        )

    def _twist(self, reference: Speeds, dt: float) -> Twist:
        """Return what the law asks for, within the limits of the robot.

        From rest on it heeds the error by and by: the robot may have been moved meanwhile.
        """
        given = self.parameters
        self._heed = min(self._heed + dt / given.pace.ease, 1.0)
        error = TrackingError(*(self._heed * part for part in self.error))
        return given.ghost.hold(self._law.twist(error, reference))

    def _set_pace(self, dt: float) -> None:
        """Let the Ghost go on, dawdle or wait, and say so."""
        ghost, pace = self.leader, self._pace
        if not ghost.aborted:  # its braking must not be stretched
            pace.ease(self.separation, dt, hold=self.held or self._aborting)
        ghost.lock(pace.pace == 0.0)
        if self._aborting and ghost.locked:
            ghost.brake_and_end()
        if ghost.locked and self.held and not ghost.finished:
            self.state = FollowerState.LOCKED
        elif self._correction:
            self.state = FollowerState.CORRECTING
        elif ghost.finished:
            self.state = FollowerState.SETTLING
        else:
            self.state = FollowerState.WAITING if ghost.locked else FollowerState.DRIVING

    def _close_in(self, twist: Twist, dt: float) -> Twist:
        """Return what to drive instead, where the leader stands and the robot comes no nearer."""
        given, approach, leader = self.parameters, self._approach, self.leader
        if not leader.finished and not leader.locked:
            approach.restart()
            return twist
        approach.update(self.error, self.separation, twist, dt, given.settle_time)
        stalled = approach.stalled > given.settle_time
        if not leader.finished:  # a robot that is held is asked for more
            calm = is_calm(approach.twist, given.settle_speed, given.settle_turn)
            return self._correct() if calm and stalled else twist
        calm = is_calm(twist, given.settle_speed, given.settle_turn) and self._is_near(self.error)
        if (calm or stalled) and self._is_near(approach.error):  # no pose alone is to be believed
            return self._come_up()
        return self._correct() if stalled else twist

    def _is_near(self, error: TrackingError) -> bool:
        """Return whether the robot is where it should be; of a turn only the heading counts."""
        given = self.parameters
        near = self._only_turns() or hypot(error.along, error.across) <= given.tolerance
        return near and abs(error.heading) <= given.heading_tolerance

    def _only_turns(self) -> bool:
        motions = self.ghost.trajectory.motions
        return bool(motions) and all(motion.rotating for motion in motions)

    def _come_up(self) -> Twist:
        """Arrive; or go on behind the first Ghost, if it has only waited."""
        if self.ghost.finished:
            return self._end(FollowerState.ARRIVED)
        self._correction, self._corrections = None, 0
        self._start_from_rest(moving=False)
        return REST

    def _correct(self) -> Twist:
        """Lead the robot from where it is to where the first Ghost stands, or give up."""
        given = self.parameters
        if self._law.goes_sideways or self._corrections >= given.corrections:
            return self._end(FollowerState.NOT_ARRIVED, self._shortfall())
        here = compose(self.leader.pose, inverse(Pose(*self._approach.error)))
        second = Ghost(here, given.ghost)
        if self._only_turns():
            pace = given.ghost.turn_acceleration, given.ghost.turn_rate
        else:
            pace = CORRECTION_RAMPS, CORRECTION_SPEED
        second.compute_trajectory(
            self.ghost.pose, 0.0, *pace,
            pure_rotation=self._only_turns(), backward=self._approach.error.along < 0.0,
        )  # fmt: skip
        second.lock(False)  # noqa: FBT003 - the name says what the flag is
        self._correction = second
        self._corrections += 1
        self._start_from_rest(moving=True)
        return REST

    def _shortfall(self) -> str:
        """Return how far the robot is from where it should be, in words."""
        given, (along, across, heading) = self.parameters, self._approach.error
        ahead = -along if self.ghost.backward else along
        return (
            f'{100.0 * abs(along):.1f} cm {"short" if ahead >= 0.0 else "too far"}, '
            f'{100.0 * abs(across):.1f} cm to the side, {degrees(abs(heading)):.1f} deg turned '
            f'off; tolerance {100.0 * given.tolerance:g} cm, '
            f'{degrees(given.heading_tolerance):.1f} deg'
        )

    def _start_from_rest(self, *, moving: bool) -> None:
        """Note that the robot stands; the leader starts at full pace, or is eased into it."""
        self._pace.restart(moving=moving)
        self._heed = 0.0
        self._approach.restart()

    def _end(self, state: FollowerState, failure: str = '') -> Twist:
        self.leader.lock(True)  # noqa: FBT003 - the name says what the flag is
        self.state, self.failure = state, failure
        self._correction = None
        return REST
