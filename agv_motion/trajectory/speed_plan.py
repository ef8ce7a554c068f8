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

from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

from agv_motion.errors import GeometryError
from agv_motion.trajectory.profile import Profile, RoundedProfile, SharpProfile

if TYPE_CHECKING:
    from agv_motion.trajectory.bezier import Column

SHORTEST = 1e-12
"""Share of the way below which a cell is none: two curves meet there."""

ROUNDING = 1e-15
"""Share of the way below which a piece is rounding and left out."""

AT_ONCE = 1e300
"""[m/s2] The acceleration of whom nothing holds back: what its ramps take is below all rounding."""


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
        acceleration: Highest speeding up and braking, positive [m/s2]; `AT_ONCE`: without ramps.
        start_speed: Present speed [m/s].
        rounding: Time over which acceleration builds up [s]; 0 for a trapezoid.

    Raises:
        GeometryError: The way is too short, or bends too soon, to brake from ``start_speed``.

    """
    acceleration = min(acceleration, AT_ONCE)
    square = ceiling * ceiling
    lowest = _lowest(way, square, acceleration, start_speed)
    if rounding > 0.0:
        # the mean of a sharp profile over T seconds stands at most this far from its moments
        fastest = np.minimum(np.sqrt(lowest) + acceleration * rounding, np.sqrt(square.max()))
        reach = 0.5 * fastest * rounding
        square = _lowest_within(way, square, reach)
        start = 0.5 * start_speed * rounding
        after = way > start
        square = np.append(np.interp(start, way, square), square[after])
        way = np.append(start, way[after])
        lowest = _lowest(way, square, acceleration, start_speed)
    sharp = _with_corners(way, square, lowest, acceleration)
    return RoundedProfile(sharp, rounding) if rounding > 0.0 else sharp


def _lowest(way: Column, square: Column, acceleration: float, start_speed: float) -> Column:
    """Return w of equation (1) at the nodes.

    Node by node: the ramps of the whole way at once would lose in their height the digits of a
    speed that is small beside them.
    """
    start = start_speed * start_speed
    if len(way) < 2:
        raise GeometryError(_too_fast(start_speed, 0.0, 0.0, acceleration))
    bound = [start, *square[1:-1].tolist(), 0.0]
    rises = (2.0 * acceleration * (way[1:] - way[:-1])).tolist()
    forward = list(accumulate(zip(bound[1:], rises, strict=True), _climb, initial=start))
    back = zip(forward[-2::-1], reversed(rises), strict=True)
    lowest: Column = np.array(list(accumulate(back, _climb, initial=0.0))[::-1])
    allowed = min(float(lowest[0]), float(square[0]) * (1.0 + 1e-9))
    if allowed < start * (1.0 - 1e-9) - 1e-12:
        ahead = float(way[-1] - way[0])
        raise GeometryError(_too_fast(start_speed, ahead, allowed, acceleration))
    lowest[0], lowest[-1] = start, 0.0
    return lowest


def _too_fast(speed: float, ahead: float, allowed: float, acceleration: float) -> str:
    return (
        f'{speed:.4g} m/s is too fast here: the way ahead, {ahead:.4g} m, allows '
        f'{allowed**0.5:.4g} m/s at its start with a braking of {acceleration:.4g} m/s2 '
        '(rad for a rotation): stop first, or go further or straighter'
    )


def _climb(before: float, cell: tuple[float, float]) -> float:
    """Return the squared speed at the end of a cell: its bound, or what the ramp reaches."""
    bound, rise = cell
    reached = before + rise
    return bound if bound < reached else reached


def _with_corners(way: Column, ceiling: Column, lowest: Column, acceleration: float) -> SharpProfile:
    """Cut each cell at its corners: a ramp up, the ceiling, a ramp down, each as long as it is.

    Every piece keeps its own length, however short beside the way: told by the places of its ends
    a hard ramp would be lost, and with it the speed that it reaches.
    """
    slope = 2.0 * acceleration
    start, length = way[:-1], way[1:] - way[:-1]
    w0, w1, c0, c1 = lowest[:-1], lowest[1:], ceiling[:-1], ceiling[1:]
    peak = np.clip(0.5 * (length + (w1 - w0) / slope), 0.0, length)
    with np.errstate(all='ignore'):
        tilt = (c1 - c0) / length
        flat = c0 + tilt * peak < w0 + slope * peak  # the ceiling cuts the peak off
        up = np.where(flat, np.clip((c0 - w0) / (slope - tilt), 0.0, length), peak)
        down = np.where(flat, (c1 - w1) / (slope + tilt), length - peak)
    down = np.clip(down, 0.0, length - up)
    level = np.where(flat, np.maximum(length - up - down, 0.0), 0.0)
    top, end = w0 + slope * up, w1 + slope * down
    none = np.zeros(len(length))
    columns = (
        (start, start + up, way[1:] - down),
        (up, level, down),
        (w0, top, end),
        (top, end, w1),
        (none + acceleration, 0.5 * tilt, none - acceleration),
    )
    pieces = [np.stack(column, axis=1).ravel() for column in columns]
    keep = pieces[1] > ROUNDING * (way[-1] - way[0])
    start_speed, end = float(np.sqrt(lowest[0])), float(way[-1])
    return SharpProfile.of_pieces(
        *(column[keep] for column in pieces), start_speed=start_speed, end=end
    )


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
