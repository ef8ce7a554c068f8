r"""Omnidirectional wheels of a rigid body: twist <-> rim speed of each, any number >= 3, anywhere.

The driven speeds are linear in the twist; the way back is the pseudo-inverse of their
:math:`n \times 3` matrix, computed once. What the best twist leaves unexplained is slip.

Source: P. F. Muir, C. P. Neuman, "Kinematic modeling of wheeled mobile robots", J. Robotic
Systems 4(2), 1987, sections 4 and 6.
"""

from __future__ import annotations

from math import cos, isfinite, sin, sqrt
from operator import mul
from sys import float_info
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import GeometryError, SignalError
from agv_motion.kinematics.omniwheel_placement import (
    OmniWheel,
    require_driven,
    wheels_on_circle,
)
from agv_motion.kinematics.speed_limit import require_wheel_speed
from agv_motion.kinematics.twist_fit import TwistFit
from agv_motion.kinematics.wheel_solution import WheelSolution, solve_wheels
from agv_motion.planar import Twist, require_finite

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from agv_motion.kinematics.omni_platform import OmniBaseParameters

Matrix = NDArray[np.float64]


class OmniCommand(NamedTuple):
    """What each wheel must do, in the order of the wheels."""

    speed: list[float]
    """(n,) [m/s] rim speed along the rolling direction"""
    scale: float
    """[-] in (0, 1]: the factor by which the twist was reduced to hold the wheel speed limit"""


