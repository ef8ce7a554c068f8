"""How far a platform may roll while its turrets are not yet where they should be."""

from __future__ import annotations

from math import cos, inf, isnan, pi
from typing import TYPE_CHECKING

from agv_motion.kinematics.steering.state import Rolling
from agv_motion.planar import wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.steering.state import Phase

SHARE_ROUNDING = 1.0 - 1e-9
"""A wheel that gains more than it may by less than this share does not."""


def rolling_share(angles: Sequence[float], measured: Sequence[float]) -> float:
    """Return the share of its speed with which a platform may roll while its turrets still turn.

    The cosine of the worst error, 0 from a quarter turn on and where one is NaN: all wheels slow
    down by one factor, so a platform at rest steers before it rolls, and turrets under way hardly
    pull against each other.

    Args:
        angles: (n,) commanded steering angles [rad].
        measured: (n,) angles as they are [rad].

    """
    worst = 0.0
    for a, b in zip(angles, measured, strict=True):
        error = abs(a - b)
        if error > pi:
            error = abs(wrap(a - b))
        if not error <= worst:
            if isnan(error):
                return 0.0
            worst = error
    return max(cos(worst), 0.0)


class RollingShare:
    """The share of the planned speeds at which to roll, as the turrets have turned.

    It rises no faster than lets the wheels speed up as they may. It may fall at once: turrets that
    went astray must not be pulled along.
    """

    def __init__(self, count: int) -> None:
        """Stand.

        Args:
            count: Of the wheels.

        """
        self._rolled = [0.0] * count  # (n,) speeds commanded last, without sign [m/s]
        self._most = inf

    def stop(self) -> None:
        """Take note that all wheels stand."""
        self._rolled = [0.0] * len(self._rolled)

    def of(self, phase: Phase | None, measured: Sequence[float] | None) -> float:
        """Return the share for the turrets as they are.

        Args:
            phase: Of the platform; nothing is shared at rest.
            measured: (n,) angles as they are [rad]; None while nobody measures them.

        """
        if measured is None or not isinstance(phase, Rolling):
            return 1.0
        return min(rolling_share(phase.setpoints.angles, measured), self._most)

    def update(self, phase: Phase, measured: Sequence[float] | None, change: float) -> None:
        """Let the share rise so far that no wheel gains more than ``change`` [m/s] in a step."""
        speeds = list(map(abs, phase.setpoints.speeds))
        self._most = inf
        for speed, before in zip(speeds, self._rolled, strict=True):
            if speed * SHARE_ROUNDING > before + change:
                self._most = min(self._most, (before + change) / speed)
        share = self.of(phase, measured)
        self._rolled = [share * speed for speed in speeds]
