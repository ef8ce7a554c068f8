"""What a calibration works on: the turns of the wheels, and places measured on the way."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import ConfigurationError, SignalError

Array = NDArray[np.float64]

LONGEST = 60
"""References in a stretch: enough to see all there is, few enough for dense matrices."""


@dataclass(frozen=True)
class CalibrationDrive:
    """A drive: m steps of n wheels, and k reference poses taken between steps."""

    turned: Array
    """(n, m) angle by which each wheel turned in each step [rad]"""
    reference_step: NDArray[np.int_]
    """(k,) how many steps had been made when a reference was taken, 0 to m, rising"""
    reference: Array
    """(3, k) x [m], y [m] and heading [rad]; NaN where the heading is not known"""
    position_noise: float
    """[m] standard deviation of a reference's x and y"""
    heading_noise: float = 0.02
    """[rad] of its heading"""
    steering: Array | None = None
    """(n, m) steering angles halfway through each step [rad], of a base on turrets"""

    def __post_init__(self) -> None:
        """Refuse what does not fit together.

        Raises:
            SignalError: Shapes differ, a number is not finite, or the steps do not rise.
            ConfigurationError: A noise is not above 0.

        """
        turned, step, reference = self.turned, self.reference_step, self.reference
        shapes = f'turned {turned.shape}, steps {step.shape}, reference {reference.shape}'
        if turned.ndim != 2 or step.ndim != 1 or reference.shape != (3, len(step)):
            msg = f'{shapes}: give (n, m), (k,) and (3, k)'
            raise SignalError(msg)
        if self.steering is not None and self.steering.shape != turned.shape:
            msg = f'steering has shape {self.steering.shape}, wheels {turned.shape}: give the same'
            raise SignalError(msg)
        if len(step) < 2 or step[0] < 0 or step[-1] > turned.shape[1] or np.any(np.diff(step) <= 0):
            msg = f'reference steps must rise within 0 to {turned.shape[1]}, at least 2 of them'
            raise SignalError(msg)
        columns = [turned, reference[:2], *([] if self.steering is None else [self.steering])]
        if not all(np.isfinite(column).all() for column in columns) or np.isinf(reference).any():
            msg = 'wheel turns, steering and reference positions must be finite: drop the bad rows'
            raise SignalError(msg)
        for name, noise in (('position', self.position_noise), ('heading', self.heading_noise)):
            if not 0.0 < noise < np.inf:
                msg = f'{name}_noise = {noise}: must be finite and above 0'
                raise ConfigurationError(msg)

    def stretches(self) -> list[CalibrationDrive]:
        """Return the drive in stretches of few references, each with a start of its own.

        They share no reference, so that their errors are independent.
        """
        count = max(round(len(self.reference_step) / LONGEST), 1)
        cuts = np.linspace(0, len(self.reference_step), count + 1).round().astype(int)
        return [self.part(np.arange(first, last)) for first, last in pairwise(cuts)]

    def part(self, kept: NDArray[np.int_]) -> CalibrationDrive:
        """Return the drive from the first to the last of some references, with these alone."""
        steps = slice(self.reference_step[kept[0]], self.reference_step[kept[-1]])
        return CalibrationDrive(
            self.turned[:, steps],
            self.reference_step[kept] - self.reference_step[kept[0]],
            self.reference[:, kept],
            self.position_noise,
            self.heading_noise,
            None if self.steering is None else self.steering[:, steps],
        )
