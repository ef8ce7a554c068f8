"""Finding where `odom` lies in `map` from nothing but fixes: at the start, and after kidnapping.

One heading and one shift must lay the way that odometry saw over the fixes. Each fix together with
the newest one proposes a heading; the proposal that most fixes agree with wins, so outliers have
no say, and least squares over those that agree refine it. Without headings among the fixes the
robot must move before its own is known: the covariance tells.

Source: M. A. Fischler, R. C. Bolles, "Random sample consensus", Comm. ACM 24(6), 1981, with every
pair instead of random ones; S. Umeyama, "Least-squares estimation of transformation parameters
between two point patterns", IEEE Trans. PAMI 13(4), 1991, for the problem.
"""

from __future__ import annotations

from math import hypot, pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.odometry.belief import Belief, believe
from agv_motion.odometry.chi_square import chi_square_quantile
from agv_motion.odometry.covariance import Covariance, shift
from agv_motion.planar import Pose, wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.fix import Fix
    from agv_motion.odometry.history import Waypoint

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

GATE = chi_square_quantile(0.999, 2)
ROUNDS = 3
"""Of refining by those that agree, and asking again which those are."""
UNKNOWN = pi * pi / 3.0
"""[rad2] Variance of a heading that may be any."""


class FixAtPose(NamedTuple):
    """A fix, and where odometry saw the robot at that time."""

    fix: Fix
    waypoint: Waypoint


class _Columns(NamedTuple):
    """Sightings as arrays, one row each, odometry relative to the newest position."""

    measured: Array
    """(n, 2) in `map` [m]"""
    lever: Array
    """(n, 2) from the newest position, axes of `odom` [m]"""
    information: Array
    """(n, 2, 2) inverse covariance of a measured position, odometry's noise since included"""
    turn: Array
    """(n,) measured heading less that in `odom` [rad]; 0 where not measured"""
    turn_information: Array
    """(n,) of it; 0 where not measured"""


def thin(sightings: list[FixAtPose]) -> None:
    """Drop the sighting whose neighbours are nearest to each other: the whole way stays covered.

    Args:
        sightings: In the order of time, three or more; changed in place.

    """
    places = [sighting.waypoint.pose for sighting in sightings]
    gaps = [
        hypot(after.x - before.x, after.y - before.y)
        for before, after in zip(places, places[2:], strict=False)
    ]
    del sightings[1 + gaps.index(min(gaps))]


def align(sightings: Sequence[FixAtPose], heading: float, needed: int) -> Belief | None:
    """Return where `odom` lies in `map` by those sightings that agree, as of the newest.

    Args:
        sightings: In the order of time.
        heading: Of `odom` in `map` [rad], to assume where the fixes tell none.
        needed: How many sightings must agree.

    Returns:
        The belief; None when fewer agree.

    """
    columns = _columns(sightings)
    position, turn, agreeing = _consensus(columns, heading)
    for _ in range(ROUNDS):
        if agreeing.sum() < needed:
            return None
        position, turn, spread = _refine(columns, agreeing, position, turn)
        missed = columns.measured - position - columns.lever @ _rotation(turn).T
        agreeing = np.einsum('ni,nij,nj->n', missed, columns.information, missed) <= GATE
    newest = sightings[-1].waypoint
    pose = Pose(float(position[0]), float(position[1]), wrap(turn + newest.pose.theta))
    return believe(pose, Covariance(*map(float, spread[np.triu_indices(3)])), newest)


def _columns(sightings: Sequence[FixAtPose]) -> _Columns:
    newest = sightings[-1].waypoint
    rows = []
    for fix, (_, pose, noise) in sightings:
        since = Covariance(*[now - then for now, then in zip(newest.noise, noise, strict=True)])
        walked = shift(since, pose.x, pose.y)
        xx, xy, _, yy, _, tt = fix.covariance
        along = 0.5 * (walked.xx + walked.yy)
        position = [[xx + along, xy], [xy, yy + along]]
        known = fix.heading is not None
        rows.append((
            (fix.x, fix.y),
            (pose.x - newest.pose.x, pose.y - newest.pose.y),
            position,
            wrap(fix.heading - pose.theta) if fix.heading is not None else 0.0,
            1.0 / (tt + walked.tt) if known else 0.0,
        ))  # fmt: skip
    measured, lever, covariance, turn, turn_information = map(np.array, zip(*rows, strict=True))
    return _Columns(measured, lever, np.linalg.inv(covariance), turn, turn_information)


def _rotation(turn: Array | float) -> Array:
    """Return the rotation matrix (2, 2) of an angle [rad], or (k, 2, 2) those of k angles."""
    c, s = np.cos(turn), np.sin(turn)
    return np.moveaxis(np.array([[c, -s], [s, c]]), (0, 1), (-2, -1))


def _proposals(columns: _Columns, heading: float) -> Array:
    """Return (k,) headings of `odom` in `map` that are worth a try [rad]."""
    deviation = np.sqrt(2.0 / np.trace(columns.information[-1]))
    far = np.hypot(*columns.lever.T) > 4.0 * deviation
    measured, lever = columns.measured[far] - columns.measured[-1], columns.lever[far]
    turns = np.arctan2(measured[:, 1], measured[:, 0]) - np.arctan2(lever[:, 1], lever[:, 0])
    return np.array([heading, *columns.turn[columns.turn_information > 0.0], *turns])


def _consensus(columns: _Columns, heading: float) -> tuple[Array, float, Mask]:
    """Return position, heading and the sightings that agree, of the best proposal.

    The newest fix is as uncertain as the others, hence twice the gate.
    """
    position, turns = columns.measured[-1], _proposals(columns, heading)
    missed = columns.measured - position - columns.lever @ _rotation(turns).swapaxes(1, 2)
    distances = np.einsum('kni,nij,knj->kn', missed, columns.information, missed)
    agreeing = distances <= 2.0 * GATE
    best = int(np.argmax(agreeing.sum(axis=1)))
    return position, float(turns[best]), agreeing[best]


def _refine(
    columns: _Columns, agreeing: Mask, position: Array, turn: float
) -> tuple[Array, float, Array]:
    """Return position, heading and their covariance by Gauss-Newton over the agreeing sightings.

    A heading that nothing determines stays where it was, with the variance of any heading.
    """
    measured, lever, weights, turns, turn_weights = (column[agreeing] for column in columns)
    for _ in range(2):
        arm = lever @ _rotation(turn).T
        rows = np.zeros((len(arm), 2, 3))
        rows[:, 0, 0] = rows[:, 1, 1] = 1.0
        rows[:, 0, 2], rows[:, 1, 2] = -arm[:, 1], arm[:, 0]
        weighted = np.swapaxes(rows, 1, 2) @ weights
        information = (weighted @ rows).sum(axis=0)
        pull = np.einsum('nij,nj->i', weighted, measured - position - arm)
        away = (turns - turn + pi) % (2.0 * pi) - pi
        information[2, 2] += turn_weights.sum() + 1.0 / UNKNOWN
        pull[2] += turn_weights @ away
        change = np.linalg.solve(information, pull)
        position, turn = position + change[:2], turn + float(change[2])
    return position, turn, np.linalg.inv(information)
