r"""One omnidirectional wheel (omni or mecanum): its place, its directions, the usual placements.

The motor of a wheel drives it along its rolling direction :math:`u`; its rollers leave it free
along the slide direction :math:`f`. The velocity of its centre at :math:`(x, y)` is the sum of
both,

.. math:: (v_x - \omega y,\; v_y + \omega x) = V u + s f

so the component across :math:`f` gives the driven speed :math:`V`, and the component across
:math:`u` the free speed :math:`s`. Both are linear in the twist.

Source: P. F. Muir, C. P. Neuman, "Kinematic modeling of wheeled mobile robots", J. Robotic
Systems 4(2), 1987, section 4.
"""

from __future__ import annotations

from math import cos, isfinite, pi, sin
from typing import TYPE_CHECKING, NamedTuple

from agv_motion.errors import GeometryError
from agv_motion.kinematics.polar_positions import polar_positions

if TYPE_CHECKING:
    from collections.abc import Sequence

Row = tuple[float, float, float]

DRIVELESS = 1e-6
"""[-] Sine of the slide angle below which the motor of a wheel moves nothing."""


class OmniWheel(NamedTuple):
    """Where a wheel stands in the base frame, and its two directions."""

    x: float
    """[m]"""
    y: float
    """[m]"""
    rolling: float
    """[rad] direction in which the motor drives the base, from the x axis"""
    slide: float = pi / 2
    """[rad] direction that the rollers leave free, from the rolling direction: pi/2 for an omni
    wheel, pi/4 or -pi/4 for a mecanum wheel"""

    def driven(self) -> Row:
        """Return the driven speed V for unit vx, vy and wz."""
        slide, share = self.rolling + self.slide, sin(self.slide)
        return self._moment(sin(slide) / share, -cos(slide) / share)

    def free(self) -> Row:
        """Return the free speed s for unit vx, vy and wz."""
        share = sin(self.slide)
        return self._moment(-sin(self.rolling) / share, cos(self.rolling) / share)

    def _moment(self, to_x: float, to_y: float) -> Row:
        """Return the component of the wheel's velocity along ``(to_x, to_y)``."""
        return to_x, to_y, self.x * to_y - self.y * to_x


def require_driven(number: int, wheel: OmniWheel) -> None:
    """Raise unless the motor of ``wheel`` can move the base.

    Raises:
        GeometryError: A number is not finite, or the wheel slides along its rolling direction.

    """
    if not all(map(isfinite, wheel)):
        msg = f'wheel {number} must be finite, got {wheel}: give metres and radians'
        raise GeometryError(msg)
    if abs(sin(wheel.slide)) < DRIVELESS:
        msg = (
            f'wheel {number} slides along its own rolling direction (slide = {wheel.slide} rad), '
            'so it drives nothing: give pi/2 or, mecanum, pi/4 or -pi/4'
        )
        raise GeometryError(msg)


def wheels_on_circle(angles: Sequence[float], distances: Sequence[float]) -> list[OmniWheel]:
    """Return omni wheels at polar positions, each rolling clockwise about the centre.

    Wheel j stands at ``angles[j]`` [rad] and ``distances[j]`` [m]; it rolls along
    ``(sin a_j, -cos a_j)`` and is free along ``(cos a_j, sin a_j)``.

    Raises:
        GeometryError: The lengths differ, or a number is not finite.

    """
    places = polar_positions('wheel', angles, distances)
    return [OmniWheel(x, y, a - pi / 2) for (x, y), a in zip(places, angles, strict=True)]


def mecanum_wheels(half_length: float, half_width: float) -> list[OmniWheel]:
    """Return four mecanum wheels rolling forward, their rollers meeting in the usual X.

    In the order front left, front right, rear left, rear right, at ``(+-half_length,
    +-half_width)`` [m].
    """
    return [
        OmniWheel(half_length, half_width, 0.0, pi / 4),
        OmniWheel(half_length, -half_width, 0.0, -pi / 4),
        OmniWheel(-half_length, half_width, 0.0, -pi / 4),
        OmniWheel(-half_length, -half_width, 0.0, pi / 4),
    ]
