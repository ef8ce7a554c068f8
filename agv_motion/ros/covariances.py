"""Between the planar covariance of the core and the 36 numbers of ROS (x, y, z, roll, pitch, yaw).

The others of the six are left 0, which is how ROS says unknown.
"""

from __future__ import annotations

from math import isclose
from typing import TYPE_CHECKING, Any

from agv_motion.errors import SignalError
from agv_motion.odometry.covariance import Covariance
from agv_motion.planar import require_finite

if TYPE_CHECKING:
    from collections.abc import Sequence

XX, XY, XT, YX, YY, YT, TX, TY, TT = 0, 1, 5, 6, 7, 11, 30, 31, 35
"""Places of x, y and yaw in the row-major matrix."""


def covariance_of(numbers: Sequence[float]) -> Covariance:
    """Return the planar part of a ROS covariance.

    Raises:
        SignalError: One of its nine numbers is not finite, or it is not symmetric.

    """
    planar = tuple(float(numbers[i]) for i in (XX, XY, XT, YX, YY, YT, TX, TY, TT))
    require_finite('covariance of x, y and yaw (row by row)', planar)
    for upper, lower in ((XY, YX), (XT, TX), (YT, TY)):
        if not isclose(numbers[upper], numbers[lower], rel_tol=1e-6, abs_tol=1e-12):
            msg = (
                f'covariance[{upper}] = {numbers[upper]} and covariance[{lower}] = '
                f'{numbers[lower]}: a covariance is symmetric, give both the same'
            )
            raise SignalError(msg)
    xx, xy, xt, _, yy, yt, _, _, tt = planar
    return Covariance(xx, xy, xt, yy, yt, tt)


def fill_covariance(numbers: Any, covariance: Covariance) -> None:
    """Write ``covariance`` into the 36 numbers of a message, or into (36, n) of many, in place."""
    xx, xy, xt, yy, yt, tt = covariance
    for place, value in (
        (XX, xx), (XY, xy), (XT, xt), (YX, xy), (YY, yy), (YT, yt), (TX, xt), (TY, yt), (TT, tt),
    ):  # fmt: skip
        numbers[place] = value
