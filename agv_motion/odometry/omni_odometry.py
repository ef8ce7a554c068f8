"""Odometry of omnidirectional wheels that does without those that are missing or faulty.

A wheel left out takes nothing from the others as long as three that can tell a twist are left. In
the step in which a wheel comes back its encoder may stand anywhere, so it counts from the next.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from agv_motion.errors import SignalError
from agv_motion.odometry.base import OmniBase
from agv_motion.odometry.wheel_odometry import WheelOdometry
from agv_motion.planar import require_finite

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.omniwheels import OmniWheels
    from agv_motion.odometry.continuity import Succession
    from agv_motion.odometry.parameters import OdometryParameters


class OmniOdometry:
    """Wheel odometry to which some wheels may be unknown at times."""

    def __init__(
        self, wheels: OmniWheels, wheel_radii: Sequence[float], parameters: OdometryParameters
    ) -> None:
        """Start at the origin with all wheels.

        Args:
            wheels: Where they are.
            wheel_radii: (n,) rolling radius of each [m].
            parameters: How far they can be trusted.

        Raises:
            ConfigurationError: The radii are not n finite numbers above zero.

        """
        self._wheels = wheels
        self._whole = frozenset[int]()
        self._bases = {self._whole: OmniBase(wheels)}
        self.reckoning = WheelOdometry(self._bases[self._whole], wheel_radii, parameters)
        """The odometry itself: pose, twist, residual, covariance"""
        self.faulty: frozenset[int] = frozenset()
        """Wheels that measure but are not to be believed"""
        self._silent: frozenset[int] = frozenset()
        self._last: list[float] = []

    @property
    def left_out(self) -> frozenset[int]:
        """Wheels that the last reading did without."""
        return self._silent | self.faulty

    def update(
        self, stamp: float, angles: Sequence[float | None], *, by_rate: bool = False
    ) -> Succession:
        """Take a reading; None stands for a wheel of which nothing is known.

        Args:
            stamp: Time of the reading [s].
            angles: (n,) angle of each wheel [rad].
            by_rate: Whether some are added-up rates, which tell nothing of what was not seen.

        Returns:
            What the reading was good for.

        Raises:
            SignalError: The wheels that are left cannot tell the motion, a wrong number of values,
                or one that is not finite; nothing has changed.

        """
        silent = frozenset(i for i, angle in enumerate(angles) if angle is None)
        if silent and len(self._last) != len(angles):
            msg = f'wheels {sorted(silent)} are missing in the first reading: all must begin'
            raise SignalError(msg)
        known = [self._last[i] if a is None else a for i, a in enumerate(angles)]
        require_finite('wheel angles', tuple(known))
        returned = self._silent - silent
        self.reckoning.use(self._base(silent | returned | self.faulty))
        if returned and stamp > (self.reckoning.stamp or stamp):
            self.reckoning.set_angles({i: known[i] for i in returned})
        step = self.reckoning.update(stamp, known, by_rate=by_rate)
        if step.used:
            self._last, self._silent = known, silent
        return step

    def _base(self, missing: frozenset[int]) -> OmniBase:
        if missing not in self._bases:
            self._bases[missing] = OmniBase(self._wheels, missing)
        return self._bases[missing]
