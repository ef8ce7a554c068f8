"""What odometry asks of a base, and the three kinds that answer: omni, turrets, differential."""

from __future__ import annotations

from math import isfinite, sqrt
from typing import TYPE_CHECKING, Protocol

import numpy as np

from agv_motion.errors import GeometryError, SignalError
from agv_motion.odometry.covariance import Covariance, shift
from agv_motion.planar import require_finite

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from agv_motion.kinematics.omniwheels import OmniWheels
    from agv_motion.kinematics.turrets import Turrets


Fit = tuple[float, float, float, float]
"""Displacement [m, m, rad] and residual [m]."""


class Base(Protocol):
    """A base whose wheels tell how far it went."""

    unit_covariance: Covariance
    """Of the fitted displacement, in the base frame, when each travel has a variance of 1 m2"""
    steers: bool
    """Whether the wheels have steering angles of their own"""
    measuring: int
    """How many wheels are looked at"""
    redundancy: int
    """How many measurements there are beyond the unknowns: what the residual can tell"""

    def __len__(self) -> int:
        """Return the number of wheels."""

    def displacement(self, travel: Sequence[float], steering: Sequence[float]) -> Fit:
        """Return the displacement that fits the travel of the wheels best.

        Args:
            travel: (n,) distance that each wheel rolled [m].
            steering: (n,) steering angle halfway [rad]; empty where wheels do not steer.

        Returns:
            The displacement along x [m], along y [m] and in heading [rad], of constant twist; and
            the root mean square over the wheels of the travel it leaves unexplained [m].

        Raises:
            SignalError: A wrong number of values, or one that is not finite.

        """


class OmniBase:
    """A base on omnidirectional wheels; wheels known to be faulty can be left out."""

    def __init__(self, wheels: OmniWheels, missing: Collection[int] = ()) -> None:
        """Work out how well the wheels that are left determine the displacement.

        Raises:
            SignalError: They do not determine it.

        """
        self.steers = False
        self._wheels = wheels
        self._missing = frozenset(missing)
        wheels.twist([0.0] * len(wheels), self._missing)
        matrix = np.delete(wheels.matrix, list(self._missing), axis=0)
        spread = np.linalg.inv(matrix.T @ matrix)
        self.unit_covariance = Covariance(*map(float, spread[np.triu_indices(3)]))
        self.measuring = len(matrix)
        self.redundancy = len(matrix) - 3

    def __len__(self) -> int:
        """Return the number of wheels."""
        return len(self._wheels)

    def displacement(self, travel: Sequence[float], steering: Sequence[float]) -> Fit:  # noqa: ARG002
        """Return the least-squares displacement; there is nothing to steer."""
        return self._wheels.solve(travel, self._missing)


class TurretBase:
    """A base on steered wheels: each tells two things, its travel and that it did not skid."""

    def __init__(self, turrets: Turrets) -> None:
        """Work out how well the turrets determine the displacement.

        About their centroid the least-squares fit is diagonal: the mean of the travels, and a
        turn that their distances from it hold.
        """
        self.steers = True
        self.turrets = turrets
        n = len(turrets)
        x = sum(x for x, _ in turrets.positions) / n
        y = sum(y for _, y in turrets.positions) / n
        spread = sum((tx - x) ** 2 + (ty - y) ** 2 for tx, ty in turrets.positions)
        at_centroid = Covariance(1.0 / n, 0.0, 0.0, 1.0 / n, 0.0, 1.0 / spread)
        self.unit_covariance = shift(at_centroid, -x, -y)
        self.arm = 1.0 / sqrt(n * at_centroid.tt)
        """root mean square of the distances of the turrets from their centroid [m]"""
        self.measuring = n
        self.redundancy = 2 * n - 3

    def __len__(self) -> int:
        """Return the number of turrets."""
        return len(self.turrets)

    def displacement(self, travel: Sequence[float], steering: Sequence[float]) -> Fit:
        """Return the least-squares displacement."""
        return self.turrets.solve(steering, travel)


class DifferentialBase:
    """A base on two fixed wheels, left and right; nothing tells whether it skids sideways."""

    def __init__(self, track: float) -> None:
        """Keep the distance between the wheels.

        Args:
            track: [m], larger than zero; with a track multiplier, the effective one.

        Raises:
            GeometryError: It is not.

        """
        if not (isfinite(track) and track > 0.0):
            msg = f'track = {track} m: must be finite and above 0, measure between the wheels'
            raise GeometryError(msg)
        self.steers = False
        self._track = track
        # sideways, where nothing is measured, as uncertain as forward
        self.unit_covariance = Covariance(0.5, 0.0, 0.0, 0.5, 0.0, 2.0 / (track * track))
        self.measuring = 2
        self.redundancy = 0

    def __len__(self) -> int:
        """Return two."""
        return 2

    def displacement(self, travel: Sequence[float], steering: Sequence[float]) -> Fit:  # noqa: ARG002
        """Return the displacement of the travels left and right [m].

        Raises:
            SignalError: There are not two of them, or one is not finite.

        """
        if len(travel) != 2:
            msg = f'{len(travel)} travels for 2 wheels: give left and right'
            raise SignalError(msg)
        left, right = travel
        require_finite('wheel travels', (left, right))
        return (left + right) / 2.0, 0.0, (right - left) / self._track, 0.0
