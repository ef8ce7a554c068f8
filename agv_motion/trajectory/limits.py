"""What a curve allows: each limit turns curvature into the highest speed along the way.

Each is a small strategy; a planner takes as many as it is given and keeps the lowest.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.trajectory.bezier import Column

STRAIGHT = 1e-12
"""[1/m] Curvatures below this are no bend; it keeps the quotients finite."""


class BendLimit(Protocol):
    """A highest speed for every curvature."""

    @property
    def name(self) -> str:
        """What holds the speed down, in words for a report."""

    def ceiling(self, curvature: Column) -> Column:
        """Return the highest speed [m/s] where the way bends with ``curvature`` [1/m]."""

    def at_joints(self, step: Column) -> Column:
        """Return the highest speed [m/s] where the curvature jumps by ``step`` [1/m]."""


class _BendLimit:
    """A limit that looks at the curvature alone, however it changes."""

    def at_joints(self, step: Column) -> Column:
        """Return no limit."""
        return np.full(len(step), np.inf)


class LateralAcceleration(_BendLimit):
    r"""Nothing topples or slides: :math:`v^2 |\kappa| \le a`."""

    name = 'lateral acceleration'

    def __init__(self, acceleration: float) -> None:
        """Keep a [m/s2].

        Raises:
            ConfigurationError: It is not positive and finite.

        """
        self._acceleration = require_positive('lateral acceleration', acceleration, 'm/s2')

    def ceiling(self, curvature: Column) -> Column:
        """Return sqrt(a / |curvature|)."""
        return np.sqrt(self._acceleration / np.maximum(np.abs(curvature), STRAIGHT))


class TurnRate(_BendLimit):
    r"""The robot turns no faster than it may: :math:`v |\kappa| \le \omega`."""

    name = 'turn rate'

    def __init__(self, rate: float) -> None:
        """Keep omega [rad/s].

        Raises:
            ConfigurationError: It is not positive and finite.

        """
        self._rate = require_positive('turn rate', rate, 'rad/s')

    def ceiling(self, curvature: Column) -> Column:
        """Return omega / |curvature|."""
        return self._rate / np.maximum(np.abs(curvature), STRAIGHT)


class LinearSpeed(_BendLimit):
    r"""The robot drives no faster than it may, in bends and straight on: :math:`v \le v_l`."""

    name = 'linear speed'

    def __init__(self, speed: float) -> None:
        """Keep v_l [m/s].

        Raises:
            ConfigurationError: It is not positive and finite.

        """
        self._speed = require_positive('linear speed', speed, 'm/s')

    def ceiling(self, curvature: Column) -> Column:
        """Return v_l everywhere."""
        return np.full(len(curvature), self._speed)


class WheelSpeed(_BendLimit):
    r"""The outer wheel of a differential drive: :math:`v (1 + |\kappa| b / 2) \le v_w`."""

    name = 'wheel speed'

    def __init__(self, speed: float, track: float) -> None:
        """Keep the limit of a wheel [m/s] and the track b [m].

        Raises:
            ConfigurationError: One of them is not positive and finite.

        """
        self._speed = require_positive('wheel speed', speed, 'm/s')
        self._half_track = 0.5 * require_positive('track', track, 'm')

    def ceiling(self, curvature: Column) -> Column:
        """Return v_w / (1 + |curvature| b / 2)."""
        return self._speed / (1.0 + self._half_track * np.abs(curvature))


class TurnStep:
    r"""Where two curves meet, the turn rate jumps no further than :math:`v |\Delta\kappa|`."""

    name = 'jump of curvature'

    def __init__(self, step: float) -> None:
        """Keep the largest jump of the turn rate [rad/s].

        Raises:
            ConfigurationError: It is not positive and finite.

        """
        self.step = require_positive('turn step', step, 'rad/s')

    def ceiling(self, curvature: Column) -> Column:
        """Return no limit: within a curve nothing jumps."""
        return np.full(len(curvature), np.inf)

    def at_joints(self, step: Column) -> Column:
        """Return the jump allowed over that of the curvature."""
        return self.step / np.maximum(np.abs(step), STRAIGHT)


def require_positive(name: str, value: float, unit: str) -> float:
    """Return ``value`` if it is positive and finite.

    Raises:
        ConfigurationError: It is not; the message names it.

    """
    if not 0.0 < value < float('inf'):
        msg = f'{name} = {value} {unit}: must be positive and finite'
        raise ConfigurationError(msg)
    return value


def lowest_ceiling(limits: Sequence[BendLimit], curvature: Column, cruising_speed: float) -> Column:
    """Return the highest speed that all ``limits`` and ``cruising_speed`` [m/s] allow."""
    ceiling = np.full(len(curvature), cruising_speed)
    for limit in limits:
        ceiling = np.minimum(ceiling, limit.ceiling(curvature))
    return ceiling


def joint_ceiling(limits: Sequence[BendLimit], step: Column) -> Column:
    """Return the highest speed that all ``limits`` allow where the curvature jumps by ``step``."""
    ceiling = np.full(len(step), np.inf)
    for limit in limits:
        ceiling = np.minimum(ceiling, limit.at_joints(step))
    return ceiling
