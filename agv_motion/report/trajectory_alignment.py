"""Lay what a robot told over the reference: at the first pose, or as all places fit best."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import ConfigurationError

if TYPE_CHECKING:
    from agv_motion.report.stamped_poses import StampedPoses

Array = NDArray[np.float64]

ROUNDING = 8.0 * float(np.finfo(float).eps)


class Alignment(Enum):
    """How a trajectory is laid over the reference."""

    NONE = 'none'
    """As it was told"""
    ORIGIN = 'origin'
    """So that the first poses are the same"""
    SE2 = 'se2'
    """So that the places fit best, moved in the plane and turned about z"""
    SE3 = 'se3'
    """So that the places fit best, moved and turned in space"""


class Similarity(NamedTuple):
    """What was done: a place becomes ``rotation @ (scale * place) + translation``."""

    rotation: Array
    """(3, 3)"""
    translation: Array
    """(3,) [m]"""
    scale: float
    """[-]"""


def align(
    reference: StampedPoses, driven: StampedPoses, how: Alignment, *, scaled: bool = False
) -> tuple[StampedPoses, Similarity]:
    """Return ``driven`` laid over ``reference``, and how it was.

    Args:
        reference: As many poses as of ``driven``, which belong together.
        driven: To be laid over it.
        how: In which way.
        scaled: Fit the scale of ``driven`` as well, of SE2 and SE3.

    Raises:
        ConfigurationError: A scale was asked for where none can be fitted, or the places do not
            determine the rotation: all are the same, or (of SE3) on one line.

    """
    fitted = how in {Alignment.SE2, Alignment.SE3}
    if scaled and not fitted:
        msg = f'--scale with --align {how.value}: a scale is fitted with --align se2 or se3'
        raise ConfigurationError(msg)
    moved = Similarity(np.eye(3), np.zeros(3), 1.0)
    if how is Alignment.ORIGIN:
        turn = reference.rotation[0] @ driven.rotation[0].T
        moved = Similarity(turn, reference.position[0] - turn @ driven.position[0], 1.0)
    elif fitted:
        size = 2 if how is Alignment.SE2 else 3
        turn, shift, scale = _umeyama(
            driven.position[:, :size], reference.position[:, :size], scaled=scaled
        )
        moved = Similarity(np.eye(3), np.zeros(3), scale)
        moved.rotation[:size, :size], moved.translation[:size] = turn, shift
    places = moved.scale * driven.position @ moved.rotation.T + moved.translation
    turned: Array = moved.rotation @ driven.rotation
    return driven._replace(position=places, rotation=turned), moved


def _umeyama(source: Array, target: Array, *, scaled: bool) -> tuple[Array, Array, float]:
    r"""Return rotation, translation and scale that lay ``source`` over ``target``, both (n, m).

    They minimize :math:`\sum |y_i - (c R x_i + t)|^2`. Source: S. Umeyama, "Least-squares
    estimation of transformation parameters between two point patterns", IEEE PAMI 13(4), 1991,
    equations 34 to 43.
    """
    count, size = source.shape
    middle, goal = source.mean(axis=0), target.mean(axis=0)
    x, y = source - middle, target - goal
    u, d, v = np.linalg.svd(y.T @ x / count)
    far = max(float(np.abs(source).max()), float(np.abs(target).max()))
    if d[size - 2] <= ROUNDING * (far * np.sqrt(d[0]) + d[0]):
        what = 'are all the same' if d[0] <= ROUNDING * far * np.sqrt(d[0]) else 'lie on one line'
        msg = f'--align: the places {what}, which determines no rotation: ' + (
            'choose --align se2 or origin' if size > 2 else 'choose --align origin'
        )
        raise ConfigurationError(msg)
    mirror = np.ones(size)
    if np.linalg.det(u) * np.linalg.det(v) < 0.0:
        mirror[-1] = -1.0
    turn: Array = u * mirror @ v
    scale = float(np.sum(d * mirror) / np.mean(np.sum(x * x, axis=1))) if scaled else 1.0
    return turn, goal - scale * turn @ middle, scale
