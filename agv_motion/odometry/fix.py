"""A position fix: where an outside system (UWB, GNSS, a camera) saw the robot at some time."""

from __future__ import annotations

from dataclasses import dataclass

from agv_motion.errors import SignalError
from agv_motion.odometry.covariance import Covariance, is_positive_definite
from agv_motion.planar import require_finite


@dataclass(frozen=True)
class Fix:
    """Measured position, and heading where there is one, in the frame `map`."""

    stamp: float
    """[s] when the robot was there, not when the message came"""
    x: float
    """[m]"""
    y: float
    """[m]"""
    covariance: Covariance
    """Of x, y and heading in the axes of `map`; without a heading only xx, xy and yy count"""
    heading: float | None = None
    """[rad] from several tags or a compass; None when unknown"""

    def __post_init__(self) -> None:
        """Refuse what is no measurement.

        Raises:
            SignalError: A number is not finite, or the covariance is not positive definite.

        """
        require_finite('fix (stamp, x, y)', (self.stamp, self.x, self.y))
        xx, xy, _, yy, _, _ = used = self.covariance
        if self.heading is None:
            used = Covariance(xx, xy, 0.0, yy, 0.0, 1.0)
        else:
            require_finite('heading of a fix', (self.heading,))
        require_finite('covariance of a fix', used)
        if not is_positive_definite(used):
            msg = (
                f'fix at {self.stamp} s: covariance {tuple(self.covariance)} (xx, xy, xt, yy, yt, '
                'tt) is not positive definite: give variances above 0, and correlations below 1'
            )
            raise SignalError(msg)


def position_fix(stamp: float, x: float, y: float, deviation: float) -> Fix:
    """Return a fix without heading whose error is the same in all directions.

    Args:
        stamp: When [s].
        x: Where, in `map` [m].
        y: Where, in `map` [m].
        deviation: Standard deviation of x and of y [m].

    Raises:
        SignalError: A number is not finite, or the deviation is not above zero.

    """
    variance = deviation * abs(deviation)
    return Fix(stamp, x, y, Covariance(variance, 0.0, 0.0, variance, 0.0, 0.0))
