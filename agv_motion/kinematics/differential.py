r"""Two fixed wheels side by side, left and right: both maps between twist and wheels.

With the track :math:`b` between the wheels,

.. math:: v_l = v - \tfrac{b}{2}\,\omega, \quad v_r = v + \tfrac{b}{2}\,\omega; \qquad
    v = \tfrac12 (v_l + v_r), \quad \omega = (v_r - v_l) / b   \tag{1}

Wide tyres turn as if they stood elsewhere: the track multiplier makes the effective track of the
measured one. Wheels are never quite equal, so each has its own radius.

Source: G. Dudek, M. Jenkin, "Computational Principles of Mobile Robotics", 2nd ed., 2010, 3.1.6.
"""

from __future__ import annotations

from math import isfinite
from sys import float_info
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import GeometryError, SignalError
from agv_motion.kinematics.speed_limit import require_wheel_speed
from agv_motion.planar import STANDSTILL, Twist, require_finite

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.differential_platform import DifferentialBaseParameters


class WheelSpeeds(NamedTuple):
    """What the two wheels do: rim speeds [m/s], travels [m] or rates [rad/s]."""

    left: float
    right: float


class DifferentialCommand(NamedTuple):
    """What to tell the two motors."""

    speed: WheelSpeeds
    """[m/s] at the rims"""
    scale: float
    """[-] in (0, 1]: the factor by which the twist was reduced to hold the wheel speed limit"""


class DifferentialDrive:
    """One base: the track and the radii of its two wheels."""

    def __init__(
        self, track: float, wheel_radii: Sequence[float], track_multiplier: float = 1.0
    ) -> None:
        """Keep the geometry.

        Args:
            track: Distance between the middles of the wheels [m].
            wheel_radii: (2,) rolling radii, left and right [m].
            track_multiplier: Effective track over measured track [-]; from a calibration.

        Raises:
            GeometryError: One of them is not finite and above 0, or there are not two radii.

        """
        if len(wheel_radii) != 2:
            msg = f'{len(wheel_radii)} wheel_radii for 2 wheels: give left and right [m]'
            raise GeometryError(msg)
        self.radii = WheelSpeeds(*map(float, wheel_radii))
        named = (
            ('track', track, ' m'),
            ('left wheel radius', self.radii.left, ' m'),
            ('right wheel radius', self.radii.right, ' m'),
            ('track_multiplier', track_multiplier, ''),
        )
        for name, value, unit in named:
            if not (isfinite(value) and value > 0.0):
                msg = f'{name} = {value}{unit}: must be finite and above 0'
                raise GeometryError(msg)
        self.track = track * track_multiplier
        """[m] effective"""

    @classmethod
    def of(cls, base: DifferentialBaseParameters) -> DifferentialDrive:
        """Return the drive of a base as it was declared."""
        return cls(base.track, base.wheel_radii, base.track_multiplier)

    def __len__(self) -> int:
        """Return two."""
        return 2

    @property
    def matrix(self) -> tuple[tuple[float, float, float], ...]:
        """(2, 3) rim speeds [m/s] of unit vx, vy and wz."""
        half = 0.5 * self.track
        return (1.0, 0.0, -half), (1.0, 0.0, half)

    def command(self, twist: Twist, max_wheel_speed: float = float_info.max) -> DifferentialCommand:
        """Return the rim speeds for ``twist`` by equation (1).

        When a wheel would exceed its limit both are scaled by one factor, so the base stays on
        its arc and only takes longer.

        Args:
            twist: Wanted velocity of the middle between the wheels.
            max_wheel_speed: Limit of each wheel [m/s].

        Raises:
            SignalError: ``twist`` is not finite, or goes sideways, which these wheels cannot.
            ConfigurationError: ``max_wheel_speed`` is not above 0.

        """
        vx, vy, wz = twist
        across = 0.5 * self.track * wz
        left, right = vx - across, vx + across
        if not (isfinite(left) and isfinite(right) and isfinite(vy)):
            require_finite('twist', twist)
            require_finite('wheel speeds', (left, right))
        if abs(vy) > STANDSTILL:
            msg = f'vy = {vy} m/s: a differential drive cannot go sideways, give vx and wz only'
            raise SignalError(msg)
        fastest = max(abs(left), abs(right))
        if not fastest <= max_wheel_speed:  # also true when it is NaN
            require_wheel_speed(max_wheel_speed)
            scale = max_wheel_speed / fastest
            return DifferentialCommand(WheelSpeeds(scale * left, scale * right), scale)
        return DifferentialCommand(WheelSpeeds(left, right), 1.0)

    def twist(self, speeds: Sequence[float]) -> Twist:
        """Return the twist of rim speeds left and right [m/s]; of travels [m], the displacement.

        Raises:
            SignalError: There are not two, or one or what comes of them is not finite.

        """
        left, right = self._two('wheel speeds', speeds)
        twist = Twist(0.5 * (left + right), 0.0, (right - left) / self.track)
        require_finite(f'the twist of wheel speeds {(left, right)}', twist)
        return twist

    def rates(self, speeds: Sequence[float]) -> WheelSpeeds:
        """Return the rates [rad/s] of wheels whose rims go at ``speeds`` [m/s].

        Raises:
            SignalError: There are not two, or one or what comes of them is not finite.

        """
        left, right = self._two('wheel speeds', speeds)
        rates = WheelSpeeds(left / self.radii.left, right / self.radii.right)
        require_finite(f'the rates of wheel speeds {(left, right)}', rates)
        return rates

    def speeds(self, rates: Sequence[float]) -> WheelSpeeds:
        """Return the rim speeds [m/s] of wheels that turn at ``rates`` [rad/s].

        Raises:
            SignalError: There are not two, or one or what comes of them is not finite.

        """
        left, right = self._two('wheel rates', rates)
        speeds = WheelSpeeds(left * self.radii.left, right * self.radii.right)
        require_finite(f'the speeds of wheel rates {(left, right)}', speeds)
        return speeds

    @staticmethod
    def _two(name: str, values: Sequence[float]) -> tuple[float, float]:
        if len(values) != 2:
            msg = f'{len(values)} {name} for 2 wheels: give left and right'
            raise SignalError(msg)
        left, right = values
        if not (isfinite(left) and isfinite(right)):
            require_finite(name, (left, right))
        return left, right