class OmniWheels:
    """The roller wheels of one base: where they are, and both maps between twist and wheels."""

    def __init__(
        self, wheels: Sequence[OmniWheel], wheel_radii: Sequence[float] | None = None
    ) -> None:
        """Build the matrix and its pseudo-inverse once.

        Args:
            wheels: (n,) n >= 3 wheels in any placement.
            wheel_radii: (n,) rolling radius of each [m]; only needed for rates in rad/s.

        Raises:
            GeometryError: Fewer than three wheels, a number not finite, a wheel whose rollers are
                free along its own rolling direction, or a placement in which some motion of the
                base turns no wheel (the message names that motion); or the radii are not n finite
                numbers above 0.

        """
        self.wheels = tuple(OmniWheel(*map(float, wheel)) for wheel in wheels)
        self.radii = None if wheel_radii is None else self._checked_radii(wheel_radii)
        """(n,) [m]; None where they are not known"""
        for number, wheel in enumerate(self.wheels):
            require_driven(number, wheel)
        self._driven = tuple(wheel.driven() for wheel in self.wheels)
        self._free = tuple(wheel.free() for wheel in self.wheels)
        self._solutions: dict[tuple[int, ...], WheelSolution] = {}
        self._whole = self._solution(tuple(range(len(self.wheels))))

    @classmethod
    def of(cls, base: OmniBaseParameters) -> OmniWheels:
        """Return the wheels of a base as it was declared; their radii are not kept.

        Raises:
            GeometryError: What the constructor refuses.

        """
        rows = zip(
            base.wheel_angles, base.wheel_distances, base.wheel_directions, base.slide_angles,
            strict=True,
        )  # fmt: skip
        return cls([
            OmniWheel(distance * cos(angle), distance * sin(angle), direction, slide)
            for angle, distance, direction, slide in rows
        ])  # fmt: skip

    @classmethod
    def from_polar(
        cls,
        angles: Sequence[float],
        distances: Sequence[float],
        wheel_radii: Sequence[float] | None = None,
    ) -> OmniWheels:
        """Return omni wheels at polar positions, see `wheels_on_circle`.

        Args:
            angles: (n,) from the x axis [rad].
            distances: (n,) from the centre [m].
            wheel_radii: (n,) rolling radius of each [m]; only needed for rates in rad/s.

        Raises:
            GeometryError: The lengths differ, or what the constructor refuses.

        """
        return cls(wheels_on_circle(angles, distances), wheel_radii)

    def __len__(self) -> int:
        """Return the number of wheels."""
        return len(self.wheels)

    @property
    def matrix(self) -> Matrix:
        """(n, 3) rim speeds [m/s] of unit vx, vy and wz."""
        return np.array(self._driven)

    def command(self, twist: Twist, max_wheel_speed: float = float_info.max) -> OmniCommand:
        """Return the rim speed of each wheel for ``twist``.

        When a wheel would exceed its limit the whole twist is scaled by one factor, so the base
        stays on its way and only takes longer.

        Args:
            twist: Wanted velocity of the base frame.
            max_wheel_speed: Limit of every wheel [m/s].

        Raises:
            SignalError: ``twist`` is not finite.
            ConfigurationError: ``max_wheel_speed`` is not above 0.

        """
        vx, vy, wz = twist
        speeds = [a * vx + b * vy + c * wz for a, b, c in self._driven]
        fastest = max(*speeds, -min(speeds))
        if not (isfinite(vx) and isfinite(vy) and isfinite(wz) and isfinite(fastest)):
            require_finite('twist', twist)
            require_finite('wheel speeds', tuple(speeds))
        if not fastest <= max_wheel_speed:  # also true when it is NaN
            require_wheel_speed(max_wheel_speed)
            scale = max_wheel_speed / fastest
            return OmniCommand([scale * speed for speed in speeds], scale)
        return OmniCommand(speeds, 1.0)

    def rates(self, speeds: Sequence[float]) -> list[float]:
        """Return the rates [rad/s] of wheels whose rims go at ``speeds`` [m/s], (n,) both.

        Raises:
            GeometryError: The radii are not known.
            SignalError: A wrong number of values, or one that is not finite.

        """
        pairs = zip(self._numbers('wheel speeds', speeds), self._radii(), strict=True)
        return _finite('rates', [speed / radius for speed, radius in pairs])

    def speeds(self, rates: Sequence[float]) -> list[float]:
        """Return the rim speeds [m/s] of wheels that turn at ``rates`` [rad/s], (n,) both.

        Raises:
            GeometryError: The radii are not known.
            SignalError: A wrong number of values, or one that is not finite.

        """
        pairs = zip(self._numbers('wheel rates', rates), self._radii(), strict=True)
        return _finite('rim speeds', [rate * radius for rate, radius in pairs])

    def _checked_radii(self, radii: Sequence[float]) -> tuple[float, ...]:
        if len(radii) != len(self.wheels):
            msg = f'{len(radii)} wheel_radii for {len(self.wheels)} wheels: give one each [m]'
            raise GeometryError(msg)
        for number, radius in enumerate(radii):
            if not (isfinite(radius) and radius > 0.0):
                msg = f'radius of wheel {number} = {radius} m: must be finite and above 0'
                raise GeometryError(msg)
        return tuple(map(float, radii))

    def _radii(self) -> tuple[float, ...]:
        if self.radii is None:
            msg = 'the radii of the wheels are not known: give wheel_radii to OmniWheels [m]'
            raise GeometryError(msg)
        return self.radii

    def _numbers(self, name: str, values: Sequence[float]) -> Sequence[float]:
        if len(values) != len(self.wheels):
            msg = f'{len(values)} {name} for {len(self.wheels)} wheels: give one each'
            raise SignalError(msg)
        require_finite(name, tuple(values))
        return values

    def free_roller_speeds(self, twist: Twist) -> list[float]:
        """Return (n,) the speed [m/s] of each wheel along its slide direction for ``twist``."""
        require_finite('twist', twist)
        vx, vy, wz = twist
        return _finite('roller speeds', [a * vx + b * vy + c * wz for a, b, c in self._free])

    def twist(self, speeds: Sequence[float], missing: Collection[int] = ()) -> TwistFit:
        """Return the twist that fits measured rim speeds best, and what it leaves unexplained.

        The same map takes travels [m] to a displacement. The residual is the root mean square
        over the measured wheels [m/s]: how much they slip against each other. Three wheels agree
        with some twist whatever they measure, so theirs is zero.

        Args:
            speeds: (n,) rim speeds [m/s].
            missing: Numbers of the wheels, from 0, whose speeds are unknown and not looked at.

        Raises:
            SignalError: The length differs from the number of wheels, a value is not finite, there
                is no wheel of a number in ``missing``, or the wheels left cannot tell the twist
                (the message names the motion they miss).

        """
        vx, vy, wz, residual = self.solve(speeds, missing)
        return TwistFit(Twist(vx, vy, wz), residual)

    def solve(
        self, speeds: Sequence[float], missing: Collection[int] = ()
    ) -> tuple[float, float, float, float]:
        """Return what :meth:`twist` does as plain numbers, which takes half as long."""
        if len(speeds) != len(self._driven):
            msg = f'{len(speeds)} speeds for {len(self._driven)} wheels: give one each'
            raise SignalError(msg)
        solution = self._whole
        if missing:
            solution = self._without(missing)
            speeds = [0.0 if i in missing else speed for i, speed in enumerate(speeds)]
        vx = vy = wz = 0.0
        for speed, (to_x, to_y, to_z) in zip(speeds, solution.rows):  # noqa: B905 - strict costs
            vx += to_x * speed
            vy += to_y * speed
            wz += to_z * speed
        if not (isfinite(vx) and isfinite(vy) and isfinite(wz)):
            require_finite('wheel speeds', tuple(speeds))
            require_finite(f'the twist of wheel speeds {tuple(speeds)}', (vx, vy, wz))
        if not solution.checks:
            return vx, vy, wz, 0.0
        unexplained = 0.0
        for check in solution.checks:
            part = sum(map(mul, check, speeds))
            unexplained += part * part
        if not isfinite(unexplained):
            require_finite(f'the residual of wheel speeds {tuple(speeds)}', (unexplained,))
        return vx, vy, wz, sqrt(unexplained / solution.wheels)

    def _without(self, missing: Collection[int]) -> WheelSolution:
        present = tuple(i for i in range(len(self)) if i not in missing)
        if len(present) + len(set(missing)) != len(self):
            msg = f'missing = {sorted(missing)}: there are wheels 0 to {len(self) - 1}'
            raise SignalError(msg)
        try:
            return self._solution(present)
        except GeometryError as error:
            msg = f'only wheels {present} of {len(self)} measure, and {error}'
            raise SignalError(msg) from error

    def _solution(self, present: tuple[int, ...]) -> WheelSolution:
        """Return the pseudo-inverse for some of the wheels, from memory after the first time."""
        if present not in self._solutions:
            places = [complex(wheel.x, wheel.y) for wheel in self.wheels]
            self._solutions[present] = solve_wheels(self._driven, places, present)
        return self._solutions[present]


def _finite(name: str, values: list[float]) -> list[float]:
    require_finite(name, tuple(values))
    return values
