r"""Adding up displacements of a base: its pose exactly, and how uncertain it has become.

A displacement :math:`(d_x, d_y, a)` of constant twist is an arc; its chord is the arc turned by
:math:`a/2` and shortened by :math:`\sin(a/2)/(a/2)`.

The error of the pose is kept as a small motion of the world about the origin: true pose =
exp(error) * pose. In this form (the right-invariant one) an error made once stays the same
however the base goes on, so the covariance only grows by what each step adds: the noise of the
displacement, turned and shifted to the origin. It can also be subtracted: the difference between
two times is the covariance of the motion between them.

Source: A. Barrau, S. Bonnabel, "The invariant extended Kalman filter as a stable observer", IEEE
Trans. Autom. Control 62(4), 2017.
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from agv_motion.kinematics.elementwise import elementwise
from agv_motion.odometry.covariance import CERTAIN, Covariance, shift
from agv_motion.planar import Pose, require_finite, wrap

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Column = NDArray[np.float64]
    T = TypeVar('T', float, Column)

Displacement = tuple[float, float, float]
"""Twist times duration, in the frame of the base [m, m, rad]."""


class DeadReckoning:
    """A pose in the frame `odom`, and the covariance of its error about the origin.

    Both are kept as plain numbers: to build tuples of them would cost as much as the step.
    """

    __slots__ = ('_tt', '_xt', '_xx', '_xy', '_yt', '_yy', 'heading', 'x', 'y')

    def __init__(self) -> None:
        """Start at the origin, with certainty."""
        self.set(Pose(0.0, 0.0, 0.0))

    @property
    def pose(self) -> Pose:
        """Pose of the base."""
        return Pose(self.x, self.y, self.heading)

    @property
    def origin_covariance(self) -> Covariance:
        """Covariance of the error about the origin; its differences belong to times between."""
        return Covariance(self._xx, self._xy, self._xt, self._yy, self._yt, self._tt)

    def covariance(self) -> Covariance:
        """Return the covariance of the pose in the axes of `odom`, as nav_msgs/Odometry has it."""
        return shift(self.origin_covariance, self.x, self.y)

    def set(self, pose: Pose, covariance: Covariance = CERTAIN) -> None:
        """Go on from ``pose``, known as well as ``covariance`` (axes of `odom`) says.

        Raises:
            SignalError: A number is not finite.

        """
        require_finite('pose', pose)
        require_finite('covariance', covariance)
        self.x, self.y, self.heading = pose.x, pose.y, wrap(pose.theta)
        self._xx, self._xy, self._xt, self._yy, self._yt, self._tt = shift(
            covariance, -pose.x, -pose.y
        )

    def carry(
        self, displacement: Displacement, covariance: Covariance, variance: float = 1.0
    ) -> None:
        """Follow ``displacement``, whose covariance is ``variance`` times ``covariance``.

        Args:
            displacement: Twist times duration, in the frame of the base [m, m, rad].
            covariance: In the frame of the base halfway.
            variance: Factor on it.

        """
        dx, dy, turn = displacement
        half = 0.5 * turn
        heading = self.heading + half
        c, s = cos(heading), sin(heading)
        chord = sin(half) / half if half else 1.0
        step_x, step_y = chord * (c * dx - s * dy), chord * (s * dx + c * dy)
        x, y = self.x + 0.5 * step_x, self.y + 0.5 * step_y
        self.x += step_x
        self.y += step_y
        heading += half
        self.heading = heading if -pi <= heading < pi else wrap(heading)
        xx, xy, xt, yy, yt, tt = _at_origin(covariance, c, s, x, y)
        self._xx += variance * xx
        self._xy += variance * xy
        self._xt += variance * xt
        self._yy += variance * yy
        self._yt += variance * yt
        self._tt += variance * tt

    def carry_columns(
        self, displacement: tuple[Column, Column, Column], covariance: Covariance, variance: Column
    ) -> tuple[tuple[Column, Column, Column], Covariance]:
        """Follow many displacements: to the bit what :meth:`carry` does one after the other.

        Args:
            displacement: (n,) columns of twist times duration.
            covariance: In the frame of the base halfway.
            variance: (n,) factor on it.

        Returns:
            Columns (n,) of the pose after each, and of its :meth:`covariance`.

        """
        dx, dy, turn = displacement
        halves = 0.5 * turn
        between, after = self._turn(halves.tolist())
        c, s = elementwise(cos, between), elementwise(sin, between)
        chord = np.array([sin(half) / half if half else 1.0 for half in halves.tolist()])
        step_x, step_y = chord * (c * dx - s * dy), chord * (s * dx + c * dy)
        x, y = _sums(self.x, step_x), _sums(self.y, step_y)
        added: Any = _at_origin(covariance, c, s, x[:-1] + 0.5 * step_x, y[:-1] + 0.5 * step_y)
        grown = [
            _sums(before, variance * more)
            for before, more in zip(self.origin_covariance, added, strict=True)
        ]
        self.x, self.y = float(x[-1]), float(y[-1])
        self._xx, self._xy, self._xt, self._yy, self._yt, self._tt = (
            float(column[-1]) for column in grown
        )
        columns: Any = [column[1:] for column in (*grown, x, y)]  # shift() takes them as numbers
        return (x[1:], y[1:], after), shift(Covariance(*columns[:6]), *columns[6:])

    def _turn(self, halves: list[float]) -> tuple[Column, Column]:
        """Turn by each half angle twice; return the headings between and after."""
        heading = self.heading
        between, after = [], []
        for half in halves:
            heading += half
            between.append(heading)
            heading += half
            heading = heading if -pi <= heading < pi else wrap(heading)
            after.append(heading)
        self.heading = heading
        return np.array(between), np.array(after)


def _at_origin(covariance: Covariance, c: T, s: T, x: T, y: T) -> tuple[T, T, T, T, T, float]:
    """Return a covariance in the frame of the base as one about the origin, as plain numbers.

    ``rotate`` and ``shift``, written out: the hot path.

    Args:
        covariance: In the frame of the base.
        c: Cosine of its heading.
        s: Sine of its heading.
        x: Of the base [m].
        y: Of the base [m].

    """
    xx, xy, xt, yy, yt, tt = covariance
    mean, half_difference = 0.5 * (xx + yy), 0.5 * (xx - yy)
    c2, s2 = c * c - s * s, 2.0 * c * s
    along, across = half_difference * c2 - xy * s2, half_difference * s2 + xy * c2
    turned_xt, turned_yt = c * xt - s * yt, s * xt + c * yt
    shifted_xt, shifted_yt = turned_xt + y * tt, turned_yt - x * tt
    return (
        mean + along + y * (turned_xt + shifted_xt),
        across - x * shifted_xt + y * turned_yt,
        shifted_xt,
        mean - along - x * (turned_yt + shifted_yt),
        shifted_yt,
        tt,
    )


def _sums(start: float, steps: Column) -> Column:
    """Return ``start`` and what it becomes with each step, added one after the other."""
    return np.cumsum(np.concatenate([[start], steps]))
