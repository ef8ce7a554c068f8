"""Calibration of a base from a drive: what its measures really are, and how sure that is.

Non-linear least squares (Gauss-Newton) over the reference poses of the drive, with the noise of
references and of wheels as it is. The drawing enters as a faint measurement of its own, so a
motion that does not determine an unknown leaves it where it was, and says so.

Source: J. Borenstein, L. Feng, "Measurement and correction of systematic odometry errors in mobile
robots", IEEE Trans. Robot. Autom. 12(6), 1996, for the question; A. Martinelli et al.,
"Simultaneous localization and odometry self calibration", Auton. Robots 22(1), 2007.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import ConfigurationError
from agv_motion.odometry.calibration_cuts import carried_apart
from agv_motion.odometry.calibration_stretch import Stretch

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.calibration_models import CalibrationModel, Unknown
    from agv_motion.odometry.calibration_recording import CalibrationDrive

Array = NDArray[np.float64]

DETERMINED = 0.3
"""[-] The data determine what they make this much surer than the drawing was."""
UNTOLD = 0.5
"""[-] Variance, of that of the drawing, above which the data told less than the drawing did."""
CONVERGED = 1e-4
"""[-] Change of an unknown, as a share of its doubt, at which the iteration stops."""
CUTTINGS = 3
"""Of the drive where the robot was carried: by the drawing, then by what was found."""
SLIP_DOUBT = 3.0
"""[-] The slip may well be this many times what was assumed, or that part of it."""
SLIP_SHARES = np.geomspace(SLIP_DOUBT**-4, SLIP_DOUBT**4, 49)
"""[-] of the variance assumed that are compared"""
ITERATIONS = 10
ROUNDS = 4
"""Of leaving out outliers."""


class Calibrated(NamedTuple):
    """One unknown afterwards."""

    name: str
    unit: str
    nominal: float
    value: float
    """To be used together with the others': a combination that the motion told, such as a mean of
    several, is as found though none of its parts is determined"""
    deviation: float
    """Standard deviation of the value: in 95 of 100 drives the truth lies within 1.96 of it"""
    determined: bool
    """Whether the motion told more about it than the drawing"""


class Calibration(NamedTuple):
    """What a drive says of a base."""

    unknowns: tuple[Calibrated, ...]
    undetermined: tuple[tuple[str, ...], ...]
    """Each a set of unknowns of which the motion left a combination open, or one alone"""
    misfit: float
    """[-] mean squared error in units of the noise: 1 when noise and model are right"""
    references: int
    """How many reference poses were used"""
    outliers: int
    """How many were left out"""
    carried: int
    """How often the robot was carried, and the drive cut there"""
    slip: float
    """[m] Standard deviation of the travel of a wheel after 1 m that explains the errors best: the
    ``wheel_noise`` with which to fit again, where nothing better is known"""
    slip_is_open: bool
    """Whether even more slip would explain them better: then something else is wrong"""


def calibrate(
    model: CalibrationModel, recording: CalibrationDrive, wheel_noise: float = 0.005
) -> Calibration:
    """Return the unknowns of a base that fit a drive best.

    Args:
        model: The base as drawn.
        recording: The drive.
        wheel_noise: Standard deviation of the travel of a wheel after 1 m [m].

    Raises:
        ConfigurationError: The noise is not above 0, the recording has another number of wheels,
            or fewer numbers than there are unknowns.
        SignalError: The recording is malformed.

    """
    _require(model, recording, wheel_noise)
    values = np.array([unknown.nominal for unknown in model.unknowns])
    before: list[NDArray[np.int_]] = []
    for _ in range(CUTTINGS):
        parts = carried_apart(model, recording, values)
        if len(parts) == len(before) and all(map(np.array_equal, parts, before)):
            break
        found = _fitted(model, recording, parts, wheel_noise)
        values, before = np.array([unknown.value for unknown in found.unknowns]), parts
    return found


def _fitted(
    model: CalibrationModel,
    recording: CalibrationDrive,
    parts: Sequence[NDArray[np.int_]],
    wheel_noise: float,
) -> Calibration:
    """Return the fit to the parts of a drive, each some references, between its cuts."""
    stretches = [
        Stretch(model, stretch, wheel_noise)
        for part in parts
        for stretch in recording.part(part).stretches()
    ]
    nominal = np.array([unknown.nominal for unknown in model.unknowns])
    doubt = np.array([unknown.doubt for unknown in model.unknowns])
    values = nominal.copy()
    outliers = len(recording.reference_step) - sum(map(len, parts))
    drawn = np.concatenate([stretch.rows(nominal)[0] for stretch in stretches]) * doubt
    for _ in range(ROUNDS):
        values, slope, error = _settle(stretches, values, nominal, doubt)
        dropped = sum(stretch.drop_outliers(values) for stretch in stretches)
        outliers += dropped
        if not dropped:
            break
    count = len(error) - 3 * len(stretches)
    misfit = float(error @ error) / max(count, 1)
    spreads = _spread(slope, misfit), _spread(drawn, misfit)
    values = nominal + doubt * _as_told((values - nominal) / doubt, *spreads)
    share = _slip_share(stretches)
    return Calibration(
        tuple(_calibrated(model.unknowns, values, *spreads)),
        tuple(_undetermined(model.unknowns, max(spreads, key=np.trace))),
        misfit,
        sum(stretch.references for stretch in stretches),
        outliers,
        len(parts) - 1,
        wheel_noise * share**0.5,
        share == SLIP_SHARES[-1],
    )


def _slip_share(stretches: Sequence[Stretch]) -> float:
    """Return the likeliest share of the variance of slip that was assumed."""
    unlikely = (np.log(SLIP_SHARES) / (2.0 * np.log(SLIP_DOUBT))) ** 2
    for stretch in stretches:
        unlikely = unlikely + stretch.slip_unlikeliness(SLIP_SHARES)
    return float(SLIP_SHARES[unlikely.argmin()])


def _settle(
    stretches: Sequence[Stretch], values: Array, nominal: Array, doubt: Array
) -> tuple[Array, Array, Array]:
    """Return values, and derivative (in units of the doubts) and error there, by Gauss-Newton."""
    for _ in range(ITERATIONS):
        parts = [stretch.rows(values) for stretch in stretches]
        slope = np.concatenate([rows for rows, _ in parts]) * doubt
        error = np.concatenate([errors for _, errors in parts])
        from_drawing = (nominal - values) / doubt
        change, *_ = np.linalg.lstsq(
            np.concatenate([slope, np.eye(len(doubt))]),
            np.concatenate([error, from_drawing]),
            rcond=None,
        )
        values = values + doubt * change
        for stretch in stretches:
            stretch.follow(doubt * change)
        if np.abs(change).max() < CONVERGED:
            break
    return values, slope, error


def _spread(slope: Array, misfit: float) -> Array:
    """Return the covariance of the unknowns, in units of their doubts."""
    information = slope.T @ slope / max(misfit, 1.0) + np.eye(slope.shape[1])
    return np.asarray(np.linalg.inv(information), dtype=np.float64)


def _calibrated(
    unknowns: Sequence[Unknown], values: Array, spread: Array, drawn: Array
) -> list[Calibrated]:
    """Return each unknown with its deviation; determined is what would be so as drawn as well.

    A common zero offset of all turrets only shortens turns, by its cosine: at the drawing that
    says nothing of it, and what it seems to say elsewhere is not to be trusted.
    """
    shares, as_drawn = np.sqrt(np.diag(_opened(spread))), np.sqrt(np.diag(drawn))
    shares = np.where(as_drawn < DETERMINED, shares, np.maximum(shares, as_drawn))
    return [
        Calibrated(
            unknown.name,
            unknown.unit,
            unknown.nominal,
            float(value),
            float(share * unknown.doubt),
            bool(share < DETERMINED),
        )
        for unknown, value, share in zip(unknowns, values, shares, strict=True)
    ]


def _as_told(change: Array, spread: Array, drawn: Array) -> Array:
    """Return a change, in units of the doubts, without its part along what the motion left open.

    Where the motion told less than the drawing, that part is mostly noise. And a combination that
    was open as drawn, and that the motion tells only where the estimate has come to, is of the bend
    of the model: see :func:`_calibrated`.
    """
    for direction in (*_directions(spread, UNTOLD), *_directions(drawn, DETERMINED**2)):
        change = change - direction * (direction @ change)
    return change


def _opened(spread: Array) -> Array:
    """Return a covariance that is as doubtful as the drawing, 1, where that tells more."""
    for direction in _directions(spread, UNTOLD):
        left = 1.0 - direction @ spread @ direction
        spread = spread + left * np.outer(direction, direction)
    return spread


def _directions(spread: Array, least: float) -> Array:
    """Return (k, p) unit vectors, in units of the doubts, along which the variance is above one."""
    variances, directions = np.linalg.eigh(spread)
    return np.asarray(directions.T[variances > least], dtype=np.float64)


def _undetermined(unknowns: Sequence[Unknown], spread: Array) -> list[tuple[str, ...]]:
    """Return the names that take part in each direction along which little was learnt."""
    return [
        tuple(
            unknown.name
            for unknown, part in zip(unknowns, direction, strict=True)
            if abs(part) > DETERMINED
        )
        for direction in _directions(spread, DETERMINED**2)
    ]


def _require(model: CalibrationModel, recording: CalibrationDrive, wheel_noise: float) -> None:
    if not 0.0 < wheel_noise < np.inf:
        msg = f'wheel_noise = {wheel_noise} m: must be finite and above 0'
        raise ConfigurationError(msg)
    if len(recording.turned) != len(model.radii):
        msg = f'{len(recording.turned)} wheels recorded, {len(model.radii)} in the model'
        raise ConfigurationError(msg)
    numbers = int(np.isfinite(recording.reference).sum()) - 3
    if numbers < len(model.unknowns):
        msg = (
            f'{len(recording.reference_step)} references are too few for {len(model.unknowns)} '
            'unknowns: record a longer drive'
        )
        raise ConfigurationError(msg)
