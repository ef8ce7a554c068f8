r"""An arc as a differential drive is told it: angle and *inner* diameter.

The inner wheel rolls on a circle of diameter :math:`d`, the outer one a track :math:`b` further
out, and the middle between them half way:

.. math:: r_{in} = d/2, \quad r_{out} = d/2 + b, \quad r = d/2 + b/2, \qquad
    \rho = r_{in} / r_{out}   \tag{1}

Every wheel goes :math:`|\alpha|` times its radius. The outer one follows ramp, cruise and ramp;
the inner one goes at :math:`\rho` times its speed at every moment, so the ramps stay on the circle.

The sign of the angle is the side of the centre (left positive), the sign of the speed the sense:
an arc to the left driven backwards turns the heading to the right, like a car in reverse.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign

from agv_motion.kinematics.differential import WheelSpeeds
from agv_motion.planar import Pose, Twist, integrate, require_finite
from agv_motion.trajectory.bounds import SPEEDS, require_between, require_ramp
from agv_motion.trajectory.trapezoidal import trapezoid

MOST_ANGLE = 1e9
"""[rad]"""

DIAMETERS, TRACKS = (0.0, 1e9), (1e-6, 1e9)
"""[m]"""


@dataclass(frozen=True)
class Arc:
    """One arc of one robot.

    Raises:
        ConfigurationError: A number is not finite or out of its range.

    """

    angle: float
    """[rad] any number of turns; positive: the centre lies on the left"""
    diameter: float
    """[m] of the inner wheel's circle; 0: pivot on the inner wheel"""
    track: float
    """[m] between the wheels"""
    speed: float
    """[m/s] of the outer wheel; negative: backwards"""
    ramp: float
    """[m/s2] of the outer wheel, speeding up and braking; `NO_RAMP`: at once"""

    def __post_init__(self) -> None:
        """Check every number."""
        require_between('angle', self.angle, (-MOST_ANGLE, MOST_ANGLE), 'rad')
        require_between(
            'diameter', self.diameter, DIAMETERS, 'm', '0 is a pivot on the inner wheel'
        )
        require_between('track', self.track, TRACKS, 'm')
        require_between('speed (without its sign)', abs(self.speed), SPEEDS, 'm/s')
        require_ramp('ramp', self.ramp)

    @property
    def acceleration(self) -> float:
        """Of the ramps of the outer wheel [m/s2]; as good as without end where there are none."""
        return require_ramp('ramp', self.ramp)

    @property
    def backward(self) -> bool:
        """Whether it is driven backwards."""
        return self.speed < 0.0

    @property
    def ratio(self) -> float:
        """Inner over outer wheel, of speeds and of distances; below 1."""
        return 0.5 * self.diameter / (0.5 * self.diameter + self.track)

    @property
    def radius(self) -> float:
        """Of the circle of the middle between the wheels [m]."""
        return 0.5 * (self.diameter + self.track)

    @property
    def outer_distance(self) -> float:
        """What the outer wheel rolls, without sign [m]."""
        return abs(self.angle) * (0.5 * self.diameter + self.track)

    @property
    def length(self) -> float:
        """What the middle between the wheels goes, without sign [m]."""
        return abs(self.angle) * self.radius

    @property
    def share(self) -> float:
        """Speed of the middle over that of the outer wheel."""
        return self.radius / (0.5 * self.diameter + self.track)

    @property
    def turn_rate(self) -> float:
        """Of the heading at full speed, left positive [rad/s]; the ramps are slower."""
        rate = self.speed / (0.5 * self.diameter + self.track)
        return rate if self.angle >= 0.0 else -rate

    @property
    def duration(self) -> float:
        """Time from rest to rest, ramps included [s]."""
        return trapezoid(self.outer_distance, abs(self.speed), self.ramp).duration

    def wheels(self, outer: float) -> WheelSpeeds:
        """Return what both wheels do while the outer one does ``outer`` (speed or distance).

        ``outer`` has no sign; forward wheels are positive, backward ones negative.
        """
        outer = copysign(outer, self.speed)
        inner = self.ratio * outer
        return WheelSpeeds(inner, outer) if self.angle >= 0.0 else WheelSpeeds(outer, inner)

    def end(self, start: Pose) -> Pose:
        """Return where the arc leads from ``start``.

        Raises:
            SignalError: ``start`` is not finite.

        """
        require_finite('start', start)
        turn = self.angle if self.speed >= 0.0 else -self.angle
        return integrate(start, Twist(copysign(self.length, self.speed), 0.0, turn), 1.0)
