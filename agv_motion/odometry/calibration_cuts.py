"""Where a robot was carried during a drive: there the wheels and the places part for good.

As the fusion does, several references in a row are asked whether one placing of the path of the
wheels explains them (a consensus): a robot that was carried needs one before and another after. A
reference that no placing explains, alone or taken on the way of the carrying, is left out.

Source: M. Fischler, R. Bolles, "Random sample consensus", Comm. ACM 24(6), 1981; here all pairs.
"""

from __future__ import annotations

from itertools import combinations, pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.odometry.columns import pose_columns

if TYPE_CHECKING:
    from agv_motion.odometry.calibration_models import CalibrationModel
    from agv_motion.odometry.calibration_recording import CalibrationDrive

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

WINDOW = 9
"""References in a row that one placing is to explain."""
AGREEING = 6
"""Of them that it must explain; if it explains fewer, somebody carried the robot."""
SHARES = 0.01, 0.02, 0.05, 0.1
"""[-] How wrong lengths may be: as a calibration leaves them, and up to a bad drawing."""
LEAST = 3
"""References between which a robot was left alone, or they tell nothing."""
EXPLAINED = 0.8
"""[-] of the references must be explained: outliers are not, nor places on the way."""
GATE = 5.0
"""[-] Deviations of a reference beyond which a placing does not explain it."""


class _Path(NamedTuple):
    """Windows of w references: what the wheels say, and what was measured."""

    wheels: NDArray[np.complex128]
    """(n, w) place [m] by the wheels"""
    places: NDArray[np.complex128]
    """(n, w) place [m] that was measured"""
    turns: Array
    """(n, w) measured heading less that by the wheels [rad]; NaN where it is not known"""
    far: Array
    """(n, 1) distance beyond which a place disagrees [m]"""
    turned: Array
    """(n, 1) angle beyond which a heading disagrees [rad]"""


def carried_apart(
    model: CalibrationModel, recording: CalibrationDrive, values: Array
) -> list[NDArray[np.int_]]:
    """Return groups of references (their indices) between which nobody carried the robot.

    The tighter the doubt about the unknowns, the less far a robot need be carried to be noticed: so
    the tightest is taken that still explains most references. Where none does, the drive is whole.

    Args:
        model: The base.
        recording: The drive.
        values: (p,) the unknowns of the base.

    """
    count = len(recording.reference_step)
    if count >= WINDOW:
        for share in SHARES:
            parts = _apart(model, recording, values, share)
            if sum(map(len, parts)) >= EXPLAINED * count:
                return parts
    return [np.arange(count)]


def _apart(
    model: CalibrationModel, recording: CalibrationDrive, values: Array, share: float
) -> list[NDArray[np.int_]]:
    """Return the groups when lengths may be wrong by a share of themselves."""
    agreeing = _consensus(_windows(model, recording, values, share))
    rows, columns = np.nonzero(agreeing)
    kept = np.unique(rows + columns)
    linked = [_is_linked(agreeing, a, b) for a, b in pairwise(kept)]
    return groups(kept, np.array(linked, dtype=bool))


def _is_linked(agreeing: Mask, a: int, b: int) -> bool:
    """Return whether one placing explains both references."""
    windows = range(max(b - WINDOW + 1, 0), min(a, len(agreeing) - 1) + 1)
    return any(agreeing[j, a - j] and agreeing[j, b - j] for j in windows)


def groups(kept: NDArray[np.int_], linked: Mask) -> list[NDArray[np.int_]]:
    """Return references in groups of neighbours that are linked; less than three tell nothing.

    Args:
        kept: (n,) indices of references.
        linked: (n - 1,) whether each belongs together with the next.

    """
    parts = np.split(kept, np.flatnonzero(~linked) + 1)
    return [part for part in parts if len(part) >= LEAST]


def _windows(
    model: CalibrationModel, recording: CalibrationDrive, values: Array, share: float
) -> _Path:
    turned = recording.turned
    steering = np.zeros_like(turned) if recording.steering is None else recording.steering
    moved = model.displacement(values, turned, steering)
    step = recording.reference_step
    x, y, heading = pose_columns(moved)[:, step]
    way, turn = (
        np.concatenate([[0.0], np.cumsum(part)])[step]
        for part in (np.hypot(moved[0], moved[1]), np.abs(moved[2]))
    )
    last = WINDOW - 1
    turn, way = turn[last:] - turn[:-last], way[last:] - way[:-last]
    measured_x, measured_y, measured = recording.reference

    def windows(column: NDArray[Any]) -> NDArray[Any]:
        return np.lib.stride_tricks.sliding_window_view(column, WINDOW)

    return _Path(
        windows(x + 1j * y),
        windows(measured_x + 1j * measured_y),
        windows(measured - heading),
        (GATE * recording.position_noise + share * way * (1.0 + turn))[:, None],
        (GATE * recording.heading_noise + share * (1.0 + turn))[:, None],
    )


def _consensus(path: _Path) -> Mask:
    """Return (n, w) which references agree; all False in a window without enough of them."""
    best = np.zeros(path.wheels.shape, dtype=bool)
    for placing in _placings(path):
        agreeing = _agreeing(path, *placing)
        better = agreeing.sum(axis=1) > best.sum(axis=1)
        best[better] = agreeing[better]
    refined = _agreeing(path, *_fitted(path, best))
    best = np.where((refined.sum(axis=1) >= best.sum(axis=1))[:, None], refined, best)
    return np.asarray(best & (best.sum(axis=1) >= AGREEING)[:, None])


def _placings(path: _Path) -> list[tuple[NDArray[np.complex128], NDArray[np.complex128]]]:
    """Return rotation and translation, each (n, 1), by every reference, or by every pair."""
    found = []
    for i in range(WINDOW):
        rotation = np.exp(1j * np.nan_to_num(path.turns[:, i]))
        found.append(
            (rotation[:, None], (path.places[:, i] - rotation * path.wheels[:, i])[:, None])
        )
    for i, j in combinations(range(WINDOW), 2):
        ratio = (path.places[:, j] - path.places[:, i]) * np.conj(
            path.wheels[:, j] - path.wheels[:, i]
        )
        rotation = np.exp(1j * np.angle(ratio))
        middle = 0.5 * (path.places[:, i] + path.places[:, j])
        middle = middle - rotation * 0.5 * (path.wheels[:, i] + path.wheels[:, j])
        found.append((rotation[:, None], middle[:, None]))
    return found


def _fitted(path: _Path, chosen: Mask) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Return the placing by least squares over the chosen places."""
    weight = chosen / np.maximum(chosen.sum(axis=1), 1)[:, None]
    from_, to = ((weight * column).sum(axis=1)[:, None] for column in (path.wheels, path.places))
    turn = (weight * (path.places - to) * np.conj(path.wheels - from_)).sum(axis=1)
    rotation = np.exp(1j * np.angle(turn))[:, None]
    return rotation, to - rotation * from_


def _agreeing(
    path: _Path, rotation: NDArray[np.complex128], translation: NDArray[np.complex128]
) -> Mask:
    """Return (n, w) which references a placing explains."""
    near = np.abs(path.places - rotation * path.wheels - translation) <= path.far
    away = np.angle(np.exp(1j * path.turns) * np.conj(rotation))
    return np.asarray(near & ~(np.abs(away) > path.turned))
