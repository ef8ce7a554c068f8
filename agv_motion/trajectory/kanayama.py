r"""The law of Kanayama et al. for a differential drive.

.. math:: v = v_r \cos\theta_e + K_x x_e, \qquad
    \omega = \omega_r + v_r K_y y_e + (|v_r| K_\theta + K_0) \sin\theta_e   \tag{1}

With :math:`V = \frac12 (x_e^2 + y_e^2) + (1 - \cos\theta_e) / K_y`,

.. math:: \dot V = -K_x x_e^2 - (|v_r| K_\theta + K_0) \sin^2\theta_e / K_y \le 0   \tag{2}

for positive gains, the condition of the paper (proposition 1). Small errors die away without
swinging when :math:`K_\theta^2 \ge 4 K_y` (proposition 3). Two things are not in the paper, and (2)
allows both: :math:`|v_r|` for backward drives, and :math:`K_0`, without which the heading would be
left to itself in turns on the spot.

Source: Y. Kanayama, Y. Kimura, F. Miyazaki, T. Noguchi, "A stable tracking control method for an
autonomous mobile robot", Proc. IEEE Int. Conf. Robotics and Automation, 1990.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin, sqrt
from typing import TYPE_CHECKING, Annotated

from agv_motion.parameters import Spec, check
from agv_motion.planar import Twist

if TYPE_CHECKING:
    from agv_motion.trajectory.motion import Speeds
    from agv_motion.trajectory.tracking import TrackingError


@dataclass(frozen=True)
class KanayamaGains:
    """The gains of equation (1); all but the last must be above 0.

    Raises:
        ConfigurationError: One is not.

    """

    along: Annotated[float, Spec('K_x, on the error along', '1/s', (1e-3, 100.0), dynamic=True)] = (
        4.0
    )
    across: Annotated[
        float, Spec('K_y, on the error across', '1/m2', (1e-3, 1e4), dynamic=True)
    ] = 16.0
    heading: Annotated[
        float,
        Spec(
            'K_theta, on the heading; 2 sqrt(K_y) or more does not swing', '1/m', (1e-3, 1e3),
            dynamic=True,
        ),
    ] = 8.0  # fmt: skip
    heading_at_rest: Annotated[
        float,
        Spec('K_0, on the heading even in turns on the spot', '1/s', (0.0, 100.0), dynamic=True),
    ] = 2.0

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)

    @property
    def damping(self) -> float:
        """Of small errors [-]: 1 is critical, less swings, more creeps."""
        return self.heading / (2.0 * sqrt(self.across))


class Kanayama:
    """The law; no state."""

    goes_sideways = False

    def __init__(self, gains: KanayamaGains | None = None) -> None:
        """Keep the gains."""
        self.gains = gains or KanayamaGains()

    def twist(self, error: TrackingError, reference: Speeds) -> Twist:
        """Return the twist of equation (1)."""
        gains, (linear, angular) = self.gains, reference
        return Twist(
            linear * cos(error.heading) + gains.along * error.along,
            0.0,
            angular
            + linear * gains.across * error.across
            + (abs(linear) * gains.heading + gains.heading_at_rest) * sin(error.heading),
        )

    def lyapunov(self, error: TrackingError) -> float:
        """Return V of equation (2) [m2]."""
        square = error.along**2 + error.across**2
        return 0.5 * square + (1.0 - cos(error.heading)) / self.gains.across
