"""How far a robot was from its Ghost, over time; numpy on columns."""

from __future__ import annotations

from math import pi, tau
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from agv_motion.report.run import Poses

    Column = NDArray[np.float64]

LONGEST_GAP = 0.5
"""[s] Over a longer silence of the Ghost it is not interpolated: it was not on its way."""


class Errors(NamedTuple):
    """The Ghost seen from the robot, at the times of the robot; as `trajectory.tracking`."""

    time: Column
    """(n,) [s]"""
    along: Column
    """(n,) [m]"""
    across: Column
    """(n,) [m]"""
    heading: Column
    """(n,) [rad]"""

    @property
    def distance(self) -> Column:
        """(n,) between robot and Ghost [m]."""
        return np.asarray(np.hypot(self.along, self.across))

    def rms(self) -> float:
        """Return the root mean square of the distance [m]."""
        return float(np.sqrt(np.mean(self.distance**2)))


def errors_between(planned: Poses, driven: Poses) -> Errors:
    """Return the errors while the Ghost was on its way."""
    time = driven.time
    after = np.searchsorted(planned.time, time)
    last = len(planned.time) - 1
    before, after = np.clip(after - 1, 0, last), np.clip(after, 0, last)
    inside = (time >= planned.time[0]) & (time <= planned.time[-1])
    inside &= planned.time[after] - planned.time[before] <= LONGEST_GAP
    time = time[inside]
    heading = np.unwrap(planned.pose[:, 2])
    x, y, theta = (
        np.interp(time, planned.time, column)
        for column in (planned.pose[:, 0], planned.pose[:, 1], heading)
    )
    robot = driven.pose[inside]
    dx, dy = x - robot[:, 0], y - robot[:, 1]
    c, s = np.cos(robot[:, 2]), np.sin(robot[:, 2])
    turned = (theta - robot[:, 2] + pi) % tau - pi
    return Errors(time, c * dx + s * dy, c * dy - s * dx, turned)
