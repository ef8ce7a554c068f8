"""A straight way as a curve by its own length: it needs no table."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from agv_motion.trajectory.bezier import Column

FLAT, FLAT_MIDDLE = np.zeros(2), np.zeros(1)
FLAT.flags.writeable = FLAT_MIDDLE.flags.writeable = False


class Line:
    """The way from one point to another, by its length.

    Attributes:
        length: [m].
        way: (2,) its two ends [m].
        curvature: (2,) zeros [1/m].
        middle_way: (1,) [m].
        middle_curvature: (1,) zero [1/m].

    """

    curvature: Column = FLAT
    middle_curvature: Column = FLAT_MIDDLE

    def __init__(self, start: complex, end: complex) -> None:
        """Join two points that do not coincide, x + iy [m]."""
        self.length = abs(end - start)
        self._start, self._tangent = start, (end - start) / self.length
        self.way: Column = np.array([0.0, self.length])
        self.middle_way: Column = np.array([0.5 * self.length])

    def locate(self, way: float) -> tuple[Line, float]:
        """Return the curve and its parameter, which is the way itself."""
        return self, way

    def point(self, way: float) -> complex:
        """Return the point after ``way`` [m]."""
        return self._start + self._tangent * way

    def velocity(self, _: float) -> complex:
        """Return the unit tangent."""
        return self._tangent

    def acceleration(self, _: float) -> complex:
        """Return zero: the tangent does not change."""
        return 0j
