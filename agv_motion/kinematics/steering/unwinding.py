"""When the cables of a platform at rest are unwound: when asked, or after a long rest."""

from __future__ import annotations

from math import degrees, pi
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from agv_motion.kinematics.steering.state import Setpoints

QUARTER = pi / 2.0
"""[rad] A turret turned further from straight, either way, can be unwound by half turns."""


class Unwinding:
    """Keeps in mind that the cables are being unwound, and how long the platform has rested."""

    def __init__(self, after: float) -> None:
        """Unwind nothing yet.

        Args:
            after: Rest after which turned cables are unwound; 0: never by itself [s].

        """
        self.asked = False
        """whether the cables are being unwound, until that is done"""
        self._after = after
        self._rested = 0.0

    def is_due(self, setpoints: Setpoints, elapsed: float, *, wanted: bool) -> bool:
        """Let ``elapsed`` [s] pass; return whether to unwind: as asked, or after a long rest.

        Args:
            setpoints: How far the turrets are turned.
            elapsed: Since the last call [s].
            wanted: Whether some motion is wanted.

        """
        self._rested = 0.0 if wanted else self._rested + elapsed
        return self.asked or (0.0 < self._after < self._rested and is_wound(setpoints))


def is_wound(setpoints: Setpoints) -> bool:
    """Return whether a turret is turned so far that it can be unwound."""
    return max(setpoints.angles) > QUARTER or min(setpoints.angles) < -QUARTER


def describe(setpoints: Setpoints) -> str:
    """Return in words what is unwound."""
    furthest = max(setpoints.angles, key=abs)
    return f'unwinding, the furthest turret by {degrees(pi * round(furthest / pi)):.0f} deg'
