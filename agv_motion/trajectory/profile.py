r"""Speed over time along a way: pieces of constant acceleration, sharp or rounded.

Within a piece that starts at time :math:`t_i` with way :math:`s_i` and speed :math:`v_i`

.. math:: s(t) = s_i + v_i \tau + \tfrac12 a_i \tau^2, \qquad \tau = t - t_i   \tag{1}

so the state at a time depends on that time alone, never on the steps taken to it.

The S-curve is the mean of a sharp profile over the last T seconds,

.. math:: \bar s(t) = \frac1T \int_{t-T}^{t} s\, d\tau, \quad
    \bar v = \frac{s(t) - s(t-T)}{T}, \quad \bar a = \frac{v(t) - v(t-T)}{T}   \tag{2}

in closed form from the integral of (1): the same way in T more seconds, the acceleration
continuous, the jerk at most :math:`2a/T` (:math:`a/T` where speeding up and braking lie T apart).

Source: L. Biagiotti, C. Melchiorri, "FIR filters for online trajectory planning with time- and
frequency-domain specifications", Control Engineering Practice 20(12), 2012.
"""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

if TYPE_CHECKING:
    from agv_motion.trajectory.bezier import Column


class Progress(NamedTuple):
    """Where on the way, how fast, how hard; metres, or radians of a rotation."""

    way: float
    """[m]"""
    speed: float
    """[m/s]"""
    acceleration: float
    """[m/s2]"""


class Profile(Protocol):
    """Progress over time, to rest."""

    duration: float
    """[s] until it rests"""
    top_speed: float
    """[m/s] never exceeded"""

    def at(self, time: float) -> Progress:
        """Return the progress at ``time`` [s]."""

    def way(self, time: float) -> float:
        """Return the way of that alone [m], which is quicker."""

    def stopped(self, time: float, braking: float) -> Profile:
        """Return the same profile until ``time`` [s], then ``braking`` [m/s2] until rest."""


