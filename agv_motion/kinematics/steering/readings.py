"""What the turrets measure of themselves: whether it can be, and how it differs from the plan."""

from __future__ import annotations

from math import tau
from typing import TYPE_CHECKING

from agv_motion.errors import SignalError
from agv_motion.planar import wrap

if TYPE_CHECKING:
    from agv_motion.kinematics.steering.state import Setpoints

LOST_TURRET = 0.35
"""[rad] At rest, a turret so far from its command was turned by hand or did not follow: the
planner goes on from where it is."""

MOST_TURNS = 10.0
"""[turns] beyond its limit that a turret can be: it is unwound from there. More is no angle of a
turret, and nobody knows how far its cables are turned."""


class TurretReadings:
    """The angles of the turrets as measured last."""

    def __init__(self) -> None:
        """Know nothing yet."""
        self.angles: list[float] | None = None
        """(n,) [rad]; None while nobody measures them"""
        self.unbelievable = ''
        """why the angles read last cannot be; empty if they can"""

    def update(self, angles: list[float], turn_limit: float) -> None:
        """Take up (n,) ``angles`` [rad].

        Args:
            angles: As they are read.
            turn_limit: How far the cables let a turret turn, either way [turns].

        Raises:
            SignalError: One is no angle of a turret; those before are kept.

        """
        most = (turn_limit + MOST_TURNS) * tau
        for i, angle in enumerate(angles):
            if not abs(angle) <= most:  # also true when NaN
                self.unbelievable = (
                    f'turret {i} stands at {angle:.6g} rad, beyond {most:.4g} rad, which no cable '
                    'allows: look at the encoder and its zero'
                )
                raise SignalError(self.unbelievable)
        self.unbelievable, self.angles = '', angles

    def turns(self, setpoints: Setpoints) -> list[float]:
        """Return the angles, the turns of encoders that wrap counted on from the plan [rad]."""
        measured = self.angles or setpoints.angles
        pairs = zip(setpoints.angles, measured, strict=True)
        return [planned + wrap(angle - planned) for planned, angle in pairs]

    def are_astray(self, setpoints: Setpoints) -> bool:
        """Return whether a turret stands elsewhere than it was told to, and nothing moves."""
        if self.angles is None or any(setpoints.rates):
            return False
        for planned, angle in zip(setpoints.angles, self.angles, strict=True):
            if abs(angle - planned) > LOST_TURRET and abs(wrap(angle - planned)) > LOST_TURRET:
                return True
        return False
