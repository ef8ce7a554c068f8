r"""A plain trapezoid of speed over a distance, also with other braking than speeding up.

From rest to rest over :math:`d`, at most :math:`v`, speeding up by :math:`a` and braking by
:math:`b`, the top speed is

.. math:: v_t = \min\left( v, \sqrt{2 d\, a b / (a + b)} \right)   \tag{1}

where the second is the peak of a triangle: its two ramps take :math:`v_t^2 / 2a + v_t^2 / 2b = d`.
"""

from __future__ import annotations

from math import sqrt

from agv_motion.trajectory.bounds import SPEEDS, require_between, require_ramp
from agv_motion.trajectory.profile import Profile, RoundedProfile, SharpProfile

DISTANCES = (0.0, 1e9)
"""[m], [rad]"""

ROUNDINGS = (0.0, 1e6)
"""[s]"""


def trapezoid(
    distance: float,
    speed: float,
    acceleration: float,
    braking: float | None = None,
    rounding: float = 0.0,
) -> Profile:
    """Return the fastest profile over ``distance`` from rest to rest.

    Args:
        distance: [m], or [rad] of a rotation.
        speed: Highest [m/s].
        acceleration: Of speeding up [m/s2]; `NO_RAMP`: at once.
        braking: Of braking, without sign [m/s2]; `NO_RAMP`: at once; None: as ``acceleration``.
        rounding: Time over which acceleration builds up [s], for an S-curve; it takes as much
            longer.

    Raises:
        ConfigurationError: A number is not finite or out of its range.

    """
    require_between('distance', distance, DISTANCES, 'm')
    require_between('speed', speed, SPEEDS, 'm/s')
    require_between('rounding', rounding, ROUNDINGS, 's')
    up = require_ramp('acceleration', acceleration)
    down = up if braking is None else require_ramp('braking', braking)
    # of two ramps the harmonic mean counts; written so that no product overflows
    top = min(speed, sqrt(2.0 * distance / (1.0 / up + 1.0 / down)))
    if top <= 0.0:
        return SharpProfile([0.0], [0.0], [0.0], [0.0])
    rising, falling = 0.5 * top * (top / up), 0.5 * top * (top / down)
    level = max(distance - rising - falling, 0.0)
    times = [0.0, top / up, top / up + level / top]
    sharp = SharpProfile(
        [*times, times[2] + top / down],
        [0.0, rising, rising + level, distance],
        [0.0, top, top, 0.0],
        [up, 0.0, -down, 0.0],
    )
    return RoundedProfile(sharp, rounding) if rounding > 0.0 else sharp
