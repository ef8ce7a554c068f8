"""Watches four or more omnidirectional wheels over the last seconds of motion for a faulty one."""

from __future__ import annotations

from collections import deque
from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.odometry.wheel_fault import WheelDiagnosis, diagnose_wheels

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.omniwheels import OmniWheels
    from agv_motion.odometry.parameters import OdometryParameters

SPAN = 0.5
"""[s] of travel that make one instant for the diagnosis: enough to stand out from noise."""
INSTANTS = 40
"""Instants that are kept: 20 s of motion."""
ENOUGH = 8
"""Instants from which on a diagnosis is given."""
TOLERANCE = 0.05
"""[-] Share of its travel by which a sound wheel may be wrong: no radius is exact."""
SOUND = WheelDiagnosis(consistent=True, suspects=())


class WheelMonitor:
    """Collects travels and diagnoses them, in units of the noise that belongs to each."""

    def __init__(
        self, wheels: OmniWheels, wheel_radii: Sequence[float], parameters: OdometryParameters
    ) -> None:
        """Start with nothing seen; the arguments are those of the odometry."""
        self._wheels = wheels
        self._radii = np.array(wheel_radii)
        self._given = parameters
        self._columns: deque[np.ndarray[tuple[int], np.dtype[np.float64]]] = deque(maxlen=INSTANTS)
        self._begin: tuple[float, Sequence[float]] | None = None

    def add(self, stamp: float, angles: Sequence[float | None]) -> None:
        """Take a reading (n,) of the encoders [rad]; one that lacks a wheel begins anew."""
        known = [angle for angle in angles if angle is not None]
        if len(known) < len(angles) or self._begin is None:
            self._begin = (stamp, known) if len(known) == len(angles) else None
            return
        begun, before = self._begin
        if 0.0 <= stamp - begun < SPAN:
            return
        self._begin = stamp, known
        if not 0.0 < stamp - begun < 2.0 * SPAN:
            return
        travel = (np.array(known) - before) * self._radii
        usual = float(np.mean(np.abs(travel)))
        given = self._given
        if usual > given.max_wheel_speed * (stamp - begun):  # an encoder began again
            return
        tick = given.encoder_resolution * float(self._radii.max())
        noise = sqrt(given.wheel_noise**2 * usual + (TOLERANCE * usual) ** 2 + tick * tick / 6.0)
        if usual > 2.0 * tick:
            self._columns.append(travel / noise)

    def diagnosis(self) -> WheelDiagnosis:
        """Return whether the wheels agree with one another, and which one does not."""
        if len(self._wheels) < 4 or len(self._columns) < ENOUGH:
            return SOUND
        return diagnose_wheels(self._wheels, np.array(self._columns).T, 1.0)
