"""From goals to a trajectory: curves, their limits, the fastest speed; all checked beforehand."""

from __future__ import annotations

from itertools import pairwise
from math import atan2, copysign, hypot, pi
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.planar import Pose, require_finite, wrap
from agv_motion.trajectory.arc_length import ArcLength
from agv_motion.trajectory.bezier import connect
from agv_motion.trajectory.circle import Circle
from agv_motion.trajectory.curve_ceiling import curve_ceiling
from agv_motion.trajectory.line import Line
from agv_motion.trajectory.motion import STILL, ArcLengthCurve, Motion, Speeds
from agv_motion.trajectory.motions import DriveMotion, TurnMotion
from agv_motion.trajectory.request import Request
from agv_motion.trajectory.speed_plan import plan_speed
from agv_motion.trajectory.trajectory import Trajectory

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.trajectory.arc import Arc
    from agv_motion.trajectory.ghost_parameters import GhostParameters

NOTHING = 1e-9
"""[m], [rad], [m/s], [rad/s] What is shorter or slower than this is none."""

MOST_MOTIONS = 400
"""Drives and turns, each from rest, of one path; each takes its time to plan."""


class Planner:
    """Makes trajectories for one robot."""

    def __init__(self, parameters: GhostParameters) -> None:
        """Plan for a robot of ``parameters``."""
        self.parameters = parameters
        self._limits = self.parameters.limits()

    def rotation(
        self, start: Pose, heading: float, request: Request, present: Speeds = STILL
    ) -> Trajectory:
        """Return the turn on the spot, the shorter way round, to ``heading`` [rad].

        Raises:
            SignalError: A number is not finite.
            ConfigurationError: It takes longer than the limits allow.
            GeometryError: The present motion cannot go over into this turn.

        """
        require_finite('rotation (start, heading)', (*start, heading))
        end = start._replace(theta=wrap(heading))
        turns = self._turn(start, end, request, present)
        return self._trajectory(start, end, turns, request, present)

    def turn(
        self, start: Pose, angle: float, request: Request, present: Speeds = STILL
    ) -> Trajectory:
        """Return the turn on the spot by ``angle`` [rad], of any size, left positive.

        Raises:
            SignalError: A number is not finite.
            ConfigurationError: It takes longer than the limits allow.
            GeometryError: The present motion cannot go over into this turn.

        """
        require_finite('turn (start, angle)', (*start, angle))
        self._require_time(abs(angle) / self._spot_rate(request))
        end = start._replace(theta=wrap(start.theta + angle))
        turns = self._spin(start, end, angle, request, present)
        return self._trajectory(start, end, turns, request, present)

    def arc(self, start: Pose, arc: Arc, present: Speeds = STILL) -> Trajectory:
        """Return the drive along ``arc`` from ``start``, within the limits of the robot.

        Raises:
            SignalError: ``start`` is not finite.
            ConfigurationError: It is longer, or takes longer, than the limits allow.
            GeometryError: The present motion cannot go over into this arc.

        """
        speed, ramp = arc.share * abs(arc.speed), arc.share * arc.acceleration
        self._require_way(arc.length)
        self._require_time(arc.length / speed)
        end = arc.end(start)
        request = Request(ramp, speed, backward=arc.backward)
        motions: list[Motion] = []
        if arc.length > NOTHING:
            motions.append(self._along(Circle(arc, start), (start, end), request, present))
        return self._trajectory(start, end, motions, request, present)

    def drive(
        self, start: Pose, goals: Sequence[Pose], request: Request, present: Speeds = STILL
    ) -> Trajectory:
        """Return the way from ``start`` through ``goals`` to the last of them.

        With ``delta_curve`` = 0 the curves are straight lines, and the robot turns on the spot at
        their ends: what a curve tends to as its handles shrink.

        Args:
            start: Present pose.
            goals: Poses to pass, at least one.
            request: Pace, shape and sense.
            present: Speeds to start with.

        Raises:
            SignalError: A number is not finite.
            ConfigurationError: No goal, too many, or further than the limits allow.
            GeometryError: A curve has a cusp, or the present motion cannot go over into this way.

        """
        if not goals:
            msg = 'no goal given: a way needs at least one pose'
            raise ConfigurationError(msg)
        self.require_count(len(goals))
        for pose in (start, *goals):
            require_finite('poses', pose)
        chords = sum(
            hypot(b.x - a.x, b.y - a.y) for a, b in zip((start, *goals), goals, strict=False)
        )
        self._require_way(chords)
        self._require_time(chords / request.cruising_speed)
        motions: list[Motion] = []
        joined = [start]  # by curves, without a stop
        for goal in goals:
            there = Pose(goal.x, goal.y, wrap(goal.theta))
            if request.delta_curve > 0.0 and abs(_point(there) - _point(joined[-1])) > NOTHING:
                joined.append(there)
                continue
            motions += self._curves(joined, request, _first(motions, present))
            motions += self._corners(joined[-1], there, request, _first(motions, present))
            joined = [there]
            if len(motions) > MOST_MOTIONS:
                raise ConfigurationError(_too_many_stops(request))
        motions += self._curves(joined, request, _first(motions, present))
        return self._trajectory(start, joined[-1], motions, request, present)

    def require_count(self, poses: int) -> None:
        """Raise if this number of ``poses`` is too many for one path.

        Raises:
            ConfigurationError: They are more than the limit.

        """
        most = self.parameters.most_poses
        if poses > most:
            msg = (
                f'a path of {poses} poses: at most {most} (most_poses); send every '
                f'{-(-poses // most)}th pose, or raise the limit'
            )
            raise ConfigurationError(msg)

    def _require_way(self, way: float) -> None:
        most = self.parameters.longest_way
        if not way <= most:
            msg = f'a way of {way:.5g} m: at most {most:g} m (longest_way); send it in parts'
            raise ConfigurationError(msg)

    def _require_time(self, time: float) -> None:
        most = self.parameters.longest_time
        if not time <= most:
            msg = (
                f'a trajectory of {time:.5g} s or more: at most {most:g} s (longest_time); go '
                'faster, or send it in parts'
            )
            raise ConfigurationError(msg)

    def _spot_rate(self, request: Request) -> float:
        return min(request.cruising_speed, self.parameters.spot_rate())

    def _trajectory(
        self, start: Pose, end: Pose, motions: list[Motion], request: Request, present: Speeds
    ) -> Trajectory:
        self._require_way(sum(motion.length for motion in motions))
        self._require_time(sum(motion.duration for motion in motions))
        if not motions and max(abs(present.linear), abs(present.angular)) > NOTHING:
            raise GeometryError(_other_motion(present))
        return Trajectory((start, end), motions, request, self._limits)

    def _curves(self, poses: Sequence[Pose], request: Request, present: Speeds) -> list[Motion]:
        """Return the drive on curves through ``poses``; none for a single one."""
        if len(poses) < 2:
            return []
        delta, backward = request.delta_curve, request.backward
        course = ArcLength([connect(a, b, delta, backward=backward) for a, b in pairwise(poses)])
        return [self._along(course, (poses[0], poses[-1]), request, present)]

    def _corners(self, here: Pose, there: Pose, request: Request, present: Speeds) -> list[Motion]:
        """Return a turn into the straight line, the drive along it, a turn into the goal."""
        corner = Request(self.parameters.turn_acceleration, self.parameters.turn_rate)
        line = _point(there) - _point(here)
        if abs(line) <= NOTHING:
            return self._turn(here, there, corner, present)
        heading = wrap(atan2(line.imag, line.real) + pi * request.backward)
        ends = here._replace(theta=heading), there._replace(theta=heading)
        motions = self._turn(here, ends[0], corner, present)
        course = Line(_point(here), _point(there))
        motions.append(self._along(course, ends, request, _first(motions, present)))
        return motions + self._turn(ends[1], there, corner, STILL)

    def _along(
        self, course: ArcLengthCurve, ends: tuple[Pose, Pose], request: Request, present: Speeds
    ) -> DriveMotion:
        """Return the fastest drive along ``course``.

        Raises:
            GeometryError: The robot moves the other way, or turns on the spot, or too fast, or
                its turn rate would jump.

        """
        ramp = request.acceleration
        speed = -present.linear if request.backward else present.linear
        if speed < -NOTHING or (abs(speed) <= NOTHING and abs(present.angular) > NOTHING):
            raise GeometryError(_other_motion(present))
        jump = speed * float(course.curvature[0]) - present.angular
        if abs(jump) > self.parameters.turn_step:
            raise GeometryError(_other_motion(present))
        profile = plan_speed(
            course.way,
            curve_ceiling(course, self._limits, request.cruising_speed),
            ramp,
            max(speed, 0.0),
            self.parameters.s_curve,
        )
        return DriveMotion(course, ends, profile, ramp, backward=request.backward)

    def _turn(self, start: Pose, end: Pose, request: Request, present: Speeds) -> list[Motion]:
        """Return the turn on the spot, the shorter way round, as :meth:`_spin`."""
        return self._spin(start, end, wrap(end.theta - start.theta), request, present)

    def _spin(
        self, start: Pose, end: Pose, angle: float, request: Request, present: Speeds
    ) -> list[Motion]:
        """Return the turn on the spot by ``angle``; none where there is nothing to turn.

        Raises:
            GeometryError: The robot drives, or turns the other way, or too fast.

        """
        if abs(angle) <= NOTHING:
            return []
        sign = copysign(1.0, angle)
        if abs(present.linear) > NOTHING or sign * present.angular < -NOTHING:
            raise GeometryError(_other_motion(present))
        rate, ramp = self._spot_rate(request), request.acceleration
        profile = plan_speed(
            np.array([0.0, abs(angle)]),
            np.array([rate, rate]),
            ramp,
            max(sign * present.angular, 0.0),
            self.parameters.s_curve,
        )
        return [TurnMotion(start, end, sign, profile, ramp)]


def _too_many_stops(request: Request) -> str:
    return (
        f'a path with more than {MOST_MOTIONS} drives and turns from rest to rest (delta_curve = '
        f'{request.delta_curve:g}): send it in parts, or with a delta_curve that leads through '
        'the poses without a stop'
    )


def _point(pose: Pose) -> complex:
    return complex(pose.x, pose.y)


def _first(motions: Sequence[Motion], present: Speeds) -> Speeds:
    """Return the speeds a further motion starts with: only the first one starts in motion."""
    return STILL if motions else present


def _other_motion(present: Speeds) -> str:
    return (
        f'the robot moves with {present.linear:.4g} m/s and {present.angular:.4g} rad/s, which '
        'cannot go over into this trajectory without a jump: stop it first'
    )
