r"""The law of a robot that can go sideways: feed-forward and a proportional gain on each error.

.. math:: (v_x, v_y) = v_r (\cos\theta_e, \sin\theta_e) + K_p (x_e, y_e), \qquad
    \omega = \omega_r + K_\theta \theta_e   \tag{1}

Place and heading do not depend on each other: with
:math:`V = \frac12 (x_e^2 + y_e^2 + \theta_e^2)`, :math:`\dot V = -K_p (x_e^2 + y_e^2)
- K_\theta \theta_e^2 < 0` for positive gains, at rest too: every error dies away exponentially.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin
from typing import TYPE_CHECKING, Annotated

from agv_motion.parameters import Spec, check
from agv_motion.planar import Twist

if TYPE_CHECKING:
    from agv_motion.trajectory.motion import Speeds
    from agv_motion.trajectory.tracking import TrackingError


@dataclass(frozen=True)
class HolonomicGains:
    """The two gains of equation (1), above 0.

    Raises:
        ConfigurationError: One is not.

    """

    position: Annotated[
        float, Spec('K_p, on the errors of place', '1/s', (1e-3, 100.0), dynamic=True)
    ] = 4.0
    heading: Annotated[
        float, Spec('K_theta, on the heading', '1/s', (1e-3, 100.0), dynamic=True)
    ] = 4.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class Holonomic:
    """The law; no state."""

    goes_sideways = True

    def __init__(self, gains: HolonomicGains | None = None) -> None:
        """Keep the gains."""
        self.gains = gains or HolonomicGains()

    def twist(self, error: TrackingError, reference: Speeds) -> Twist:
        """Return the twist of equation (1)."""
        gains, (linear, angular) = self.gains, reference
        return Twist(
            linear * cos(error.heading) + gains.position * error.along,
            linear * sin(error.heading) + gains.position * error.across,
            angular + gains.heading * error.heading,
        )

    def lyapunov(self, error: TrackingError) -> float:
        """Return V."""
        return 0.5 * (error.along**2 + error.across**2 + error.heading**2)
