"""A position fix: where an outside system (UWB, GNSS, a camera) saw the robot at some time."""

from __future__ import annotations

from dataclasses import dataclass

from agv_motion.odometry.covariance import Covariance
from agv_motion.odometry.gates import (
    MAX_COORDINATE,
    MAX_HEADING,
    MAX_STAMP,
    require_measurement,
    require_within,
)
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
            SignalError: A number is not finite or beyond its gate, or the covariance is none.

        """
        require_finite('fix (stamp, x, y)', (self.stamp, self.x, self.y))
        name = f'fix at {self.stamp} s'
        require_within(name, (self.x, self.y), MAX_COORDINATE, 'm', 'give it in the map')
        require_within('stamp of a fix', (self.stamp,), MAX_STAMP, 's', 'look at its clock')
        if self.heading is not None:
            require_finite('heading of a fix', (self.heading,))
            require_within('heading of a fix', (self.heading,), MAX_HEADING, 'rad', 'mend it')
        require_measurement(name, self.covariance, heading=self.heading is not None)


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
