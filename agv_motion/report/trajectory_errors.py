"""Absolute and relative errors of a trajectory, with the numbers of evo; numpy only.

The absolute pose error (APE) compares each pose with the one of the reference, the relative pose
error (RPE) the ways between two poses. Sources: R. Kümmerle et al., "On measuring the accuracy of
SLAM algorithms", Autonomous Robots 27, 2009; J. Sturm et al., "A benchmark for the evaluation of
RGB-D SLAM systems", IROS 2012; the conventions are those of M. Grupp's evo (`evo_ape`, `evo_rpe`).
How far a robot was from its Ghost, interpolated, is told by `run_errors`.
"""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import ConfigurationError
from agv_motion.report.stamped_poses import NANOSECOND, Array, StampedPoses, associate
from agv_motion.report.trajectory_alignment import Alignment, Similarity, align

Pairs = NDArray[np.intp]
"""(k, 2) rows of poses"""


class Relation(Enum):
    """What of a pose is compared."""

    TRANSLATION = 'translation'
    ROTATION = 'rotation'
    FULL = 'full'

    @property
    def unit(self) -> str:
        """Of the error; that of the whole transformation, [m] with [-], has none."""
        return {Relation.TRANSLATION: 'm', Relation.ROTATION: 'deg', Relation.FULL: ''}[self]


class DeltaUnit(Enum):
    """In what the way between two poses of the relative error is counted."""

    FRAMES = 'frames'
    METRES = 'metres'
    SECONDS = 'seconds'


class Delta(NamedTuple):
    """Between which poses the relative error is taken; counted along what was driven."""

    size: float = 1.0
    unit: DeltaUnit = DeltaUnit.FRAMES
    all_pairs: bool = False
    """From every pose on, not from where the last pair ended"""
    tolerance: float = 0.1
    """[-] share of ``size`` by which a pair of all pairs may be off"""


class ErrorStatistics(NamedTuple):
    """Of errors, in their unit; ``sse`` in its square."""

    rmse: float
    mean: float
    median: float
    std: float
    """of the population: divided by n"""
    min: float
    max: float
    sse: float
    """sum of the squares"""


class TrajectoryComparison(NamedTuple):
    """One trajectory beside its reference."""

    reference: StampedPoses
    """(n) what has a partner"""
    driven: StampedPoses
    """(n) its partners, laid over it"""
    similarity: Similarity
    """by which they were"""
    rows: NDArray[np.intp]
    """(k,) of the pose of each error; of a pair, the later"""
    errors: dict[Relation, Array]
    """(k,) each"""


class ComparisonRequest(NamedTuple):
    """How to compare."""

    within: float = 0.01
    """[s] as :func:`stamped_poses.associate`"""
    offset: float = 0.0
    """[s]"""
    alignment: Alignment = Alignment.NONE
    scaled: bool = False
    delta: Delta | None = None
    """None: absolute errors"""
    relations: tuple[Relation, ...] = (Relation.TRANSLATION, Relation.ROTATION)


def compare(
    reference: StampedPoses, driven: StampedPoses, request: ComparisonRequest
) -> TrajectoryComparison:
    """Return the errors of ``driven``.

    Raises:
        ConfigurationError: The frames differ and nothing lays one over the other, fewer than three
            poses belong together, they do not determine the alignment, or there are no pairs.

    """
    if request.alignment is Alignment.NONE and request.delta is None:
        _require_one_frame(reference, driven)
    reference, driven = associate(reference, driven, request.within, request.offset)
    driven, moved = align(reference, driven, request.alignment, scaled=request.scaled)
    if request.delta is None:
        rows = np.arange(len(driven.stamp))
        errors = {r: absolute_errors(reference, driven, r) for r in request.relations}
    else:
        found = pairs(driven, request.delta)
        rows = found[:, 1]
        errors = {r: relative_errors(reference, driven, found, r) for r in request.relations}
    return TrajectoryComparison(reference, driven, moved, rows, errors)


def _require_one_frame(reference: StampedPoses, driven: StampedPoses) -> None:
    if reference.frame.removeprefix('/') != driven.frame.removeprefix('/'):
        msg = (
            f"{reference.name} is in frame '{reference.frame}', {driven.name} in "
            f"'{driven.frame}': lay one over the other with --align origin, se2 or se3, choose "
            'another topic, or compare the ways between poses with --metric rpe'
        )
        raise ConfigurationError(msg)


def absolute_errors(reference: StampedPoses, driven: StampedPoses, relation: Relation) -> Array:
    """Return (n,) how far each pose is from its partner, in the unit of the relation."""
    turned = np.swapaxes(driven.rotation, 1, 2) @ reference.rotation
    return _size(driven.position - reference.position, turned, relation)


def relative_errors(
    reference: StampedPoses, driven: StampedPoses, between: Pairs, relation: Relation
) -> Array:
    """Return (k,) how far each way between two poses is from that of the reference."""
    (there, turn), (way, turned) = (_ways(poses, between) for poses in (reference, driven))
    return _size(way - there, np.swapaxes(turn, 1, 2) @ turned, relation)


