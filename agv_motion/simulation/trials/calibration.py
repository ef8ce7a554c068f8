"""Drives whose true measures are known, to see whether a calibration's intervals hold them."""

from __future__ import annotations

from math import cos, nan, pi, sin
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.kinematics.omniwheel_placement import wheels_on_circle
from agv_motion.kinematics.omniwheels import OmniWheels
from agv_motion.kinematics.turrets import Turrets
from agv_motion.odometry.calibration import calibrate
from agv_motion.odometry.calibration_models import DifferentialModel, OmniModel, TurretModel
from agv_motion.odometry.calibration_recording import CalibrationDrive
from agv_motion.odometry.columns import matrix, pose_columns
from agv_motion.planar import Pose

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.calibration_models import CalibrationModel

Array = NDArray[np.float64]

OMNI, DIFFERENTIAL, TURRETS = BASES = 'omni', 'differential', 'turrets'
ANGLES = (pi / 6, 5 * pi / 6, 3 * pi / 2)
TREE = [(1.18 * cos(a), 1.18 * sin(a)) for a in (-pi / 4, pi / 4, pi)]
PERIOD = 0.1
"""[s] of a step"""
REFERENCE_EVERY = 10
"""steps"""
STEPS = 1200
SLIP = 0.005
"""[m] of a wheel after 1 m"""
POSITION_NOISE, HEADING_NOISE = 0.02, 0.01
"""[m], [rad] of a reference"""
APART = 0.2
"""[-] Deviation of a true measure from the drawing, as a share of the doubt about it."""
CARRIED = 2.0, 5.0
"""[m] How far a robot is carried."""
NINETY_FIVE = 1.96


class Conditions(NamedTuple):
    """Of a drive."""

    heading: bool = True
    """whether references tell it"""
    way: Array | None = None
    """(3, m) displacements as drawn [m, m, rad]; None means any"""
    slip: float = SLIP
    """[m] standard deviation of the travel of a wheel after 1 m"""
    carried: Sequence[int] = ()
    """references, counted from 0, before which somebody carries the robot"""


USUAL = Conditions()


class TrialDrive(NamedTuple):
    """A simulated drive."""

    model: CalibrationModel
    truth: Array
    """(p,) true values of the unknowns"""
    recording: CalibrationDrive


class Coverage(NamedTuple):
    """How well the intervals of many drives held."""

    held: int
    """true values within their 95 % interval"""
    told: int
    """values that a calibration gave as determined"""
    deviation: float
    """[-] of the errors in units of what was stated: 1 when all is well"""
    misfit: float
    """[-] mean of the drives; 1 when all is well"""
    cuts: int
    """places at which a robot was thought to have been carried"""


def simulate(base: str, seed: int, given: Conditions = USUAL) -> TrialDrive:
    """Return a drive: the wheels turn as told, the base slips on the way.

    Args:
        base: One of `BASES`.
        seed: Of everything that is left to chance.
        given: What the drive is like.

    """
    rng = np.random.default_rng(seed)
    way = _wandering(rng, forward_only=base == DIFFERENTIAL) if given.way is None else given.way
    model, turned, steering = _as_drawn(base, way)
    nominal, doubt = np.array([unknown[2:] for unknown in model.unknowns]).T
    truth = nominal + APART * doubt * rng.standard_normal(len(nominal))
    at_angles = np.zeros_like(turned) if steering is None else steering
    moved = model.displacement(truth, turned, at_angles)
    rolled = np.abs(model.radii[:, None] * turned).mean(axis=0)
    root = np.linalg.cholesky(matrix(model.unit_covariance))
    moved += given.slip * np.sqrt(rolled) * (root @ rng.standard_normal(moved.shape))
    start = Pose(*map(float, rng.uniform([-5.0, -5.0, -pi], [5.0, 5.0, pi])))
    taken = np.arange(0, way.shape[1] + 1, REFERENCE_EVERY)
    reference = pose_columns(moved, start)[:, taken]
    for first in given.carried:
        reference[:, first:] = _carried(rng, reference[:, first:])
    reference[:2] += POSITION_NOISE * rng.standard_normal(reference[:2].shape)
    reference[2] += HEADING_NOISE * rng.standard_normal(reference[2].shape)
    if not given.heading:
        reference[2] = nan
    noise = POSITION_NOISE, HEADING_NOISE
    return TrialDrive(model, truth, CalibrationDrive(turned, taken, reference, *noise, steering))


def coverage(base: str, seeds: Sequence[int], *, heading: bool, carried: bool) -> Coverage:
    """Return how well the intervals hold in one drive of every seed.

    Args:
        base: One of `BASES`.
        seeds: Of the drives.
        heading: Whether references tell it.
        carried: Whether somebody carries the robot, once or twice at any moment.

    """
    errors: list[float] = []
    misfits, cuts = [], 0
    for seed in seeds:
        rng = np.random.default_rng([seed, 1])
        last = STEPS // REFERENCE_EVERY
        moments = sorted(rng.permutation(np.arange(10, last - 10, 10))[: rng.integers(1, 3)])
        drive = simulate(base, seed, Conditions(heading, carried=moments if carried else ()))
        found = calibrate(drive.model, drive.recording, SLIP)
        misfits.append(found.misfit)
        cuts += found.carried
        errors += [
            (one.value - true) / one.deviation
            for one, true in zip(found.unknowns, drive.truth, strict=True)
            if one.determined
        ]
    held = int((np.abs(errors) < NINETY_FIVE).sum())
    return Coverage(held, len(errors), float(np.std(errors)), float(np.mean(misfits)), cuts)


def _wandering(rng: np.random.Generator, *, forward_only: bool) -> Array:
    """Return (3, m) displacements of a drive that changes its mind every two seconds."""
    speeds = rng.uniform(-1.0, 1.0, (3, STEPS // 20 + 1)) * [[0.5], [0.5], [0.8]]
    if forward_only:
        speeds[1] = 0.0
    return np.asarray(PERIOD * np.repeat(speeds, 20, axis=1)[:, :STEPS])


def _as_drawn(base: str, way: Array) -> tuple[CalibrationModel, Array, Array | None]:
    """Return a base, the turns of its wheels on a way as drawn [rad], and its steering [rad]."""
    if base == OMNI:
        wheels = OmniWheels(wheels_on_circle(ANGLES, [0.2] * 3))
        return OmniModel(wheels, [0.05] * 3), wheels.matrix @ way / 0.05, None
    if base == DIFFERENTIAL:
        turned = np.array([way[0] - way[2] * 0.2, way[0] + way[2] * 0.2]) / 0.1
        return DifferentialModel(0.4, [0.1, 0.1]), turned, None
    positions = np.array(TREE)
    x = way[0] - np.outer(positions[:, 1], way[2])
    y = way[1] + np.outer(positions[:, 0], way[2])
    return TurretModel(Turrets(TREE), [0.1] * 3), np.hypot(x, y) / 0.1, np.arctan2(y, x)


def _carried(rng: np.random.Generator, reference: Array) -> Array:
    """Return (3, k) poses as they are after somebody set the robot down elsewhere."""
    far, way, turn = rng.uniform(*CARRIED), rng.uniform(-pi, pi), rng.uniform(-pi, pi)
    at = reference[:2, :1]
    rotation = np.array([[cos(turn), -sin(turn)], [sin(turn), cos(turn)]])
    moved = rotation @ (reference[:2] - at) + at + [[far * cos(way)], [far * sin(way)]]
    return np.vstack([moved, reference[2:] + turn])
