r"""Steered wheels (turrets) of a rigid body: twist <-> angle and speed of each, any number >= 2.

The centre of wheel :math:`i`, at :math:`(x_i, y_i)` in the base frame, moves with the body at

.. math:: v_i = (v_x - \omega y_i,\; v_y + \omega x_i)

and rolls without slipping when it points along :math:`v_i`. All wheel axes then meet in one
instantaneous centre of rotation (ICR).

Source: G. Campion, G. Bastin, B. d'Andrea-Novel, "Structural properties and classification of
kinematic and dynamic models of wheeled mobile robots", IEEE Trans. Robot. Autom. 12(1), 1996.
"""

from __future__ import annotations

from math import atan2, cos, hypot, isfinite, sin, sqrt
from sys import float_info
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from agv_motion.errors import GeometryError, SignalError
from agv_motion.kinematics.elementwise import elementwise
from agv_motion.kinematics.polar_positions import polar_positions
from agv_motion.kinematics.speed_limit import require_wheel_speed
from agv_motion.kinematics.twist_fit import TwistFit
from agv_motion.planar import STANDSTILL, Twist, require_finite

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from agv_motion.kinematics.platform import PlatformParameters

    Column = NDArray[np.float64]
    T = TypeVar('T', float, Column)


class TurretCommand(NamedTuple):
    """What each turret must do, in the order of the turrets."""

    angle: list[float]
    """(n,) [rad] steering angle from the x axis of the base frame"""
    speed: list[float]
    """(n,) [m/s] rolling speed along that angle"""
    scale: float
    """[-] in (0, 1]: the factor by which the twist was reduced to hold the wheel speed limit"""