def _ways(poses: StampedPoses, between: Pairs) -> tuple[Array, Array]:
    """Return (k, 3) places and (k, 3, 3) rotations of second poses, seen from the first."""
    first, second = between.T
    back = np.swapaxes(poses.rotation[first], 1, 2)
    moved = poses.position[second] - poses.position[first]
    return (back @ moved[:, :, None])[:, :, 0], back @ poses.rotation[second]


def _size(moved: Array, turned: Array, relation: Relation) -> Array:
    """Return (n,) the size of errors (n, 3) [m] and (n, 3, 3)."""
    if relation is Relation.TRANSLATION:
        return np.asarray(np.linalg.norm(moved, axis=1))
    if relation is Relation.FULL:  # the Frobenius norm of the 4x4 matrix less the identity
        square = np.sum((turned - np.eye(3)) ** 2, axis=(1, 2)) + np.sum(moved**2, axis=1)
        return np.asarray(np.sqrt(square))
    axis = turned[:, (2, 0, 1), (1, 2, 0)] - turned[:, (1, 2, 0), (2, 0, 1)]
    cosine = np.trace(turned, axis1=1, axis2=2) - 1.0
    return np.asarray(np.degrees(np.arctan2(np.linalg.norm(axis, axis=1), cosine)))


def pairs(driven: StampedPoses, delta: Delta) -> Pairs:
    """Return the pairs of poses that are ``delta`` apart, at least one.

    Consecutive pairs end where so much has been covered, and the next begins there; of all pairs
    each begins at another pose and ends at the one that fits best, if it fits within the tolerance.

    Raises:
        ConfigurationError: ``delta`` is no such distance, or there is no pair.

    """
    size, unit = delta.size, delta.unit
    if not 0.0 < size <= FARTHEST_DELTA:
        msg = f'--delta {size}: give a number above 0, at most {FARTHEST_DELTA:g}'
        raise ConfigurationError(msg)
    if unit is DeltaUnit.FRAMES and size != round(size):
        msg = f'--delta {size} of frames: give a whole number, or --unit metres or seconds'
        raise ConfigurationError(msg)
    if not 0.0 <= delta.tolerance < 1.0:
        msg = f'--tolerance {delta.tolerance}: give a share from 0 to below 1'
        raise ConfigurationError(msg)
    steps, goal = _steps(driven, unit), size
    if unit is DeltaUnit.SECONDS:
        goal = round(size / NANOSECOND)
    found = (
        _all_pairs(steps, goal, delta.tolerance * goal) if delta.all_pairs
        else _consecutive(steps, goal)
    )  # fmt: skip
    if not len(found):
        whole = float(steps.sum()) * (NANOSECOND if unit is DeltaUnit.SECONDS else 1.0)
        msg = f'{driven.name}: no poses are {size:g} {unit.value} apart'
        if delta.all_pairs:
            msg += f' within {100 * delta.tolerance:g} %'
        msg += f'; all cover {whole:.6g} {unit.value}: give a smaller --delta'
        raise ConfigurationError(msg + (' or a larger --tolerance' if delta.all_pairs else ''))
    return found


FARTHEST_DELTA = 1e9
"""frames, metres or seconds"""


def _steps(driven: StampedPoses, unit: DeltaUnit) -> NDArray[np.int64] | Array:
    """Return (n - 1,) what is covered from a pose to the next; times [ns]."""
    if unit is DeltaUnit.SECONDS:
        return np.diff(driven.stamp)
    if unit is DeltaUnit.METRES:
        return np.asarray(np.linalg.norm(np.diff(driven.position, axis=0), axis=1))
    return np.ones(len(driven.stamp) - 1, dtype=np.int64)


def _consecutive(steps: NDArray[np.int64] | Array, goal: float) -> Pairs:
    """Each is summed up anew, as evo does: a sum over all would round otherwise."""
    ends, covered = [0], 0
    for row, step in enumerate(steps.tolist(), start=1):
        covered += step
        if covered >= goal:
            ends.append(row)
            covered = 0
    return np.array([ends[:-1], ends[1:]], dtype=np.intp).T


def _all_pairs(steps: NDArray[np.int64] | Array, goal: float, tolerance: float) -> Pairs:
    covered = np.concatenate([np.zeros(1, steps.dtype), np.cumsum(steps)])
    first = np.arange(len(steps))
    last = len(steps)
    after = np.clip(np.searchsorted(covered, covered[:-1] + goal), first + 1, last)
    before = np.searchsorted(covered, covered[after - 1])  # the first there, where it rested
    before = np.maximum(before, first + 1)
    off = [np.abs(covered[second] - covered[:-1] - goal) for second in (before, after)]
    second = np.where(off[0] <= off[1], before, after)
    fits = np.minimum(*off) <= tolerance
    return np.stack([first[fits], second[fits]], axis=1)


def statistics(errors: Array) -> ErrorStatistics:
    """Return the statistics of at least one error, as evo names and defines them."""
    square = errors**2
    return ErrorStatistics(
        float(np.sqrt(np.mean(square))), float(np.mean(errors)), float(np.median(errors)),
        float(np.std(errors)), float(np.min(errors)), float(np.max(errors)), float(np.sum(square)),
    )  # fmt: skip
