"""Turret kinematics over columns: a whole recording at once, the equations of `turrets`.

Columns are worked through in blocks that stay in the processor's cache, and `tan` of the half
angle gives sine and cosine together: float64 `sin`, `cos` and `hypot` of numpy are the slow ones.
Fresh memory for the result costs as much as half the computation, so ``out`` can be used again.
"""

from __future__ import annotations

from sys import float_info
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from agv_motion.errors import SignalError
from agv_motion.kinematics.speed_limit import require_wheel_speed
from agv_motion.kinematics.twist_fit import fitted, require_columns
from agv_motion.planar import STANDSTILL, require_finite

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.kinematics.turrets import Turrets
    from agv_motion.kinematics.twist_fit import Column, TwistColumns

BLOCK = 16384
"""Rows worked on at a time: half a dozen such columns fit the second-level cache."""


class TurretColumns(NamedTuple):
    """Commands of every turret over time; one row a turret, so that a row is a column of a plot."""

    angle: Column
    """(n_turrets, n) [rad]"""
    speed: Column
    """(n_turrets, n) [m/s]"""


def polar_to_cartesian(v: Column, theta: Column) -> tuple[Column, Column]:
    """Return ``(v cos(theta), v sin(theta))`` by the tangent of the half angle.

    With ``t = tan(theta / 2)``: ``cos = (1 - t*t) / (1 + t*t)`` and ``sin = 2 t / (1 + t*t)``.
    """
    t = np.tan(0.5 * theta)
    scale = v / (1.0 + t * t)
    return scale * (1.0 - t * t), scale * (2.0 * t)


def command_columns(
    turrets: Turrets,
    twist: Column | tuple[Column, Column, Column],
    held_angles: Sequence[float] | None = None,
    max_wheel_speed: float = float_info.max,
    out: TurretColumns | None = None,
) -> TurretColumns:
    """Return angle and speed of each turret for each row of a twist in columns.

    Rows are successive in time: where a wheel stands still it keeps the angle of the row before.
    A row with a wheel above its limit is scaled as a whole.

    Args:
        turrets: The platform.
        twist: (3, n) or three columns (n,): vx [m/s], vy [m/s], wz [rad/s].
        held_angles: (n_turrets,) steering angles before the first row [rad]; zeros by default.
        max_wheel_speed: Limit of every wheel [m/s].
        out: Result of an earlier call of the same size, to be overwritten.

    Raises:
        SignalError: Columns differ in length, or a value of theirs or of ``held_angles`` is not
            finite.
        ConfigurationError: ``max_wheel_speed`` is not above 0.

    """
    require_wheel_speed(max_wheel_speed)
    vx, vy, wz = (np.ascontiguousarray(column, dtype=float) for column in twist)
    if vx.ndim != 1 or not vx.shape == vy.shape == wz.shape:
        msg = f'twist columns have shapes {vx.shape}, {vy.shape}, {wz.shape}: give one shape (n,)'
        raise SignalError(msg)
    held = np.zeros(len(turrets)) if held_angles is None else np.array(held_angles, dtype=float)
    shape = (len(turrets), len(vx))
    if held.shape != shape[:1]:
        msg = f'{held.size} held angles for {len(turrets)} turrets: give one each'
        raise SignalError(msg)
    require_finite('held_angles', tuple(held.tolist()))
    if out is None:
        out = TurretColumns(np.empty(shape), np.empty(shape))
    elif out.angle.shape != shape or out.speed.shape != shape:
        msg = f'out has shape {out.angle.shape}, this call needs {shape}: leave it out'
        raise SignalError(msg)
    scratch = np.empty((2, min(BLOCK, len(vx))))
    for start in range(0, len(vx), BLOCK):
        rows = slice(start, start + BLOCK)
        angle, speed = out.angle[:, rows], out.speed[:, rows]
        with np.errstate(over='ignore', invalid='ignore'):  # what becomes infinite is refused
            _roll(turrets, (vx[rows], vy[rows], wz[rows]), angle, speed, scratch)
        _limit(speed, max_wheel_speed, start)
        _hold(angle, speed, held)
        held = angle[:, -1].copy()
    return out


def twist_columns(turrets: Turrets, angles: Column, speeds: Column) -> TwistColumns:
    """Return the twist that fits each row of measured turrets best.

    Args:
        turrets: The platform.
        angles: (n_turrets, n) steering angles [rad].
        speeds: (n_turrets, n) rolling speeds along them [m/s].

    Raises:
        SignalError: Another shape, or a value that is not finite (its row is named).

    """
    angles = require_columns('angles', angles, len(turrets))
    speeds = require_columns('speeds', speeds, len(turrets))
    if angles.shape != speeds.shape:
        msg = f'{angles.shape[1]} rows of angles and {speeds.shape[1]} of speeds: give both'
        raise SignalError(msg)
    with np.errstate(over='ignore', invalid='ignore'):  # what becomes infinite is refused
        vx, vy, wz, residual = turrets.solve_columns(angles, speeds)
    return fitted(np.stack((vx, vy, wz)), residual)


def _roll(
    turrets: Turrets,
    twist: tuple[Column, Column, Column],
    angle: Column,
    speed: Column,
    scratch: Column,
) -> None:
    """Fill ``angle`` and ``speed`` by v_i = (vx - wz y_i, vy + wz x_i)."""
    vx, vy, wz = twist
    wheel_x, wheel_y = scratch[:, : len(vx)]
    for i, (x, y) in enumerate(turrets.positions):
        np.multiply(wz, y, out=wheel_x)
        np.subtract(vx, wheel_x, out=wheel_x)
        np.multiply(wz, x, out=wheel_y)
        np.add(vy, wheel_y, out=wheel_y)
        np.arctan2(wheel_y, wheel_x, out=angle[i])
        np.multiply(wheel_x, wheel_x, out=wheel_x)
        np.multiply(wheel_y, wheel_y, out=wheel_y)
        np.add(wheel_x, wheel_y, out=wheel_x)
        np.sqrt(wheel_x, out=speed[i])


def _limit(speed: Column, max_wheel_speed: float, first_row: int) -> None:
    """Scale each row above the limit as a whole; refuse what is not finite."""
    top = speed.max()
    if not np.isfinite(top):
        row = first_row + int(np.argmin(np.isfinite(speed).all(axis=0)))
        msg = f'twist columns are not finite at row {row}: drop that row'
        raise SignalError(msg)
    if top > max_wheel_speed:
        fastest = speed.max(axis=0)
        speed *= max_wheel_speed / np.maximum(fastest, max_wheel_speed)


def _hold(angle: Column, speed: Column, held: Column) -> None:
    """Let each wheel at standstill keep the angle of the last row in which it moved."""
    if speed.min() > STANDSTILL:
        return
    rows = np.arange(speed.shape[1])
    for i in range(len(angle)):
        last_moving = np.maximum.accumulate(np.where(speed[i] > STANDSTILL, rows, -1))
        angle[i] = np.where(last_moving >= 0, angle[i][last_moving], held[i])
