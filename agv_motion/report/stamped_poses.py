"""Poses in space by their stamps, and which of two robots' belong together; numpy only."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import ConfigurationError, SourceError
from agv_motion.planar import FARTHEST

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Array = NDArray[np.float64]
Stamps = NDArray[np.int64]

FEWEST = 3
"""Associated poses below which nothing is said: two fit each other in too many ways."""
NANOSECOND = 1e-9
"""[s]"""
UNIT = 0.01
"""By which the length of a quaternion may differ from 1."""


class StampedPoses(NamedTuple):
    """Where a robot was, in the order of time."""

    name: str
    frame: str
    stamp: Stamps
    """(n,) [ns], each greater than the one before"""
    position: Array
    """(n, 3) [m]"""
    rotation: Array
    """(n, 3, 3) of the robot, seen from the frame"""

    def picked(self, rows: NDArray[np.intp]) -> StampedPoses:
        """Return some of them."""
        return self._replace(
            stamp=self.stamp[rows], position=self.position[rows], rotation=self.rotation[rows]
        )


def stamped_poses(
    name: str, frame: str, stamp: Stamps, position: ArrayLike, quaternion: ArrayLike
) -> StampedPoses:
    """Return poses in the order of their stamps, the first of those that share one.

    Args:
        name: Of the topic, for messages.
        frame: In which they are.
        stamp: (n,) [ns].
        position: (n, 3) [m].
        quaternion: (n, 4) x, y, z, w; their length is brought to 1.

    Raises:
        SourceError: A number is not finite, a place is no place of a map, or a quaternion is not
            nearly of unit length.

    """
    places, turns = np.array(position, dtype=float), np.array(quaternion, dtype=float)
    numbers = np.concatenate([places, turns], axis=1)
    _refuse(
        name, stamp, numbers, ~np.isfinite(numbers).all(axis=1),
        'numbers that are not finite (x y z, quaternion x y z w)',
    )  # fmt: skip
    far = (np.abs(places) > FARTHEST).any(axis=1)
    _refuse(name, stamp, places, far, f'places over {FARTHEST:g} m from the origin (x y z)')
    length = np.linalg.norm(turns, axis=1)
    _refuse(
        name, stamp, turns, np.abs(length - 1.0) > UNIT, 'quaternions not of length 1 (x y z w)'
    )
    _, first = np.unique(stamp, return_index=True)
    rotation = _matrices(turns[first] / length[first, None])
    return StampedPoses(name, frame, stamp[first], places[first], rotation)


def _refuse(name: str, stamp: Stamps, values: Array, wrong: NDArray[np.bool_], what: str) -> None:
    if wrong.any():
        row = int(np.argmax(wrong))
        seconds, rest = divmod(int(stamp[row]), 10**9)
        told = ' '.join(f'{value:g}' for value in values[row])
        msg = (
            f'{name}: {int(wrong.sum())} of {len(wrong)} poses have {what}, the first is {told} at '
            f'{seconds}.{rest:09d}: cut them out (agv bag cut), or mend who said them'
        )
        raise SourceError(msg)


def _matrices(quaternion: Array) -> Array:
    """Return (n, 3, 3) rotations of unit quaternions (n, 4)."""
    x, y, z, w = quaternion.T
    rows = [
        1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y),
    ]  # fmt: skip
    return np.stack(rows, axis=1).reshape(-1, 3, 3)


def associate(
    reference: StampedPoses, driven: StampedPoses, within: float = 0.01, offset: float = 0.0
) -> tuple[StampedPoses, StampedPoses]:
    """Return the poses that belong together: to each of the fewer the nearest of the others.

    Of two equally near the earlier is taken; one of the many may be nearest to several, as evo
    (`evo.core.sync.associate_trajectories`) has it.

    Args:
        reference: As it was.
        driven: As it was told to be.
        within: How far apart in time two may be [s].
        offset: Added to the stamps of ``driven`` before [s]: what its clock was behind.

    Raises:
        ConfigurationError: ``within`` or ``offset`` is no such time, or fewer than `FEWEST` belong
            together; the message says why.

    """
    if not 0.0 <= within <= 3600.0:
        msg = f'--within {within}: give seconds from 0 to 3600'
        raise ConfigurationError(msg)
    if not abs(offset) <= 2.0**31:
        msg = f'--offset {offset}: give a finite number of seconds, at most {2**31}'
        raise ConfigurationError(msg)
    shifted = driven.stamp + round(offset / NANOSECOND)
    if min(len(shifted), len(reference.stamp)) < FEWEST:
        msg = '; '.join(f'{p.name} has {len(p.stamp)}' for p in (reference, driven))
        msg = f'too few poses of different stamps, expected at least {FEWEST} of each: {msg}'
        raise ConfigurationError(msg)
    limit = round(within / NANOSECOND)
    if len(shifted) > len(reference.stamp):
        here, there = _nearest(reference.stamp, shifted, limit)
    else:
        there, here = _nearest(shifted, reference.stamp, limit)
    if len(here) < FEWEST:
        raise ConfigurationError(_why(reference, driven._replace(stamp=shifted), limit, len(here)))
    return reference.picked(here), driven.picked(there)


def _nearest(few: Stamps, many: Stamps, limit: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return rows of ``few`` that have a nearest one in ``many`` within a limit, and its rows."""
    after = np.clip(np.searchsorted(many, few), 1, len(many) - 1)
    later = many[after] - few < few - many[after - 1]
    near = np.where(later, after, after - 1)
    rows = np.flatnonzero(np.abs(many[near] - few) <= limit)
    return rows, near[rows]


def _why(reference: StampedPoses, driven: StampedPoses, limit: int, found: int) -> str:
    """Return why so few belong together, and what to do."""
    said = (
        f'{found} poses of {driven.name} have one of {reference.name} within {limit * 1e-9:g} s, '
        f'expected at least {FEWEST}: '
    )
    (first, last), (begin, end) = (
        (int(poses.stamp[0]), int(poses.stamp[-1])) for poses in (reference, driven)
    )
    if begin > last + limit or end < first - limit:
        behind = (first - begin) * 1e-9
        return said + (
            f'they do not overlap: one spans {(last - first) * 1e-9:.3f} s, the other '
            f'{(end - begin) * 1e-9:.3f} s, and {driven.name} begins {abs(behind):.3f} s '
            f'{"before" if behind > 0 else "after"} {reference.name}. If both tell of the same '
            f'drive their clocks differ by about so much: --offset {behind:.3f}'
        )
    near = _nearest(driven.stamp, reference.stamp, last - first + end - begin)
    apart = np.abs(driven.stamp[near[0]] - reference.stamp[near[1]])
    third = int(np.sort(apart)[FEWEST - 1])
    return said + (
        f'the third nearest are {third * 1e-9:.6g} s apart, half of them less than '
        f'{float(np.median(apart)) * 1e-9:.6g} s; if the robot was slow enough: '
        f'--within {third * 1.01e-9:.3g}, or more'
    )
