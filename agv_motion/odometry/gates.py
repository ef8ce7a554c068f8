"""Gates: how large a number may be that enters an odometry or a fusion, each with its unit.

A number beyond its gate is no measurement but a fault, or would drown all others in rounding: it is
refused by name, and nothing has changed.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from agv_motion.errors import SignalError
from agv_motion.planar import FARTHEST, require_finite

if TYPE_CHECKING:
    from collections.abc import Sequence

    from agv_motion.odometry.covariance import Covariance

MAX_STAMP = 1e11
"""[s] 3,000 years."""
MAX_ANGLE = 1e9
"""[rad] Of a wheel: 50,000 km on wheels of 5 cm; beyond, steps are lost in rounding."""
MAX_WAY = 1e5
"""[m] Of a robot from the origin of its odometry, about which errors are kept."""
MAX_COORDINATE = FARTHEST
"""[m] In the map."""
MAX_HEADING = 1e6
"""[rad] 160,000 turns: nobody counts them."""
MAX_DEVIATION = 1e4
"""[m] Standard deviation of a position: beyond, it tells nothing."""
MIN_DEVIATION = 1e-6
"""[m, rad] Standard deviation of a measurement: nothing is measured better."""
MAX_TURN_DEVIATION = 1e3
"""[rad] Standard deviation of a heading: 160 turns."""
CONDITION = 1e-10
"""[-] Smallest ratio of the variances of a measurement along its two axes."""
ROUNDING = 1e-9
"""[-] Share of a variance that may be lost in rounding."""


def require_within(
    name: str, values: Sequence[float], limit: float, unit: str, remedy: str
) -> None:
    """Raise unless every number lies within plus and minus ``limit``.

    Raises:
        SignalError: One of them does not, or is not finite.

    """
    if not all(-limit <= value <= limit for value in values):
        require_finite(name, tuple(values))
        worst = max(map(abs, values))
        msg = f'{name} = {worst:g} {unit}: cannot be beyond {limit:g} {unit}; {remedy}'
        raise SignalError(msg)


def require_measurement(name: str, covariance: Covariance, *, heading: bool) -> None:
    """Raise unless a covariance can be that of a measured position, and heading where there is one.

    Raises:
        SignalError: A number is not finite, it is not positive definite, or nearly not, or a
            deviation lies beyond its gate.

    """
    xx, xy, xt, yy, yt, tt = covariance
    if not heading:
        xt, yt, tt = 0.0, 0.0, 1.0
    require_finite(f'covariance of {name}', (xx, xy, xt, yy, yt, tt))
    minor = xx * yy - xy * xy
    determinant = tt * minor - yt * (xx * yt - xt * xy) + xt * (xy * yt - yy * xt)
    if not (
        min(xx, yy, tt) > 0.0
        and minor > CONDITION * (xx + yy) * (xx + yy)
        and determinant > ROUNDING * tt * minor
    ):
        msg = (
            f'{name}: covariance {tuple(covariance)} (xx, xy, xt, yy, yt, tt) is not positive '
            'definite: give variances above 0, and correlations below 1'
        )
        raise SignalError(msg)
    for axis, variance, limit, unit in (
        ('position', max(xx, yy), MAX_DEVIATION, 'm'),
        ('heading', tt, MAX_TURN_DEVIATION, 'rad'),
    ):
        if not variance <= limit * limit:
            msg = (
                f'{name}: a deviation of {sqrt(variance):g} {unit} of the {axis} tells nothing, '
                f'the limit is {limit:g} {unit}: leave it out'
            )
            raise SignalError(msg)
    if min(xx, yy, tt) < MIN_DEVIATION * MIN_DEVIATION:
        msg = (
            f'{name}: a deviation of {sqrt(min(xx, yy, tt)):g} m (rad) is less than '
            f'{MIN_DEVIATION:g}: nothing is measured that well, give the true one'
        )
        raise SignalError(msg)


def require_noise(name: str, covariance: Covariance) -> None:
    """Raise unless a covariance can be that of some accumulated noise; it may be 0.

    Raises:
        SignalError: A number is not finite, a variance is negative or beyond its gate, or a
            correlation is above 1.

    """
    require_finite(f'covariance of {name}', covariance)
    if not is_noise(covariance, 0.0):
        msg = (
            f'{name}: covariance {tuple(covariance)} (xx, xy, xt, yy, yt, tt) is none: variances '
            f'must lie between 0 and {MAX_DEVIATION:g} m, {MAX_TURN_DEVIATION:g} rad squared, and '
            'correlations between -1 and 1'
        )
        raise SignalError(msg)


def is_noise(covariance: Covariance, tolerance: float) -> bool:
    """Return whether all variances are sound and all correlations possible.

    Args:
        covariance: To be judged.
        tolerance: What a variance may be below 0 [m2, rad2], for rounding.

    """
    xx, xy, xt, yy, yt, tt = covariance
    xx, yy, tt = xx + tolerance, yy + tolerance, tt + tolerance
    if not (
        0.0 <= xx <= 1.1 * MAX_DEVIATION**2
        and 0.0 <= yy <= 1.1 * MAX_DEVIATION**2
        and 0.0 <= tt <= 1.1 * MAX_TURN_DEVIATION**2
    ):
        return False
    slack = 1.0 + ROUNDING
    return xy * xy <= slack * xx * yy and xt * xt <= slack * xx * tt and yt * yt <= slack * yy * tt
