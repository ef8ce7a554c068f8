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
from agv_motion.trajectory.bounds import AT_ONCE
from agv_motion.trajectory.profile import Profile, RoundedProfile, SharpProfile

if TYPE_CHECKING:
    from agv_motion.trajectory.bezier import Column

ROUNDING = 1e-15
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
        acceleration: Highest speeding up and braking, positive [m/s2]; `AT_ONCE`: without ramps.
        start_speed: Present speed [m/s].
        rounding: Time over which acceleration builds up [s]; 0 for a trapezoid.

    Raises:
        GeometryError: The way is too short, or bends too soon, to brake from ``start_speed``.

    """
    acceleration = min(acceleration, AT_ONCE)
    if len(way) == 2 and ceiling[0] == ceiling[1]:
        start = 0.5 * start_speed * rounding
        ends = start, float(way[-1])
        trapezoid = _trapezoid(ends, float(ceiling[0]), acceleration, start_speed)
        return RoundedProfile(trapezoid, rounding) if rounding > 0.0 else trapezoid
    square = ceiling * ceiling
    lowest = _lowest(way, square, acceleration, start_speed)
    if rounding > 0.0:
        # the mean of a sharp profile over T seconds stands at most this far from its moments
        fastest = np.minimum(np.sqrt(lowest) + acceleration * rounding, np.sqrt(square.max()))
        reach = 0.5 * fastest * rounding
        square = _with_neighbours(_lowest_within(way, square, reach))
        start = 0.5 * start_speed * rounding
        after = way > start
        square = np.append(np.interp(start, way, square), square[after])
        way = np.append(start, way[after])
        lowest = _lowest(way, square, acceleration, start_speed)
    sharp = _with_corners(way, square, lowest, acceleration)
    return RoundedProfile(sharp, rounding) if rounding > 0.0 else sharp


def _with_neighbours(square: Column) -> Column:
    """Return the least of each node and the next ones: then no point between two is too high."""
    padded = np.pad(square, 1, mode='edge')
    least: Column = np.minimum(np.minimum(padded[:-2], padded[2:]), square)
    return least


def _trapezoid(
    ends: tuple[float, float], top: float, acceleration: float, start_speed: float
) -> SharpProfile:
    """Return what :func:`_with_corners` does for one cell under a flat ceiling, ten times sooner.

    Args:
        ends: Way at the start and where it rests [m].
        top: The ceiling [m/s].
        acceleration: As of :func:`plan_speed`.
        start_speed: As of :func:`plan_speed`.

    """
    begin, end = ends
    length, slope, start, square = end - begin, 2.0 * acceleration, start_speed**2, top * top
    allowed = min(start, slope * max(length, 0.0), square * (1.0 + 1e-9))
    if length <= 0.0 or allowed < start * (1.0 - 1e-9) - 1e-12:
        raise GeometryError(_too_fast(start_speed, length, allowed, acceleration))
    up = min(max(0.5 * (length - start / slope), 0.0), length)
    down = length - up
    if square < start + slope * up:
        up, down = max((square - start) / slope, 0.0), square / slope
    summit = (start + slope * up) ** 0.5
    pieces = (
        (up, start_speed, summit, acceleration),
        (length - up - down, summit, summit, 0.0),
        (down, summit, 0.0, -acceleration),
    )
    times, ways, speeds, accelerations = [0.0], [begin], [start_speed], [0.0]
    for piece, first, last, rate in pieces:
        if piece > ROUNDING * length:
            speeds[-1], accelerations[-1] = first, rate
            times.append(times[-1] + 2.0 * piece / (first + last))
            ways.append(ways[-1] + piece)
            speeds.append(last)
            accelerations.append(0.0)
    ways[-1], speeds[-1] = end, 0.0
    if speeds[0] != start_speed:  # before the start it came with this speed
        times, ways = [0.0, *times], [begin, *ways]
        speeds, accelerations = [start_speed, *speeds], [0.0, *accelerations]
    return SharpProfile(times, ways, speeds, accelerations)


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
    forward = _climb(bound, rises)
    lowest: Column = np.array(_climb(forward[::-1], rises[::-1])[::-1])
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


def _climb(bounds: list[float], rises: list[float]) -> list[float]:
    """Return the squared speed at each node: its bound, or what a ramp reaches from the last."""
    reached = bounds[0]
    climbed = [reached]
    for bound, rise in zip(bounds[1:], rises, strict=True):
        reached += rise
        if reached > bound:  # noqa: PLR1730 - min() costs four times as much
            reached = bound
        climbed.append(reached)
    return climbed


def _with_corners(
    way: Column, ceiling: Column, lowest: Column, acceleration: float
) -> SharpProfile:
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
    summit, brink = w0 + slope * up, w1 + slope * down
    none = np.zeros(len(length))
    columns = (
        (start, start + up, way[1:] - down),
        (up, level, down),
        (w0, summit, brink),
        (summit, brink, w1),
        (none + acceleration, 0.5 * tilt, none - acceleration),
    )
    pieces = [np.stack(column, axis=1).ravel() for column in columns]
    keep = pieces[1] > ROUNDING * (way[-1] - way[0])
    return SharpProfile.of_pieces(
        *(column[keep] for column in pieces),
        start_speed=float(np.sqrt(lowest[0])),
        end=float(way[-1]),
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
