"""Radio localisation (UWB) with everything that it does in buildings: seeded.

White noise, gross outliers, multipath (a wrong but steady place for a while), drop-outs, and a
delay of its own for each fix, so that they come late and out of order.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from heapq import heappop, heappush
from math import cos, pi, sin
from typing import TYPE_CHECKING, Annotated

from agv_motion.odometry.covariance import Covariance
from agv_motion.odometry.fix import Fix
from agv_motion.parameters import Spec, check
from agv_motion.planar import wrap

if TYPE_CHECKING:
    from agv_motion.planar import Pose


@dataclass(frozen=True)
class UwbParameters:
    """How good the fixes are, and what befalls them."""

    rate: Annotated[float, Spec('fixes per second', 'Hz', (0.01, 100.0))] = 1.0
    position_noise: Annotated[
        float, Spec('standard deviation of x and of y', 'm', (0.001, 10.0))
    ] = 0.15
    heading_noise: Annotated[
        float, Spec('standard deviation of the heading; 0: one tag, no heading', 'rad', (0.0, 3.0))
    ] = 0.0
    latency: Annotated[float, Spec('a fix comes late by up to this', 's', (0.0, 10.0))] = 0.0
    outlier_share: Annotated[float, Spec('fixes that are nowhere near', '1', (0.0, 1.0))] = 0.0
    outlier_reach: Annotated[float, Spec('how far these go astray', 'm', (0.0, 1e3))] = 5.0
    multipath_interval: Annotated[
        float, Spec('mean time between spells of multipath; 0: never', 's', (0.0, 1e7))
    ] = 0.0
    multipath_duration: Annotated[float, Spec('mean length of a spell', 's', (0.1, 1e5))] = 4.0
    multipath_reach: Annotated[float, Spec('largest shift during a spell', 'm', (0.0, 1e3))] = 2.0
    dropout_interval: Annotated[
        float, Spec('mean time between drop-outs; 0: never', 's', (0.0, 1e7))
    ] = 0.0
    dropout_duration: Annotated[float, Spec('length of a drop-out', 's', (0.1, 1e5))] = 300.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    def covariance(self) -> Covariance:
        """Return what the system says of its own noise."""
        variance = self.position_noise**2
        return Covariance(variance, 0.0, 0.0, variance, 0.0, self.heading_noise**2)


class _Spells:
    """When something happens that comes at random and lasts a while."""

    def __init__(self, chance: random.Random, interval: float, begin: float) -> None:
        """Let nothing happen yet; ``interval`` [s] is the mean time between, 0: never."""
        self._random, self._mean = chance, interval
        self.end = 0.0
        """of the present or the last one [s]"""
        self.next = begin + self._interval()
        """when the next one begins [s]"""

    def last_until(self, end: float) -> None:
        """Begin one that ends at ``end`` [s]."""
        self.end = end
        self.next = end + self._interval()

    def _interval(self) -> float:
        return self._random.expovariate(1.0 / self._mean) if self._mean > 0.0 else float('inf')


class Uwb:
    """The localisation system: sees the robot now, tells of it later."""

    def __init__(self, parameters: UwbParameters, seed: int, begin: float = 0.0) -> None:
        """Start the sequence of noise that belongs to ``seed``, at time ``begin`` [s]."""
        self._given = parameters
        self._random = random.Random(seed)  # noqa: S311 - a simulation, no secret
        self._on_the_way: list[tuple[float, int, Fix]] = []
        self._measured = 0
        self._shift = 0.0, 0.0
        self._multipath = _Spells(self._random, parameters.multipath_interval, begin)
        self._dropouts = _Spells(self._random, parameters.dropout_interval, begin)

    def measure(self, time: float, pose: Pose) -> None:
        """See the robot at ``pose``, at a time [s] later than before."""
        given, chance = self._given, self._random
        self._befall(time)
        self._measured += 1
        x, y = chance.gauss(0.0, given.position_noise), chance.gauss(0.0, given.position_noise)
        if chance.random() < given.outlier_share:
            x, y = (chance.uniform(-given.outlier_reach, given.outlier_reach) for _ in range(2))
        heading = None
        if given.heading_noise > 0.0:
            heading = wrap(pose.theta + chance.gauss(0.0, given.heading_noise))
        if time < self._dropouts.end:
            return
        x, y = x + self._shift[0], y + self._shift[1]
        fix = Fix(time, pose.x + x, pose.y + y, given.covariance(), heading)
        arrival = time + chance.uniform(0.0, given.latency)
        heappush(self._on_the_way, (arrival, self._measured, fix))

    def arrivals(self, time: float) -> list[Fix]:
        """Return the fixes that have come by ``time`` [s] and were not returned before."""
        come = []
        while self._on_the_way and self._on_the_way[0][0] <= time:
            come.append(heappop(self._on_the_way)[2])
        return come

    def _befall(self, time: float) -> None:
        """Begin and end spells of multipath and drop-outs."""
        given = self._given
        if time >= self._dropouts.next:
            self._dropouts.last_until(time + given.dropout_duration)
        if time >= self._multipath.next:
            duration = self._random.expovariate(1.0 / given.multipath_duration)
            self._multipath.last_until(time + duration)
            reach, direction = self._random.uniform(0.0, given.multipath_reach), self._direction()
            self._shift = reach * cos(direction), reach * sin(direction)
        elif time >= self._multipath.end:
            self._shift = 0.0, 0.0

    def _direction(self) -> float:
        return self._random.uniform(-pi, pi)