class Turrets:
    """The turrets of one platform: where they are, and both maps between twist and wheels."""

    def __init__(self, positions: Sequence[tuple[float, float]]) -> None:
        """Keep the turret centres and factor the least-squares fit once.

        Args:
            positions: (n, 2) turret centres in the base frame [m].

        Raises:
            GeometryError: Fewer than two turrets, a coordinate not finite, or all turrets at one
                point (then a rotation cannot be told from a translation).

        """
        self.positions = tuple((float(x), float(y)) for x, y in positions)
        n = len(self.positions)
        if n < 2:
            msg = f'{n} turret(s) given, at least 2 are needed: list the x and y of every turret'
            raise GeometryError(msg)
        self._straight = (0.0,) * n
        self._centre_x = sum(x for x, _ in self.positions) / n
        self._centre_y = sum(y for _, y in self.positions) / n
        arms = [(x - self._centre_x, y - self._centre_y) for x, y in self.positions]
        self._spread = sum(x * x + y * y for x, y in arms)
        if not isfinite(self._spread):
            msg = f'turret positions must be finite, got {self.positions}: measure them in metres'
            raise GeometryError(msg)
        if self._spread < 1e-12:
            msg = f'all {n} turrets stand at {self.positions[0]}: set them apart'
            raise GeometryError(msg)

    @classmethod
    def of(cls, platform: PlatformParameters) -> Turrets:
        """Return the turrets of a platform as it was declared.

        Raises:
            ConfigurationError: A turret stands outside the rim.
            GeometryError: What the constructor refuses.

        """
        return cls(platform.turret_positions())

    @classmethod
    def from_polar(cls, angles: Sequence[float], distances: Sequence[float]) -> Turrets:
        """Return the turrets that stand at polar positions from the centre of the base frame.

        Args:
            angles: (n,) from the x axis [rad].
            distances: (n,) from the centre [m].

        Raises:
            GeometryError: The lengths differ, or what the constructor refuses.

        """
        return cls(polar_positions('turret', angles, distances))

    def __len__(self) -> int:
        """Return the number of turrets."""
        return len(self.positions)

    def command(
        self,
        twist: Twist,
        held_angles: Sequence[float] | None = None,
        max_wheel_speed: float = float_info.max,
    ) -> TurretCommand:
        """Return angle and speed of each turret for ``twist``, the ICR kept.

        When a wheel would exceed its limit the whole twist is scaled by one factor, which leaves
        the ICR where it is. A wheel at standstill keeps its angle.

        Args:
            twist: Wanted velocity of the base frame.
            held_angles: (n,) present steering angles [rad], for wheels asked to stand still;
                straight by default.
            max_wheel_speed: Limit of every wheel [m/s].

        Raises:
            SignalError: ``twist`` or an angle that is held is not finite, or ``held_angles`` has
                another length.
            ConfigurationError: ``max_wheel_speed`` is not above 0.

        """
        vx, vy, wz = twist
        if held_angles is None:
            held_angles = self._straight
        elif len(held_angles) != len(self.positions):
            msg = f'{len(held_angles)} angles for {len(self.positions)} turrets: give one each'
            raise SignalError(msg)
        angles, speeds = [], []
        for (x, y), held in zip(self.positions, held_angles):  # noqa: B905 - measured: strict costs
            wheel_x, wheel_y = vx - wz * y, vy + wz * x
            speed = sqrt(wheel_x * wheel_x + wheel_y * wheel_y)
            speeds.append(speed)
            if speed > STANDSTILL:
                angles.append(atan2(wheel_y, wheel_x))
                continue
            if not isfinite(held):
                require_finite('held_angles', tuple(held_angles))
            angles.append(held)
        fastest = max(speeds)
        if not fastest <= max_wheel_speed:  # also true when NaN
            require_finite('twist', twist)
            require_finite('wheel speeds', tuple(speeds))
            require_wheel_speed(max_wheel_speed)
            scale = max_wheel_speed / fastest
            return TurretCommand(angles, [scale * speed for speed in speeds], scale)
        return TurretCommand(angles, speeds, 1.0)

    def twist(self, angles: Sequence[float], speeds: Sequence[float]) -> TwistFit:
        r"""Return the twist that fits measured turrets best, and what it leaves unexplained.

        Least squares about the centroid of the turrets, where the 3 x 3 normal equations are
        diagonal: the mean wheel velocity is the velocity of the centroid, and

        .. math:: \omega = \frac{\sum_i d_i \times v_i}{\sum_i |d_i|^2},\quad
            d_i = r_i - \bar r

        Args:
            angles: (n,) steering angles [rad].
            speeds: (n,) rolling speeds along them [m/s].

        Raises:
            SignalError: The lengths differ from the number of turrets, or a value is not finite.

        """
        vx, vy, wz, residual = self.solve(angles, speeds)
        return TwistFit(Twist(vx, vy, wz), residual)

    def solve(
        self, angles: Sequence[float], speeds: Sequence[float]
    ) -> tuple[float, float, float, float]:
        """Return what :meth:`twist` does as plain numbers, for the hot path of odometry."""
        n = len(self.positions)
        if len(angles) != n or len(speeds) != n:
            msg = f'{len(angles)} angles and {len(speeds)} speeds for {n} turrets: give one each'
            raise SignalError(msg)
        if not isfinite(sum(angles)):
            require_finite('turret angles', tuple(angles))
        velocities = [
            (speed * cos(angle), speed * sin(angle))
            for angle, speed in zip(angles, speeds)  # noqa: B905 - hot
        ]
        vx, vy, wz, square = self._fit(velocities)
        if not isfinite(square):
            require_finite('wheel speeds', tuple(speeds))
            require_finite(f'the twist of wheel speeds {tuple(speeds)}', (vx, vy, wz, square))
        return vx, vy, wz, sqrt(square)

    def solve_columns(
        self, angles: Column, speeds: Column
    ) -> tuple[Column, Column, Column, Column]:
        """Return what :meth:`solve` does, to the bit, for columns.

        Args:
            angles: (n_turrets, n) [rad], finite.
            speeds: (n_turrets, n) [m/s], finite.

        """
        velocities = list(
            zip(speeds * elementwise(cos, angles), speeds * elementwise(sin, angles), strict=True)
        )
        vx, vy, wz, square = self._fit(velocities)
        return vx, vy, wz, np.sqrt(square)

    def _fit(self, velocities: Sequence[tuple[T, T]]) -> tuple[T, T, T, T]:
        """Return the twist and its mean square error for the velocity of each wheel."""
        n = len(velocities)
        sum_x: Any = 0.0
        sum_y: Any = 0.0
        moment: Any = 0.0
        error: Any = 0.0
        centre_x, centre_y = self._centre_x, self._centre_y
        for (x, y), (v_x, v_y) in zip(self.positions, velocities):  # noqa: B905 - hot
            sum_x += v_x
            sum_y += v_y
            moment += (x - centre_x) * v_y - (y - centre_y) * v_x
        wz = moment / self._spread
        vx, vy = sum_x / n + wz * centre_y, sum_y / n - wz * centre_x
        for (x, y), (v_x, v_y) in zip(self.positions, velocities):  # noqa: B905
            left_x, left_y = vx - wz * y - v_x, vy + wz * x - v_y
            error += left_x * left_x + left_y * left_y
        return vx, vy, wz, error / n


def centre_of_rotation(twist: Twist) -> tuple[float, float] | None:
    """Return the ICR of ``twist`` in the base frame [m], or None where it lies at infinity.

    It is the point at ``(-vy / wz, vx / wz)``, where the velocity of the body vanishes.

    Raises:
        SignalError: ``twist`` is not finite.

    """
    require_finite('twist', twist)
    if abs(twist.wz) <= 1e-12 * max(hypot(twist.vx, twist.vy), 1e-300):
        return None
    return -twist.vy / twist.wz, twist.vx / twist.wz
