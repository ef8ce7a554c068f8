"""The Ghost: the ideal robot that runs ahead of the real one, in exact time.

It holds a trajectory and a time, nothing else that moves. Time passes only by :meth:`Ghost.advance`
and stands still while the Ghost is locked, so where it is depends on how much time has passed and
never on the steps in which it passed.
"""

from __future__ import annotations

from sys import float_info
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import ConfigurationError, GeometryError, SignalError
from agv_motion.planar import Pose, require_finite, wrap
from agv_motion.trajectory.arc import Arc
from agv_motion.trajectory.departure import AT_ONCE, DEPARTURES, leave
from agv_motion.trajectory.feasibility import Feasibility, examine
from agv_motion.trajectory.ghost_parameters import GhostParameters
from agv_motion.trajectory.motion import STILL, Speeds
from agv_motion.trajectory.planner import Planner
from agv_motion.trajectory.request import Request
from agv_motion.trajectory.trajectory import Trajectory

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


MANY = 100
"""A path of more poses leaves the old trajectory at once, or from rest: each try takes its time."""


class Kinetics(NamedTuple):
    """What a position servo needs: where to be now, and how fast to go by then."""

    pose: Pose
    """now"""
    linear: float
    """[m/s] forward, after the delay"""
    angular: float
    """[rad/s] after the delay"""


