r"""Which of four or more wheels is wrong: each is left out in turn, and the rest must agree.

Sound wheels leave a residual of noise only. With one wheel wrong that holds no more, but it does
of the residual without that wheel. Five wheels tell whatever the fault does. Of four, any three
agree with some twist, so one instant says nothing; over a time in which the motion changes, a
wheel that measures a fixed share of the truth (0: dead, less than 1: slipping) is still told
apart, because only of that wheel is what it measures proportional to what the rest expect of it.

With the projection :math:`M = I - A A^+` and the residual :math:`r = M y`, leaving out wheel
:math:`j` takes :math:`r_j^2 / M_{jj}` off the sum of squares, and the rest expect
:math:`y_j - r_j / M_{jj}` of it.

Source: R. Patton, J. Chen, "A review of parity space approaches to fault diagnosis", IFAC
SAFEPROCESS, 1991; the deletion formula: R. D. Cook, S. Weisberg, "Residuals and influence in
regression", 1982, section 2.2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from agv_motion.errors import ConfigurationError, SignalError
from agv_motion.odometry.chi_square import chi_square_quantile

if TYPE_CHECKING:
    from agv_motion.kinematics.omniwheels import OmniWheels

Column = NDArray[np.float64]

IRREPLACEABLE = 1e-9
"""[-] Diagonal of the projection below which the rest cannot tell the twist without a wheel."""


class WheelDiagnosis(NamedTuple):
    """Whether wheels agree with one another, and if not, who may be to blame."""

    consistent: bool
    """Noise alone explains what they measured"""
    suspects: tuple[int, ...]
    """Wheels without which the rest agree; none when more than one is wrong"""

    @property
    def faulty(self) -> int | None:
        """The wheel to blame, when there is just one."""
        return self.suspects[0] if len(self.suspects) == 1 else None


def diagnose_wheels(
    wheels: OmniWheels, speeds: Column, noise: float, false_alarm: float = 1e-3
) -> WheelDiagnosis:
    """Return whether the wheels agreed over some time, and which one did not.

    Args:
        wheels: The base, n >= 4 wheels.
        speeds: (n, k) rim speeds [m/s] over k instants, of varied motion where n = 4.
        noise: Standard deviation of a sound wheel's speed [m/s].
        false_alarm: Probability of blaming sound wheels.

    Raises:
        ConfigurationError: Fewer than four wheels (the residual of three is always 0), or a noise
            that is not above 0.
        SignalError: ``speeds`` has another shape or is not finite.

    """
    n = len(wheels)
    if n < 4 or not 0.0 < noise < np.inf:
        msg = f'{n} wheels with noise = {noise} m/s: a diagnosis needs 4 wheels and a noise above 0'
        raise ConfigurationError(msg)
    speeds = np.asarray(speeds, dtype=float)
    if speeds.ndim != 2 or len(speeds) != n or not np.isfinite(speeds).all():
        msg = f'speeds must be a finite ({n}, k) array, got shape {speeds.shape}'
        raise SignalError(msg)
    matrix = wheels.matrix
    projection = np.eye(n) - matrix @ np.linalg.pinv(matrix)
    residual = projection @ speeds / noise
    instants = speeds.shape[1]
    total = float(np.sum(residual**2))
    probability = 1.0 - false_alarm
    if instants == 0 or total <= chi_square_quantile(probability, (n - 3) * instants):
        return WheelDiagnosis(consistent=True, suspects=())
    suspects = []
    for wheel, share in enumerate(np.diag(projection)):
        if share < IRREPLACEABLE:
            continue
        if n > 4:
            left = total - float(np.sum(residual[wheel] ** 2)) / share
            degrees = (n - 4) * instants
        else:
            left = _misproportion(speeds[wheel] / noise, residual[wheel] / share, share)
            degrees = instants - 1
        if degrees > 0 and left <= chi_square_quantile(probability, degrees):
            suspects.append(wheel)
    return WheelDiagnosis(consistent=False, suspects=tuple(suspects))


def _misproportion(measured: Column, error: Column, share: float) -> float:
    """Return by how much a wheel's speed is not proportional to what the rest expect, squared.

    In units of its variance: that of the wheel, 1, and of the expectation, 1 / share - 1.
    """
    expected = measured - error
    gain = float(expected @ measured) / max(float(expected @ expected), 1e-300)
    variance = 1.0 + gain * gain * (1.0 / share - 1.0)
    return float(np.sum((measured - gain * expected) ** 2)) / variance
