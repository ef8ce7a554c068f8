"""What a calibration may change of each kind of base, and what its wheels then say."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import ConfigurationError
from agv_motion.odometry.base import DifferentialBase, OmniBase, TurretBase

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from agv_motion.kinematics.omniwheels import OmniWheels
    from agv_motion.kinematics.turrets import Turrets
    from agv_motion.odometry.covariance import Covariance

Array = NDArray[np.float64]

LENGTH_DOUBT = 0.1
"""[-] Standard deviation of a length before calibration, as a share of it."""
ANGLE_DOUBT = 0.2
"""[rad] Standard deviation of a zero offset before calibration."""


class Unknown(NamedTuple):
    """A number that a calibration estimates."""

    name: str
    unit: str
    nominal: float
    """What the drawing says"""
    doubt: float
    """Standard deviation of the truth about it, before any data"""


class CalibrationModel(Protocol):
    """A base with numbers that are not quite known."""

    unknowns: tuple[Unknown, ...]
    radii: Array
    """(n,) nominal wheel radii [m]"""
    unit_covariance: Covariance
    """Of a displacement when each travel has a variance of 1 m2"""

    def displacement(self, values: Array, turned: Array, steering: Array) -> Array:
        """Return (3, m) displacements [m, m, rad] in the frame of the base.

        Args:
            values: One number for each unknown.
            turned: (n, m) angle by which each wheel turned in each step [rad].
            steering: (n, m) measured steering angles halfway [rad]; not looked at where nothing
                steers.

        """


def _lengths(name: str, nominal: Iterable[float]) -> list[Unknown]:
    """Return one unknown length a wheel."""
    return [
        Unknown(f'{name}_{i}', 'm', float(length), LENGTH_DOUBT * float(length))
        for i, length in enumerate(nominal)
    ]


def _checked_radii(radii: Sequence[float], wheels: int) -> Array:
    array = np.array(radii, dtype=float)
    if array.shape != (wheels,) or not np.all(np.isfinite(array) & (array > 0.0)):
        msg = f'wheel radii {tuple(radii)}: give {wheels} finite numbers above 0 [m]'
        raise ConfigurationError(msg)
    return array


class OmniModel:
    """Omnidirectional wheels: the radius of each, and its distance from the centre."""

    def __init__(self, wheels: OmniWheels, radii: Sequence[float]) -> None:
        """Take the drawing.

        Args:
            wheels: Their nominal placement; directions are taken as exact.
            radii: (n,) nominal wheel radii [m].

        Raises:
            ConfigurationError: The radii are not n finite numbers above 0, or a wheel stands in
                the centre, where its distance is nothing.

        """
        self.radii = _checked_radii(radii, len(wheels))
        distances = [hypot(wheel.x, wheel.y) for wheel in wheels.wheels]
        if min(distances) <= 0.0:
            msg = f'wheels at distances {distances} m: a wheel in the centre has none to calibrate'
            raise ConfigurationError(msg)
        self.unknowns = (*_lengths('radius', self.radii), *_lengths('distance', distances))
        self.unit_covariance = OmniBase(wheels).unit_covariance
        self._matrix = wheels.matrix
        self._distances = np.array(distances)

    def displacement(self, values: Array, turned: Array, steering: Array) -> Array:  # noqa: ARG002
        """Return the least-squares displacements; the lever of a wheel grows with its distance."""
        radii, distances = np.split(values, 2)
        matrix = self._matrix.copy()
        matrix[:, 2] *= distances / self._distances
        fit = np.linalg.solve(matrix.T @ matrix, matrix.T)  # much less work than pinv for so few
        moved: Array = (fit * radii) @ turned
        return moved


class TurretModel:
    """Turrets: the radius of each wheel, and what its steering angle reads too little."""

    def __init__(self, turrets: Turrets, radii: Sequence[float]) -> None:
        """Take the drawing.

        Args:
            turrets: Their positions, taken as exact.
            radii: (n,) nominal wheel radii [m].

        Raises:
            ConfigurationError: The radii are not n finite numbers above 0.

        """
        self.radii = _checked_radii(radii, len(turrets))
        zeros = (Unknown(f'zero_{i}', 'rad', 0.0, ANGLE_DOUBT) for i in range(len(turrets)))
        self.unknowns = (*_lengths('radius', self.radii), *zeros)
        self.unit_covariance = TurretBase(turrets).unit_covariance
        positions = np.array(turrets.positions)
        self._centre = positions.mean(axis=0)
        self._arms = positions - self._centre

    def displacement(self, values: Array, turned: Array, steering: Array) -> Array:
        """Return the least-squares displacements about the centroid, as `Turrets.twist` does."""
        radii, zeros = np.split(values, 2)
        travel, angle = radii[:, None] * turned, steering + zeros[:, None]
        x, y = travel * np.cos(angle), travel * np.sin(angle)
        turn = (self._arms[:, 0] @ y - self._arms[:, 1] @ x) / np.sum(self._arms**2)
        return np.array(
            [
                x.mean(axis=0) + turn * self._centre[1],
                y.mean(axis=0) - turn * self._centre[0],
                turn,
            ]
        )


class DifferentialModel:
    """Two wheels: their radii and the track between them."""

    def __init__(self, track: float, radii: Sequence[float]) -> None:
        """Take the drawing.

        Args:
            track: Nominal distance between the wheels [m].
            radii: (2,) nominal radius left and right [m].

        Raises:
            ConfigurationError: The radii are not two finite numbers above 0.
            GeometryError: The track is not finite and above 0.

        """
        self.radii = _checked_radii(radii, 2)
        self.unit_covariance = DifferentialBase(track).unit_covariance
        left, right = map(float, self.radii)
        self.unknowns: tuple[Unknown, ...] = (
            Unknown('radius_left', 'm', left, LENGTH_DOUBT * left),
            Unknown('radius_right', 'm', right, LENGTH_DOUBT * right),
            Unknown('track', 'm', track, LENGTH_DOUBT * track),
        )

    def displacement(self, values: Array, turned: Array, steering: Array) -> Array:  # noqa: ARG002
        """Return the displacements of the travels left and right."""
        left, right = values[0] * turned[0], values[1] * turned[1]
        return np.array([(left + right) / 2.0, np.zeros_like(left), (right - left) / values[2]])