class Ghost:
    """The ideal robot; locked at first, at rest."""

    def __init__(self, pose: Pose, parameters: GhostParameters | None = None) -> None:
        """Stand at ``pose``.

        Raises:
            SignalError: It is not finite.

        """
        self._planner = Planner(parameters or GhostParameters())
        self._locked = True
        self._trajectory = self._standing(pose)
        self._time = 0.0
        self._rate = 1.0
        self._aborted = False

    @property
    def locked(self) -> bool:
        """Whether time stands still."""
        return self._locked

    @property
    def rotating(self) -> bool:
        """Whether it turns on the spot."""
        return not self.finished and self._trajectory.rotating(self._time)

    @property
    def backward(self) -> bool:
        """Whether its trajectory is driven backwards."""
        request = self._trajectory.request
        return request is not None and request.backward

    @property
    def finished(self) -> bool:
        """Whether it has come to the end of its trajectory."""
        return self._time >= self._trajectory.duration

    @property
    def aborted(self) -> bool:
        """Whether it has been told to stop before its goal."""
        return self._aborted

    @property
    def trajectory(self) -> Trajectory:
        """What it follows."""
        return self._trajectory

    @property
    def time(self) -> float:
        """How long it has followed its trajectory [s]."""
        return self._time

    @property
    def pose(self) -> Pose:
        """Where it is."""
        return self._trajectory.pose(self._time)

    @property
    def speeds(self) -> Speeds:
        """How fast it goes now; zero while locked."""
        return self._speeds(0.0)

    def compute_trajectory(  # noqa: PLR0913 - the interface of the reference
        self,
        final_pose: Pose,
        delta_curve: float,
        speed_ramps: float,
        cruising_speed: float,
        *,
        pure_rotation: bool = False,
        backward: bool = False,
    ) -> Trajectory:
        """Leave for ``final_pose`` from the present pose and the present speed.

        In motion the speed does not jump: where the new curve bends too much for the present
        speed, or leads the other way, the Ghost brakes on its old way first, at the worst to rest.
        Nothing moves while it is locked: :meth:`report` tells what is coming. If the trajectory is
        refused the Ghost goes on with the one it has.

        Args:
            final_pose: Where to go; of a pure rotation only its heading counts.
            delta_curve: Length of the handles of the curve as a share of the distance; 0 for a
                straight line with turns on the spot.
            speed_ramps: Acceleration and braking [m/s2]; [rad/s2] of a pure rotation.
            cruising_speed: [m/s]; [rad/s] of a pure rotation.
            pure_rotation: Whether to turn on the spot only.
            backward: Whether to drive backwards.

        Raises:
            SignalError: A number is not finite.
            ConfigurationError: A speed or ramp is not positive, or ``delta_curve`` out of range.
            GeometryError: The curve has a cusp.

        """
        if not pure_rotation:
            return self.compute_path(
                [final_pose], delta_curve, speed_ramps, cruising_speed, backward=backward
            )
        request, heading = Request.of_turn(speed_ramps, cruising_speed), final_pose.theta
        return self._depart(
            lambda start, present: self._planner.rotation(start, heading, request, present)
        )

    def compute_path(
        self,
        poses: Sequence[Pose],
        delta_curve: float,
        speed_ramps: float,
        cruising_speed: float,
        *,
        backward: bool = False,
    ) -> Trajectory:
        """Leave for the last of ``poses`` through the others, without a stop.

        Arguments and errors as in :meth:`compute_trajectory`.
        """
        self.require_count(len(poses))
        request = Request(speed_ramps, cruising_speed, delta_curve, backward)
        return self._depart(
            lambda start, present: self._planner.drive(start, poses, request, present),
            DEPARTURES if len(poses) <= MANY else AT_ONCE,
        )

    def require_count(self, poses: int) -> None:
        """Raise if this number of ``poses`` is too many for one path: to ask before they are made.

        Raises:
            ConfigurationError: They are.

        """
        self._planner.require_count(poses)

    def compute_arc(
        self, angle: float, diameter: float, speed_ramps: float, cruising_speed: float
    ) -> Trajectory:
        """Leave along an arc, see :class:`agv_motion.trajectory.arc.Arc`, for its end.

        Args:
            angle: [rad] the centre on the left where positive, on the right where negative.
            diameter: Of the inner wheel's circle [m].
            speed_ramps: Acceleration and braking of the outer wheel [m/s2].
            cruising_speed: Of the outer wheel [m/s]; negative: backwards.

        Raises:
            ConfigurationError: A number is not finite or out of its range.

        """
        arc = Arc(angle, diameter, self._planner.parameters.track, cruising_speed, speed_ramps)
        return self._depart(lambda start, present: self._planner.arc(start, arc, present))

    def compute_turn(self, angle: float, speed_ramps: float, cruising_speed: float) -> Trajectory:
        """Turn on the spot by ``angle`` [rad], of any size, left positive.

        Args:
            angle: How far to turn.
            speed_ramps: [rad/s2]
            cruising_speed: [rad/s]

        Raises:
            SignalError: ``angle`` is not finite.
            ConfigurationError: A speed or ramp is not positive.

        """
        request = Request.of_turn(speed_ramps, cruising_speed)
        return self._depart(
            lambda start, present: self._planner.turn(start, angle, request, present)
        )

    def report(self) -> Feasibility:
        """Return what the trajectory asks of the robot, before it moves."""
        return examine(self._trajectory)

    def advance(self, dt: float, rate: float = 1.0) -> None:
        """Let ``dt`` [s] pass, unless locked.

        Args:
            dt: Time passed since the last call.
            rate: Share of it that passes for the Ghost, in [0, 1]: below 1 it dawdles on its way
                so that a robot behind can catch up, and its speeds are reduced as much.

        Raises:
            SignalError: ``dt`` is negative or not finite, or ``rate`` lies outside [0, 1].

        """
        if not 0.0 <= dt < float('inf') or not 0.0 <= rate <= 1.0:
            msg = f'dt = {dt} s, rate = {rate}: give a finite time >= 0 and a rate in [0, 1]'
            raise SignalError(msg)
        if not self._locked:
            self._time += rate * dt
            self._rate = rate

    def lock(self, state: bool) -> None:  # noqa: FBT001 - the name says what the flag is
        """Stop the time at once, or let it pass; a controlled stop is :meth:`brake_and_end`."""
        self._locked = state

    def brake_and_end(self) -> None:
        """Brake with the ramps of the trajectory to rest on its way; finished when at rest."""
        if not self.finished:
            time = self._time
            self._trajectory = (
                self._standing(self.pose) if self._locked else self._trajectory.stopped(time)
            )
            self._aborted = True

    def place(self, pose: Pose) -> None:
        """Stand at ``pose``, usually where the robot is, without a trajectory.

        Raises:
            GeometryError: The Ghost is moving.
            SignalError: ``pose`` is not finite.

        """
        if self.speeds != STILL:
            msg = f'the Ghost moves with {self.speeds.linear:.4g} m/s: abort or lock it first'
            raise GeometryError(msg)
        self._follow(self._standing(pose))

    def controller_kinetics(self, delay: float = 0.0) -> Kinetics:
        """Return the pose now and the speeds ``delay`` [s] ahead; zero speeds while locked."""
        linear, angular = self._speeds(delay)
        return Kinetics(self._trajectory.pose(self._time), linear, angular)

    def _speeds(self, delay: float) -> Speeds:
        if self._locked:
            return STILL
        if not 0.0 <= delay < float_info.max:
            msg = f'delay = {delay} s: must be finite and not negative'
            raise ConfigurationError(msg)
        rate = self._rate
        speeds = self._trajectory.speeds(self._time + rate * delay)
        return speeds if rate == 1.0 else Speeds(rate * speeds.linear, rate * speeds.angular)

    def _depart(
        self,
        plan: Callable[[Pose, Speeds], Trajectory],
        departures: Sequence[float] = DEPARTURES,
    ) -> Trajectory:
        """Follow ``plan`` from now, or after as little braking as it needs."""
        if self.speeds == STILL:
            return self._follow(plan(self.pose, STILL))
        return self._follow(leave(self._trajectory, self._time, self._rate, plan, departures))

    def _follow(self, trajectory: Trajectory) -> Trajectory:
        self._trajectory, self._time, self._rate, self._aborted = trajectory, 0.0, 1.0, False
        return trajectory

    def _standing(self, pose: Pose) -> Trajectory:
        require_finite('pose', pose)
        pose = pose._replace(theta=wrap(pose.theta))
        return Trajectory((pose, pose))
