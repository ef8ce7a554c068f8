"""A gyroscope beside the wheels: its turn between two readings, and its bias, which it learns.

At rest all that it tells is bias; in motion the wheels tell what is not, less surely. What is not
known of the bias is no white noise: it turns the robot the same way for minutes. It is counted as
the white noise that does as much over twice its persistence, and more before, so that between two
fixes the covariance is never too small.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, NamedTuple

from agv_motion.odometry.continuity import Continuity, Succession
from agv_motion.odometry.covariance import Covariance
from agv_motion.odometry.gates import require_within
from agv_motion.parameters import Spec, check
from agv_motion.planar import require_finite

if TYPE_CHECKING:
    from agv_motion.odometry.dead_reckoning import Displacement


STRETCH = 2.0
"""[-] A turn is not taken to have gone on for more than this times as long as it was measured."""
PERSISTENCE = 30.0
"""[s] For half of the longest time that the gyroscope has to do without a fix."""


@dataclass(frozen=True)
class YawRateParameters:
    """How good the gyroscope is."""

    noise: Annotated[
        float, Spec('standard deviation of the turn after 1 s', 'rad', (1e-7, 1.0))
    ] = 0.002
    bias: Annotated[
        float, Spec('standard deviation of the rate at rest, when new', 'rad/s', (0.0, 1.0))
    ] = 0.01
    bias_walk: Annotated[
        float, Spec('standard deviation of its change within 1 s', 'rad/s', (0.0, 1.0))
    ] = 2e-5
    max_gap: Annotated[float, Spec('silence over which nothing is told', 's', (1e-3, 10.0))] = 0.2
    max_rate: Annotated[
        float, Spec('rate beyond which a measurement is refused', 'rad/s', (0.1, 1000.0))
    ] = 35.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class GyroTurn(NamedTuple):
    """What the gyroscope says of the turn over some time."""

    angle: float
    """[rad]"""
    variance: float
    """[rad2]"""
    duration: float
    """[s]"""

    def fits(self, duration: float) -> bool:
        """Return whether it was measured over most of ``duration`` [s], with no gap and no leap."""
        return 0.0 < duration <= STRETCH * self.duration

    def correct(
        self, displacement: Displacement, covariance: Covariance, duration: float
    ) -> tuple[Displacement, Covariance]:
        """Return the displacement of the wheels and its covariance, given this turn as well.

        The turn is a measurement of one of the three numbers of a normal distribution; its share
        of the others follows from their correlation.

        Args:
            displacement: What the wheels say [m, m, rad].
            covariance: Of it.
            duration: Over which the wheels say so [s]; the turn is stretched to it.

        """
        if not self.fits(duration):
            return displacement, covariance
        stretch = duration / self.duration
        xx, xy, xt, yy, yt, tt = covariance
        total = tt + self.variance * stretch * stretch
        dx, dy, angle = displacement
        surprise = (self.angle * stretch - angle) / total
        corrected = dx + xt * surprise, dy + yt * surprise, angle + tt * surprise
        return corrected, Covariance(
            xx - xt * xt / total,
            xy - xt * yt / total,
            xt - xt * tt / total,
            yy - yt * yt / total,
            yt - yt * tt / total,
            tt - tt * tt / total,
        )


class YawRate:
    """Adds up the rate of a gyroscope, less its bias, between two readings of the wheels."""

    def __init__(self, parameters: YawRateParameters | None = None) -> None:
        """Start with no bias, as uncertain of it as the parameters say."""
        self._given = parameters or YawRateParameters()
        self.bias = 0.0
        """[rad/s] what the gyroscope tells at rest"""
        self.bias_variance = self._given.bias**2
        self._order = Continuity[float](self._given.max_gap, lambda *_: True)
        self._rate = 0.0
        self._angle = self._duration = 0.0

    @property
    def rate(self) -> float:
        """Last measured yaw rate, less the bias [rad/s]."""
        return self._rate - self.bias

    def add(self, stamp: float, rate: float, *, at_rest: bool = False) -> None:
        """Take a measurement.

        Args:
            stamp: Time [s]; one that does not follow the last is ignored, see `continuity`.
            rate: Measured yaw rate [rad/s].
            at_rest: Whether the wheels stand still, so that the rate is nothing but bias.

        Raises:
            SignalError: A number is not finite, or the rate cannot be.

        """
        require_finite('yaw rate and its stamp', (stamp, rate))
        require_within('yaw rate', (rate,), self._given.max_rate, 'rad/s', 'look at the gyroscope')
        before = self._order.stamp
        step = self._order.judge(stamp, rate)
        if not step.used:
            return
        if step is Succession.MOVED:
            duration = stamp - before
            self._angle += duration * (0.5 * (rate + self._rate) - self.bias)
            self._duration += duration
            self._learn(rate, duration, at_rest=at_rest)
        else:
            self._angle = self._duration = 0.0
        self._rate = rate

    def _learn(self, rate: float, duration: float, *, at_rest: bool) -> None:
        """Let the bias walk on, and at rest move it towards the rate (a scalar Kalman filter)."""
        self.bias_variance += self._given.bias_walk**2 * duration
        if at_rest:
            self._correct(rate - self.bias, self._given.noise**2 / duration)

    def compare(self, turn: GyroTurn, angle: float, variance: float) -> None:
        """Learn the bias from what the wheels say of a turn as well.

        Args:
            turn: As :meth:`take` gave it.
            angle: What the wheels say [rad].
            variance: Of that [rad2].

        """
        if turn.duration > 0.0 and variance > 0.0:
            noise = variance + self._given.noise**2 * turn.duration
            self._correct((turn.angle - angle) / turn.duration, noise / turn.duration**2)

    def _correct(self, missed: float, noise: float) -> None:
        gain = self.bias_variance / (self.bias_variance + noise)
        self.bias += gain * missed
        self.bias_variance *= 1.0 - gain

    def take(self) -> GyroTurn | None:
        """Return the turn since this was last asked; None when nothing was measured."""
        if self._duration == 0.0:
            return None
        a_second = self._given.noise**2 + 2.0 * PERSISTENCE * self.bias_variance
        turn = GyroTurn(self._angle, a_second * self._duration, self._duration)
        self._angle = self._duration = 0.0
        return turn
