"""The way of an arc as a curve by its own length: where a Bezier needs a table, this needs none."""

from __future__ import annotations

from cmath import exp, rect
from math import copysign, sin
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from agv_motion.planar import Pose
    from agv_motion.trajectory.arc import Arc
    from agv_motion.trajectory.bezier import Column


class Circle:
    """The way of an arc as a curve by its length, for a drive along it: no table is needed.

    Attributes:
        length: [m].
        way: (2,) its two ends [m].
        middle_way: (1,) [m].

    """

    def __init__(self, arc: Arc, start: Pose) -> None:
        """Leave ``start``."""
        self.length = arc.length
        self._start = complex(start.x, start.y)
        self._tangent = rect(copysign(1.0, arc.speed), start.theta)
        self._curvature = copysign(1.0 / arc.radius, arc.angle * arc.speed)
        self.way: Column = np.array([0.0, arc.length])
        self.middle_way: Column = np.array([0.5 * arc.length])

    @property
    def curvature(self) -> Column:
        """(2,) at the ends, left positive [1/m]."""
        return np.full(2, self._curvature)

    @property
    def middle_curvature(self) -> Column:
        """(1,) in the middle [1/m]."""
        return np.full(1, self._curvature)

    def locate(self, way: float) -> tuple[Circle, float]:
        """Return the curve and its parameter, which is the way itself."""
        return self, way

    def point(self, way: float) -> complex:
        """Return the point after ``way`` [m], by its chord."""
        half = 0.5 * self._curvature * way
        chord = 2.0 * sin(half) / self._curvature
        return self._start + self._tangent * chord * exp(1j * half)

    def velocity(self, way: float) -> complex:
        """Return the unit tangent."""
        return self._tangent * exp(1j * self._curvature * way)

    def acceleration(self, way: float) -> complex:
        """Return the change of the tangent over the way [1/m]."""
        return 1j * self._curvature * self.velocity(way)
