r"""The nonlinear law of Samson, with the gains that De Luca et al. gave it; known as Ramsete.

.. math:: v = v_r \cos\theta_e + k x_e, \qquad
    \omega = \omega_r + k \theta_e + b\, v_r \frac{\sin\theta_e}{\theta_e} y_e, \qquad
    k = \sqrt{4 \zeta^2 (\omega_r^2 + b v_r^2) + k_0^2}   \tag{1}

With :math:`V = \frac{b}{2} (x_e^2 + y_e^2) + \frac12 \theta_e^2`,

.. math:: \dot V = -b k x_e^2 - k \theta_e^2 \le 0   \tag{2}

for :math:`b > 0` and :math:`0 < \zeta < 1`, the condition of the paper. There :math:`k_0 = 0`: the
gain follows the speed alone, so a robot behind a Ghost that waits for it, or has arrived, would
never come up. With :math:`k_0 > 0` it does, and (2), which holds for any positive gain, stays.

Source: A. De Luca, G. Oriolo, M. Vendittelli, "Control of wheeled mobile robots: an experimental
overview", RAMSETE, Springer LNCIS 270, 2001; after C. Samson, "Time-varying feedback
stabilization of car-like wheeled mobile robots", Int. J. Robotics Research 12(1), 1993.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin, sqrt
from typing import TYPE_CHECKING, Annotated

from agv_motion.errors import ConfigurationError
from agv_motion.parameters import Spec, check
from agv_motion.planar import SMALL_ANGLE, Twist

if TYPE_CHECKING:
    from agv_motion.trajectory.motion import Speeds
    from agv_motion.trajectory.tracking import TrackingError


@dataclass(frozen=True)
class RamseteGains:
    """The gains of equation (1).

    Raises:
        ConfigurationError: b is not above 0, or zeta not between 0 and 1.

    """

    b: Annotated[
        float, Spec('stiffness b, as a proportional gain', 'rad2/m2', (1e-3, 1e4), dynamic=True)
    ] = 16.0
    zeta: Annotated[float, Spec('damping zeta, between 0 and 1', '1', (0.0, 1.0), dynamic=True)] = (
        0.9
    )
    at_rest: Annotated[
        float,
        Spec(
            'k_0, on the errors along and of heading, even behind a Ghost that stands', '1/s',
            (0.01, 100.0), dynamic=True,
        ),
    ] = 2.0  # fmt: skip

    def __post_init__(self) -> None:
        """Check every row, and that zeta lies inside its range."""
        check(self)
        if self.zeta in {0.0, 1.0}:
            msg = f'zeta = {self.zeta}: must lie between 0 and 1, neither of them; 0.7 is usual'
            raise ConfigurationError(msg)


class Ramsete:
    """The law; no state."""

    goes_sideways = False

    def __init__(self, gains: RamseteGains | None = None) -> None:
        """Keep the gains."""
        self.gains = gains or RamseteGains()

    def twist(self, error: TrackingError, reference: Speeds) -> Twist:
        """Return the twist of equation (1)."""
        gains, (linear, angular) = self.gains, reference
        along, across, heading = error
        b, damping, at_rest = gains.b, 2.0 * gains.zeta, gains.at_rest
        gain = sqrt(damping**2 * (angular * angular + b * linear * linear) + at_rest**2)
        small = abs(heading) < SMALL_ANGLE
        sinc = 1.0 - heading * heading / 6.0 if small else sin(heading) / heading
        return Twist(
            linear * cos(heading) + gain * along,
            0.0,
            angular + gain * heading + b * linear * sinc * across,
        )

    def lyapunov(self, error: TrackingError) -> float:
        """Return V of equation (2) [rad2]."""
        return 0.5 * (self.gains.b * (error.along**2 + error.across**2) + error.heading**2)