class SharpProfile:
    """Equation (1): trapezoids, triangles and whatever a ceiling makes of them."""

    def __init__(
        self,
        times: list[float],
        ways: list[float],
        speeds: list[float],
        accelerations: list[float],
    ) -> None:
        """Keep the pieces, each from its start; the last one is the rest at the end.

        Args:
            times: (n,) starts, the first 0 [s].
            ways: (n,) way there [m].
            speeds: (n,) speed there [m/s], the last 0.
            accelerations: (n,) during each piece [m/s2], the last 0.

        """
        self._times = times
        self._ways = ways
        self._speeds = speeds
        self._accelerations = accelerations
        self.duration = times[-1]
        self.top_speed = max(speeds)

    @classmethod
    def of_pieces(  # noqa: PLR0913 - the columns of one table
        cls,
        way: Column,
        length: Column,
        first: Column,
        last: Column,
        acceleration: Column,
        *,
        start_speed: float,
        end: float,
    ) -> SharpProfile:
        """Return the profile whose squared speed is linear over the way within each piece.

        A piece lasts :math:`2 l / (v_0 + v_1)`. Where one starts faster or slower than the last
        ended the speed jumps: a ramp so hard that nothing is left of it.

        Args:
            way: (n,) start of each piece [m].
            length: (n,) of each, positive [m].
            first: (n,) squared speed at its start [m2/s2].
            last: (n,) squared speed at its end, not zero at both [m2/s2].
            acceleration: (n,) [m/s2].
            start_speed: With which it comes [m/s].
            end: Where it rests [m].

        """
        speed = np.sqrt(first)
        times = [0.0, *np.cumsum(2.0 * length / (speed + np.sqrt(last))).tolist()]
        ways, speeds = [*way.tolist(), end], [*speed.tolist(), 0.0]
        accelerations = [*acceleration.tolist(), 0.0]
        if speeds[0] != start_speed:  # a piece of no time: before the start this is the speed
            times, ways = [0.0, *times], [ways[0], *ways]
            speeds, accelerations = [start_speed, *speeds], [0.0, *accelerations]
        return cls(times, ways, speeds, accelerations)

    def at(self, time: float) -> Progress:
        """Return the progress at ``time`` [s]; before the start it came on at constant speed."""
        piece = bisect_right(self._times, time) - 1
        if piece < 0:
            return Progress(self._ways[0] + time * self._speeds[0], self._speeds[0], 0.0)
        tau = time - self._times[piece]
        speed, acceleration = self._speeds[piece], self._accelerations[piece]
        return Progress(
            self._ways[piece] + tau * (speed + 0.5 * acceleration * tau),
            speed + acceleration * tau,
            acceleration,
        )

    def way(self, time: float) -> float:
        """Return the way at ``time`` [s] alone."""
        piece = bisect_right(self._times, time) - 1
        if piece < 0:
            return self._ways[0] + time * self._speeds[0]
        tau = time - self._times[piece]
        return self._ways[piece] + tau * (
            self._speeds[piece] + 0.5 * self._accelerations[piece] * tau
        )

    def stopped(self, time: float, braking: float) -> SharpProfile:
        """Return the same profile until ``time`` [s], then ``braking`` [m/s2] until rest."""
        if time >= self.duration:
            return self
        way, speed, _ = self.at(time)
        end = bisect_right(self._times, time)
        lasting = speed / braking
        return SharpProfile(
            [*self._times[:end], time, time + lasting],
            [*self._ways[:end], way, way + 0.5 * speed * lasting],
            [*self._speeds[:end], speed, 0.0],
            [*self._accelerations[:end], -braking, 0.0],
        )

    def integrals(self) -> list[float]:
        """Return the integral of the way from time 0 to the start of each piece [m s]."""
        s, v, a = (np.array(c[:-1]) for c in (self._ways, self._speeds, self._accelerations))
        tau = np.diff(self._times)
        return [0.0, *np.cumsum(tau * (s + tau * (v / 2.0 + tau * a / 6.0))).tolist()]

    def area(self, time: float, integrals: list[float]) -> float:
        """Return the integral of the way up to ``time`` [s], the first of :meth:`moment`."""
        piece = bisect_right(self._times, time) - 1
        if piece < 0:
            return time * (self._ways[0] + 0.5 * time * self._speeds[0])
        tau = time - self._times[piece]
        s, v, a = self._ways[piece], self._speeds[piece], self._accelerations[piece]
        return integrals[piece] + tau * (s + tau * (v / 2.0 + tau * a / 6.0))

    def moment(self, time: float, integrals: list[float]) -> tuple[float, float, float]:
        """Return integral of the way [m s], way and speed at ``time`` [s].

        Args:
            time: [s], may lie before 0.
            integrals: What :meth:`integrals` returned.

        """
        piece = bisect_right(self._times, time) - 1
        if piece < 0:
            s, v = self._ways[0], self._speeds[0]
            return time * (s + 0.5 * time * v), s + time * v, v
        tau = time - self._times[piece]
        s, v, a = self._ways[piece], self._speeds[piece], self._accelerations[piece]
        return (
            integrals[piece] + tau * (s + tau * (v / 2.0 + tau * a / 6.0)),
            s + tau * (v + 0.5 * a * tau),
            v + a * tau,
        )


class RoundedProfile:
    """Equation (2): the mean of a sharp profile over the last T seconds."""

    def __init__(self, sharp: SharpProfile, rounding: float) -> None:
        """Round ``sharp``, whose way must start at half of ``rounding`` times its speed.

        Then the rounded way starts at 0.

        Args:
            sharp: The profile to be rounded.
            rounding: T [s], positive.

        """
        self._sharp = sharp
        self._rounding = rounding
        self._integrals = sharp.integrals()
        self.duration = sharp.duration + rounding
        self.top_speed = sharp.top_speed

    def at(self, time: float) -> Progress:
        """Return the progress at ``time`` [s] by equation (2)."""
        if time >= self.duration:
            return self._sharp.at(time)
        width = self._rounding
        area, way, speed = self._sharp.moment(time, self._integrals)
        area_before, way_before, speed_before = self._sharp.moment(time - width, self._integrals)
        return Progress(
            (area - area_before) / width,
            (way - way_before) / width,
            (speed - speed_before) / width,
        )

    def way(self, time: float) -> float:
        """Return the way at ``time`` [s] alone."""
        if time >= self.duration:
            return self._sharp.way(time)
        sharp, width, integrals = self._sharp, self._rounding, self._integrals
        return (sharp.area(time, integrals) - sharp.area(time - width, integrals)) / width

    def stopped(self, time: float, braking: float) -> RoundedProfile:
        """Return the same profile until ``time`` [s], then ``braking`` [m/s2], rounded too."""
        return RoundedProfile(self._sharp.stopped(time, braking), self._rounding)
