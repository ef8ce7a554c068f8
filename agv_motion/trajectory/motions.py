"""The two ways to move of a robot with a heading: along curves, and on the spot.

A motion is immutable; where it stands at a time depends on that time alone.
"""

from __future__ import annotations

from math import atan2, pi
from typing import TYPE_CHECKING

from agv_motion.planar import Pose, wrap
from agv_motion.trajectory.motion import STILL, ArcLengthCurve, Speeds

if TYPE_CHECKING:
    from agv_motion.trajectory.profile import Profile


class TurnMotion:
    """A rotation on the spot, by ``angle`` [rad] without sign."""

    rotating = True
    length = 0.0

    def __init__(self, start: Pose, end: Pose, sign: float, profile: Profile, ramp: float) -> None:
        """Turn from ``start`` to ``end``, which stand at one place.

        Args:
            start: Where it begins.
            end: Where it rests.
            sign: 1 to the left, -1 to the right.
            profile: Angle turned over time [rad].
            ramp: Braking when stopped early [rad/s2].

        """
        self.start = start
        self.end = end
        self.duration = profile.duration
        self.angle = profile.at(profile.duration).way
        self._sign = sign
        self._profile = profile
        self._ramp = ramp

    def pose(self, time: float) -> Pose:
        """Return the pose at ``time`` [s]."""
        if time >= self.duration:
            return self.end
        turned = self._sign * self._profile.at(max(time, 0.0)).way
        return Pose(self.start.x, self.start.y, wrap(self.start.theta + turned))

    def speeds(self, time: float) -> Speeds:
        """Return the speeds at ``time`` [s]."""
        if not 0.0 <= time < self.duration:
            return STILL
        return Speeds(0.0, self._sign * self._profile.at(time).speed)

    def stopped(self, time: float) -> TurnMotion:
        """Return the same turn until ``time`` [s], then braked to rest."""
        if time >= self.duration:
            return self
        profile = self._profile.stopped(time, self._ramp)
        angle = self._sign * profile.at(profile.duration).way
        end = self.start._replace(theta=wrap(self.start.theta + angle))
        return TurnMotion(self.start, end, self._sign, profile, self._ramp)


class DriveMotion:
    """A drive of ``length`` [m] along curves, the heading on the tangent; or opposite to it."""

    rotating = False

    def __init__(
        self,
        course: ArcLengthCurve,
        ends: tuple[Pose, Pose],
        profile: Profile,
        ramp: float,
        *,
        backward: bool,
    ) -> None:
        """Drive along ``course``.

        Args:
            course: The curves.
            ends: The poses at its two ends.
            profile: Way over time [m].
            ramp: Braking when stopped early [m/s2].
            backward: Whether the robot looks against its way.

        """
        self.course = course
        self.start, self.end = ends
        self.profile = profile
        self._ramp = ramp
        self._sense = -1.0 if backward else 1.0

    @property
    def duration(self) -> float:
        """Until it rests [s]."""
        return self.profile.duration

    @property
    def length(self) -> float:
        """Way driven [m]."""
        return self.profile.at(self.profile.duration).way

    def pose(self, time: float) -> Pose:
        """Return the pose at ``time`` [s]."""
        if time >= self.duration:
            return self.end
        return self.start if time <= 0.0 else self.at_way(self.profile.way(time))

    def at_way(self, way: float) -> Pose:
        """Return the pose at ``way`` [m] from the start."""
        curve, u = self.course.locate(max(0.0, way))
        point, along = curve.point(u), self._sense * curve.velocity(u)
        heading = atan2(along.imag, along.real)  # cmath.phase raises where the angle underflows
        return Pose(point.real, point.imag, heading if heading < pi else -pi)

    def speeds(self, time: float) -> Speeds:
        r"""Return the speeds at ``time`` [s]: :math:`\omega = |v| \kappa`, whichever the sense."""
        if not 0.0 <= time < self.duration:
            return STILL
        way, speed, _ = self.profile.at(time)
        curve, u = self.course.locate(max(0.0, way))
        velocity, bend = curve.velocity(u), curve.acceleration(u)
        length = abs(velocity)
        cross = velocity.real * bend.imag - velocity.imag * bend.real
        return Speeds(self._sense * speed, speed * cross / (length * length * length))

    def stopped(self, time: float) -> DriveMotion:
        """Return the same drive until ``time`` [s], then braked to rest on its curve."""
        if time >= self.duration:
            return self
        profile = self.profile.stopped(time, self._ramp)
        end = self.at_way(profile.at(profile.duration).way)
        ends = self.start, end
        return DriveMotion(self.course, ends, profile, self._ramp, backward=self._sense < 0.0)
