r"""The fastest speed along a way under a ceiling and a limited acceleration.

Over the way s the squared speed w changes by at most :math:`\pm 2a` per metre, so the fastest
profile is the lowest of all ramps that start on the ceiling c:

.. math:: w(s) = \min_\sigma \left( c(\sigma) + 2a\,|s - \sigma| \right)   \tag{1}

with :math:`c(0) = v_0^2` and :math:`c(L) = 0`. Going forwards and then backwards over the nodes of
a grid, (1) is a running minimum of :math:`c \mp 2as`. Between two nodes the profile is the lowest
of three straight lines (ramp up, ceiling, ramp down), whose corners are placed exactly: without
bends one cell makes the whole trapezoid, or triangle where the way is short.

Source: J. E. Bobrow, S. Dubowsky, J. S. Gibson, "Time-optimal control of robotic manipulators
along specified paths", Int. J. Robotics Research 4(3), 1985; for this special case the
forward-backward pass of E. Velenis, P. Tsiotras, "Minimum-time travel for a vehicle with
acceleration limits", J. Optimization Theory and Applications 138, 2008.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from agv_motion.errors import GeometryError
from agv_motion.trajectory.profile import Profile, RoundedProfile, SharpProfile

if TYPE_CHECKING:
    from agv_motion.trajectory.bezier import Column

SHORTEST = 1e-12
"""Share of the way below which a piece is rounding and left out."""


def plan_speed(
    way: Column,
    ceiling: Column,
    acceleration: float,
    start_speed: float = 0.0,
    rounding: float = 0.0,
) -> Profile:
    """Return the fastest profile over a way from ``start_speed`` to rest, rounded if asked.

    Args:
        way: (n,) nodes from 0, not decreasing [m].
        ceiling: (n,) highest speed at each, positive [m/s].
        acceleration: Highest speeding up and braking [m/s2].
        start_speed: Present speed [m/s].
        rounding: Time over which acceleration builds up [s]; 0 for a trapezoid.

    Raises:
        GeometryError: The way is too short, or bends too soon, to brake from ``start_speed``.

    """
    square = ceiling * ceiling
    lowest = _lowest(way, square, acceleration, start_speed)
    if rounding > 0.0:
        # the mean of a sharp profile over T seconds stands at most this far from its moments
        reach = (0.5 * np.sqrt(lowest) + 0.5 * acceleration * rounding) * rounding
        square = _lowest_within(way, square, reach)
        start = 0.5 * start_speed * rounding
        after = way > start
        square = np.append(np.interp(start, way, square), square[after])
        way = np.append(start, way[after])
        lowest = _lowest(way, square, acceleration, start_speed)
    sharp = _with_corners(way, square, lowest, 2.0 * acceleration)
    return RoundedProfile(sharp, rounding) if rounding > 0.0 else sharp


def _lowest(way: Column, square: Column, acceleration: float, start_speed: float) -> Column:
    """Return w of equation (1) at the nodes."""
    slope = 2.0 * acceleration
    bound = square.copy()
    bound[0] = start = start_speed * start_speed
    bound[-1] = 0.0
    rise = slope * way
    forward = np.minimum.accumulate(bound - rise) + rise
    lowest: Column = np.maximum(np.minimum.accumulate((forward + rise)[::-1])[::-1] - rise, 0.0)
    allowed = min(float(lowest[0]), float(square[0]) * (1.0 + 1e-9))
    if len(way) < 2 or allowed < start * (1.0 - 1e-9) - 1e-12:
        msg = (
            f'{start_speed:.4g} m/s is too fast here: the way ahead, {way[-1] - way[0]:.4g} m, '
            f'allows {allowed**0.5:.4g} m/s at its start with a braking of {acceleration:.4g} m/s2 '
            '(rad for a rotation): stop first, or go further or straighter'
        )
        raise GeometryError(msg)
    lowest[0], lowest[-1] = start, 0.0
    return lowest


def _with_corners(way: Column, ceiling: Column, lowest: Column, slope: float) -> SharpProfile:
    """Place the corners in each cell: at x1 it leaves the ramp up, at x2 it meets the ramp down."""
    start = way[:-1]
    length = way[1:] - start
    w0, w1, c0 = lowest[:-1], lowest[1:], ceiling[:-1]
    peak = 0.5 * (length + (w1 - w0) / slope)
    with np.errstate(divide='ignore', invalid='ignore'):
        tilt = (ceiling[1:] - c0) / length
        flat = c0 + tilt * peak < w0 + slope * peak  # the ceiling cuts the peak off
        x1 = np.where(flat, (c0 - w0) / (slope - tilt), peak)
        x2 = np.where(flat, (w1 + slope * length - c0) / (slope + tilt), peak)
    x1, x2 = (np.minimum(np.maximum(x, 0.0), length) for x in (x1, x2))
    nodes, squares = np.empty(3 * len(start) + 1), np.empty(3 * len(start) + 1)
    nodes[:-1:3], nodes[1::3], nodes[2::3], nodes[-1] = start, start + x1, start + x2, way[-1]
    squares[:-1:3], squares[1::3], squares[2::3] = w0, w0 + slope * x1, w1 + slope * (length - x2)
    squares[-1] = lowest[-1]
    keep = np.ones(len(nodes), dtype=bool)
    np.greater(nodes[1:] - nodes[:-1], SHORTEST * (way[-1] - way[0]), out=keep[:-1])
    return SharpProfile.over_way(nodes[keep], squares[keep])


def _lowest_within(way: Column, values: Column, reach: Column) -> Column:
    """Return at each node the lowest of ``values`` within ``reach`` of it, and one node more.

    By a table of minima over 1, 2, 4 ... nodes, of which two cover any stretch.
    """
    last = len(way) - 1
    first = np.maximum(np.searchsorted(way, way - reach) - 1, 0)
    final = np.minimum(np.searchsorted(way, way + reach, side='right'), last)
    level = np.log2(final - first + 1).astype(int)
    table = np.empty((int(level.max()) + 1, len(values)))
    table[0] = values
    for k in range(1, len(table)):
        half = 2 ** (k - 1)
        np.minimum(table[k - 1, :-half], table[k - 1, half:], out=table[k, :-half])
        table[k, -half:] = table[k - 1, -half:]
    lowest: Column = np.minimum(table[level, first], table[level, final + 1 - 2**level])
    return lowest
