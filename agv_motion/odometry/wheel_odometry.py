"""Odometry of any base from its wheel encoders: pose, twist, covariance and slip.

The noise of each wheel grows like a random walk with the distance it rolls; the residual of the
fit, what the wheels measure against each other, tells when it is worse than that.
"""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.odometry.continuity import Succession
from agv_motion.odometry.covariance import CERTAIN, Covariance, scale
from agv_motion.odometry.dead_reckoning import DeadReckoning
from agv_motion.odometry.encoders import MOVED, Encoders
from agv_motion.odometry.parameters import OdometryParameters
from agv_motion.planar import Pose, Twist, require_finite, wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.base import Base
    from agv_motion.odometry.yaw_rate import GyroTurn

SLIP = 9.0
"""[-] Wheels slip when their residual shows more than this many times the usual variance."""


class WheelOdometry:
    """Pose and twist of a base in its `odom` frame, from the angles of its wheels."""

    def __init__(
        self,
        base: Base,
        wheel_radii: Sequence[float],
        parameters: OdometryParameters | None = None,
    ) -> None:
        """Start at the origin, with nothing read yet.

        Args:
            base: Turns travels into a displacement.
            wheel_radii: (n,) rolling radius of each wheel [m].
            parameters: How far the wheels can be trusted.

        Raises:
            ConfigurationError: The radii are not n finite numbers above zero.

        """
        if len(wheel_radii) != len(base):
            msg = f'{len(wheel_radii)} wheel_radii for {len(base)} wheels: give one each'
            raise ConfigurationError(msg)
        given = parameters or OdometryParameters()
        self._encoders = Encoders(wheel_radii, given)
        self._reckoning = DeadReckoning()
        self._given = given
        self.use(base)
        self._quantum = (given.encoder_resolution * max(wheel_radii)) ** 2 / 6.0  # two roundings
        self._steering: Sequence[float] = ()
        self._displacement = 0.0, 0.0, 0.0
        self._unexplained = 0.0
        self._duration = 1.0
        self._noise = CERTAIN, 1.0

    @property
    def stamp(self) -> float | None:
        """Time of the last reading [s]; None before the first."""
        return self._encoders.stamp

    @property
    def pose(self) -> Pose:
        """Pose of the base in `odom`."""
        reckoning = self._reckoning
        return Pose(reckoning.x, reckoning.y, reckoning.heading)

    @property
    def twist(self) -> Twist:
        """Mean velocity over the last step, in the frame of the base."""
        vx, vy, wz = (component / self._duration for component in self._displacement)
        return Twist(vx, vy, wz)

    @property
    def residual(self) -> float:
        """Root mean square of what the wheels measured against each other last [m/s]."""
        return self._unexplained / self._duration

    @property
    def origin_covariance(self) -> Covariance:
        """Covariance of the error about the origin of `odom`, see `dead_reckoning`."""
        return self._reckoning.origin_covariance

    def covariance(self) -> Covariance:
        """Return the covariance of the pose in the axes of `odom`."""
        return self._reckoning.covariance()

    def twist_covariance(self) -> Covariance:
        """Return the covariance of the twist, in the frame of the base."""
        covariance, variance = self._noise
        return scale(covariance, variance / (self._duration * self._duration))

    def use(self, base: Base) -> None:
        """Go on with ``base``: the same wheels, but others of them left out."""
        self._base = base
        wheels = base.measuring
        self._walk = self._given.wheel_noise**2 / wheels

    def set_angles(self, angles: dict[int, float]) -> None:
        """Take some wheels to have stood at ``angles`` [rad] in the last reading."""
        self._encoders.set_angles(angles)

    def set_odometry(self, pose: Pose, covariance: Covariance = CERTAIN) -> None:
        """Go on from ``pose``, known as well as ``covariance`` says; the encoders count on.

        Raises:
            SignalError: A number is not finite.

        """
        self._reckoning.set(pose, covariance)

    def update(
        self,
        stamp: float,
        angles: Sequence[float],
        steering: Sequence[float] = (),
        turn: GyroTurn | None = None,
        *,
        by_rate: bool = False,
    ) -> Succession:
        """Take a reading of the encoders and carry pose, covariance and twist on.

        Args:
            stamp: Time of the reading [s].
            angles: (n,) angle of each wheel [rad].
            steering: (n,) steering angles [rad] of a base on turrets.
            turn: What a gyroscope says of the turn since the last reading.
            by_rate: Whether angles are added-up rates, which tell nothing of what was not seen.

        Returns:
            What the reading was good for.

        Raises:
            SignalError: A wrong number of values, or one that is not finite; nothing has changed.

        """
        base, encoders = self._base, self._encoders
        halfway = self._halfway(steering) if base.steers or steering else steering
        step = encoders.read(stamp, angles, by_rate=by_rate)
        if step is not MOVED and not step.used:
            return step
        if steering:
            self._steering = list(steering)
        if step is Succession.FIRST:
            return step
        if step is Succession.LEAP:
            self._go_beyond(halfway)
        variance, covariance = self._walk * encoders.rolled, base.unit_covariance
        dx, dy, angle, residual = base.displacement(encoders.travel, halfway)
        displacement, duration = (dx, dy, angle), encoders.duration
        if residual:
            variance = self._with_slip(variance, residual)
        if encoders.doubt:
            variance += self._together(step, by_rate=by_rate) * encoders.doubt**2
        if turn is not None:
            covariance, variance = scale(covariance, variance), 1.0
            displacement, covariance = turn.correct(displacement, covariance, duration)
        self._reckoning.carry(displacement, covariance, variance)
        self._noise = covariance, variance
        self._displacement, self._unexplained, self._duration = displacement, residual, duration
        return step

    def _go_beyond(self, halfway: Sequence[float]) -> None:
        """Carry the pose over what the wheels rolled while the clock leapt; no twist tells it."""
        travel = self._encoders.beyond
        dx, dy, angle, _ = self._base.displacement(travel, halfway)
        variance = self._walk * sum(map(abs, travel))
        self._reckoning.carry((dx, dy, angle), self._base.unit_covariance, variance)

    def _with_slip(self, variance: float, residual: float) -> float:
        """Return the variance [m2] of a travel: the usual one, or what the residual shows."""
        shown = self._base.measuring * residual * residual / self._base.redundancy
        return shown if shown > SLIP * (variance + self._quantum) else variance

    def _halfway(self, steering: Sequence[float]) -> Sequence[float]:
        """Return the steering angles halfway between the last reading and this one."""
        if not isfinite(sum(steering)):
            require_finite('steering angles', tuple(steering))
        expected = len(self._base) if self._base.steers else 0
        if len(steering) != expected:
            msg = f'{len(steering)} steering angles given, this base has {expected}: give one each'
            raise SignalError(msg)
        if not self._steering:  # the first reading
            return steering
        return [a + 0.5 * wrap(b - a) for a, b in zip(self._steering, steering, strict=True)]

    def _together(self, step: Succession, *, by_rate: bool) -> int:
        """Return how many wheels go wrong together: all, where nobody knows whether they moved.

        Each wheel has its own part in a path that is guessed between two positions.
        """
        return 1 if step is Succession.GAP and not by_rate else len(self._base)
